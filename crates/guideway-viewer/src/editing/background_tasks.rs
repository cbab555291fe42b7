//! Background tasks of one document: recoloring, selection by query, check.

use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

use guideway_document::{Document, PathSet, Query, QueryError, SelectMode};
use guideway_layout::{CheckOptions, Layout, shown_path};
use guideway_scene::{Coloring, SceneError, SceneOptions};

use super::document_slot::DocumentSlot;
use super::edit_task::EditTask;
use super::findings::Findings;
use super::notice::Notice;
use crate::background::{BackgroundTask, RepaintHandle};

/// Time without a change after which the document is checked: longer than the pauses of a drag, in
/// seconds.
const CHECK_DELAY_S: f64 = 0.5;
/// A check that takes longer runs only on request: it occupies the processor that edits need.
const LONG_CHECK: Duration = Duration::from_secs(1);

/// The background tasks of one document, its scene options and its findings.
pub(crate) struct BackgroundTasks {
    /// The options that the scene has, or gets when the task in progress is complete.
    options: SceneOptions,
    recoloring: Option<BackgroundTask<Result<LayoutColors, SceneError>>>,
    selecting: Option<(BackgroundTask<PathSet>, SelectMode)>,
    checking: Option<BackgroundTask<Findings>>,
    findings: Option<Findings>,
    /// [`Document::values_revision`] of the colors that the scene has, or gets.
    colored: u64,
    /// A state without findings, and the time of its detection in seconds.
    unchecked: Option<(u64, CheckOptions, f64)>,
}

/// A layout and its colors.
type LayoutColors = (Arc<Layout>, Arc<Coloring>);

/// The result of a background task that concerns the open file.
pub(crate) enum TaskEvent {
    /// An edit to run on the document.
    Edit(EditTask),
    /// The scene has these colors now.
    Recolored(Arc<Coloring>),
    /// A notice for the user.
    Notice(Notice),
}

impl BackgroundTasks {
    pub(crate) fn new(options: SceneOptions) -> Self {
        Self {
            options,
            recoloring: None,
            selecting: None,
            checking: None,
            findings: None,
            colored: 0,
            unchecked: None,
        }
    }

    /// The file is read again with these options.
    pub(crate) fn set_options(&mut self, options: SceneOptions) {
        self.options = options;
    }

    /// Another document is in place.
    pub(crate) fn reset_findings(&mut self) {
        (self.findings, self.checking) = (None, None);
        self.colored = 0;
    }

    pub(crate) fn findings(&self) -> Option<&Findings> {
        self.findings.as_ref()
    }

    /// Takes the findings, to change them.
    #[cfg(test)]
    pub(crate) fn take_findings(&mut self) -> Option<Findings> {
        self.findings.take()
    }

    pub(crate) fn set_findings(&mut self, findings: Findings) {
        self.findings = Some(findings);
    }

    /// Returns `true` if a recoloring or a query is in progress.
    pub(crate) fn is_busy(&self) -> bool {
        self.recoloring.is_some() || self.selecting.is_some()
    }

    /// Returns `true` if a check is in progress, or the first one is not complete.
    pub(crate) fn is_checking(&self) -> bool {
        self.checking.is_some() || self.findings.is_none()
    }

    /// Recolors the paths, unless they have these colors.
    pub(crate) fn recolor(
        &mut self,
        document: Option<&Document>,
        options: SceneOptions,
        repaint: &RepaintHandle,
    ) {
        let numbers = |of: &SceneOptions| of.color_by.is_some().then_some(of.numbers);
        let is_same = self.options.color == options.color
            && self.options.color_by == options.color_by
            && numbers(&self.options) == numbers(&options);
        if let Some(document) = document.filter(|_| !is_same) {
            self.options = options;
            self.start_recoloring(document, repaint);
        }
    }

    fn start_recoloring(&mut self, document: &Document, repaint: &RepaintHandle) {
        self.colored = document.values_revision();
        let (layout, options) = (document.scene().shared_layout(), self.options.clone());
        let color = move || {
            let coloring = Coloring::new(&layout, &options)?;
            Ok((layout, Arc::new(coloring)))
        };
        self.recoloring = Some(BackgroundTask::start(repaint, color));
    }

    /// Selects the paths that match a query.
    ///
    /// # Errors
    /// When the query has a syntax error or names an unknown column; the selection is unchanged.
    pub(crate) fn select_where(
        &mut self,
        document: Option<&Document>,
        query: &str,
        mode: SelectMode,
        repaint: &RepaintHandle,
    ) -> Result<(), QueryError> {
        if let Some(document) = document {
            let query = Query::parse(query, document.layout())?;
            let layout = document.scene().shared_layout();
            let task = BackgroundTask::start(repaint, move || query.rows(&layout));
            self.selecting = Some((task, mode));
        }
        Ok(())
    }

    /// Checks the document in its present state.
    pub(crate) fn check(
        &mut self,
        document: Option<&Document>,
        options: CheckOptions,
        repaint: &RepaintHandle,
    ) {
        if let Some(document) = document {
            let snapshot = document.snapshot();
            let check = move || Findings::of(&snapshot, &options);
            self.checking = Some(BackgroundTask::start(repaint, check));
        }
    }

    /// Checks the document a while after its last change, unless the last check took long. Returns
    /// the time until then.
    pub(crate) fn refresh_findings(
        &mut self,
        document: Option<&Document>,
        options: CheckOptions,
        now_s: f64,
        repaint: &RepaintHandle,
    ) -> Option<Duration> {
        // A preview does not count.
        let document = document.filter(|document| !document.is_preview())?;
        let findings = self.findings.as_ref()?;
        let state = document.state();
        let is_new = findings.state == state && findings.options == options;
        if is_new || self.checking.is_some() || findings.elapsed > LONG_CHECK {
            self.unchecked = None;
            return None;
        }
        let since_s = match &self.unchecked {
            Some((seen, of, since_s)) if *seen == state && *of == options => *since_s,
            _ => now_s,
        };
        let wait_s = since_s + CHECK_DELAY_S - now_s;
        if wait_s <= 0.0 {
            self.unchecked = None;
            self.check(Some(document), options, repaint);
            return None;
        }
        self.unchecked = Some((state, options, since_s));
        Some(Duration::from_secs_f64(wait_s))
    }

    /// Takes finished tasks. Recoloring and selection wait until no other thread reads the
    /// document.
    pub(crate) fn poll(
        &mut self,
        slot: &mut DocumentSlot,
        file: &Path,
        repaint: &RepaintHandle,
    ) -> Vec<TaskEvent> {
        let mut events = Vec::new();
        events.extend(self.poll_check());
        if let Some(document) = slot.exclusive() {
            // A selection takes the document away, so the colors wait for the next call.
            let event = self
                .poll_query()
                .or_else(|| self.poll_colors(document, file, repaint));
            events.extend(event);
            let is_old = self.colored != document.values_revision();
            if is_old && self.reads_values(document) && self.recoloring.is_none() {
                self.start_recoloring(document, repaint);
            }
        }
        events
    }

    /// Returns `true` if values of a document decide its colors: those of a column, or which paths
    /// are walls.
    fn reads_values(&self, document: &Document) -> bool {
        let has_walls = || document.layout().paths.column("element").is_some();
        self.options.color_by.is_some() || self.options.has_gray_structure && has_walls()
    }

    fn poll_check(&mut self) -> Option<TaskEvent> {
        let result = self.checking.as_ref().and_then(BackgroundTask::result)?;
        self.checking = None;
        match result {
            Ok(findings) => {
                self.findings = Some(findings);
                None
            }
            Err(error) => Some(TaskEvent::Notice(error.to_string())),
        }
    }

    fn poll_query(&mut self) -> Option<TaskEvent> {
        let (task, mode) = self.selecting.as_ref()?;
        let (result, mode) = (task.result()?, *mode);
        self.selecting = None;
        Some(match result {
            Ok(paths) => TaskEvent::Edit(EditTask::view_change(move |document| {
                document.select(paths, mode);
            })),
            Err(error) => TaskEvent::Notice(error.to_string()),
        })
    }

    fn poll_colors(
        &mut self,
        document: &mut Document,
        file: &Path,
        repaint: &RepaintHandle,
    ) -> Option<TaskEvent> {
        let result = self.recoloring.as_ref().and_then(BackgroundTask::result)?;
        self.recoloring = None;
        match result {
            Ok(Ok((layout, coloring))) => {
                let is_recolored = document.recolor(&layout, &coloring);
                if !is_recolored {
                    // The layout was edited in the meantime.
                    self.start_recoloring(document, repaint);
                }
                is_recolored.then_some(TaskEvent::Recolored(coloring))
            }
            Ok(Err(error)) => {
                let name = file.file_name().unwrap_or(file.as_os_str());
                let notice = format!("{}: {error}", shown_path(Path::new(name)));
                Some(TaskEvent::Notice(notice))
            }
            Err(error) => Some(TaskEvent::Notice(error.to_string())),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;
    use std::thread;

    use super::*;
    use crate::tests::services::lanes;

    #[test]
    fn query_becomes_a_selection_and_a_wrong_column_an_error() {
        let mut slot = DocumentSlot::default();
        let document = Document::new(lanes(6).into(), &Default::default()).unwrap();
        slot.replace(document);
        let repaint: RepaintHandle = Arc::new(|| {});
        let mut tasks = BackgroundTasks::new(SceneOptions::default());
        let mode = SelectMode::Replace;
        let wrong = tasks.select_where(slot.document(), "spede > 2", mode, &repaint);
        assert!(wrong.is_err() && !tasks.is_busy());
        let query = tasks.select_where(slot.document(), "speed >= 2", mode, &repaint);
        assert!(query.is_ok() && tasks.is_busy());
        let file = Path::new("site.arrow");
        let event = (0..5_000).find_map(|_| {
            thread::sleep(Duration::from_millis(1));
            tasks.poll(&mut slot, file, &repaint).pop()
        });
        let Some(TaskEvent::Edit(select)) = event else {
            panic!("the query did not end");
        };
        slot.run(select, Duration::from_secs(60), file, &repaint);
        let selected: Vec<u32> = slot.document().unwrap().selection().iter().collect();
        assert_eq!(selected, [4, 5]);
    }
}
