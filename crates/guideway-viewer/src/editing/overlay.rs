//! Marks and outlines of one view, computed by a background task.

#[cfg(test)]
use std::sync::mpsc::Receiver;
use std::sync::{Arc, OnceLock};
use std::time::{Duration, Instant};

use eframe::egui::{Mesh, Pos2};
use guideway_document::decorations::{MAX_MARKED, MarkOptions, Marks, Outline, marks, outline};
use guideway_document::{Document, Elements, Group};
use guideway_scene::View;
use guideway_spline::Point;

use crate::background::{BackgroundTask, RepaintHandle};

/// Marks and selection outline over the picture of one document. Like the picture, the last overlay
/// stays on screen until the next one is complete.
#[derive(Default)]
pub(crate) struct Overlay {
    last: Option<OverlayContent>,
    task: Option<BackgroundTask<OverlayContent>>,
    /// Input of the task in progress, or else of the last content.
    requested: Option<OverlayInput>,
}

/// All that an overlay depends on.
#[derive(Clone, PartialEq)]
pub(super) struct OverlayInput {
    pub(super) view: View,
    pub(super) options: MarkOptions,
    /// The level or vehicle type whose members stand out.
    pub(super) highlighted: Option<Group>,
    pub(super) revision: u64,
}

/// The elements of levels or vehicle types.
pub(crate) struct MembersOutline {
    pub(crate) paths: Outline,
    /// Places of nodes and stations, in pixels.
    pub(crate) symbols: Vec<Point<f64>>,
}

/// Triangles of the outline of a selection that is being moved.
pub(crate) struct MovingOutline {
    /// Corner of the canvas that they are made for.
    pub(crate) corner: Pos2,
    pub(crate) selected: Arc<Mesh>,
    /// The same in the color of the new place, to be moved there.
    pub(crate) moved: Mesh,
}

/// Marks and outlines of a view.
pub(crate) struct OverlayContent {
    pub(crate) view: View,
    pub(crate) marks: Marks,
    pub(crate) selection: Outline,
    /// The triangles of that outline, once it is being moved.
    pub(crate) moving: OnceLock<MovingOutline>,
    /// Places of selected nodes and stations, in pixels.
    pub(crate) symbols: Vec<Point<f64>>,
    /// Elements of the selected levels and vehicle types, and of the one under the pointer.
    pub(crate) of_selected: Option<MembersOutline>,
    pub(crate) highlighted: Option<MembersOutline>,
    elapsed: Duration,
}

impl Overlay {
    /// Requests the overlay of a view, unless a task is in progress or the last one had the same
    /// input. Waits for it if the last one took less than `wait`.
    pub(super) fn request(
        &mut self,
        document: &Arc<Document>,
        input: OverlayInput,
        wait: Duration,
        repaint: &RepaintHandle,
    ) {
        if self.task.is_some() || self.requested.as_ref() == Some(&input) {
            return;
        }
        let document = Arc::clone(document);
        self.start(input, repaint, move |input| {
            OverlayContent::new(&document, input)
        });
        if self.last().is_none_or(|last| last.elapsed < wait) {
            self.poll(wait);
        }
    }

    fn start(
        &mut self,
        input: OverlayInput,
        repaint: &RepaintHandle,
        compute: impl FnOnce(&OverlayInput) -> OverlayContent + Send + 'static,
    ) {
        self.requested = Some(input.clone());
        self.task = Some(BackgroundTask::start(repaint, move || compute(&input)));
    }

    /// Repeats the last request with a task that blocks until `rest` yields or disconnects.
    #[cfg(test)]
    pub(super) fn repeat_blocked(
        &mut self,
        document: &Arc<Document>,
        repaint: &RepaintHandle,
        rest: Receiver<()>,
    ) {
        let input = self.requested.clone().expect("an overlay was requested");
        let document = Arc::clone(document);
        self.start(input, repaint, move |input| {
            let _ = rest.recv();
            OverlayContent::new(&document, input)
        });
    }

    /// Takes the result if it is complete within `wait`.
    pub(super) fn poll(&mut self, wait: Duration) {
        let result = self.task.as_ref().and_then(|task| task.result_within(wait));
        if let Some(content) = result {
            self.task = None;
            // After a panic, which was reported, the last content stays.
            self.last = content.ok().or(self.last.take());
        }
    }

    /// The last complete overlay.
    pub(crate) fn last(&self) -> Option<&OverlayContent> {
        self.last.as_ref()
    }

    /// Returns `true` if a task reads the document.
    pub(super) fn is_busy(&self) -> bool {
        self.task.is_some()
    }

    /// Abandons the request before an edit. The caller waits for the task, which still reads the
    /// document.
    pub(super) fn abandon(&mut self) -> Option<BackgroundTask<OverlayContent>> {
        self.requested = None;
        self.task.take()
    }
}

impl OverlayContent {
    fn new(document: &Document, input: &OverlayInput) -> Self {
        let started = Instant::now();
        Self {
            view: input.view,
            marks: marks(document, &input.view, &input.options),
            selection: outline(document, document.selection(), &input.view),
            moving: OnceLock::new(),
            symbols: symbols(document, document.selected(), &input.view),
            of_selected: members(document, document.selected().groups(), &input.view),
            highlighted: members(document, input.highlighted.iter().cloned(), &input.view),
            elapsed: started.elapsed(),
        }
    }
}

/// The outline of what belongs to groups; `None` without any.
fn members(
    document: &Document,
    groups: impl Iterator<Item = Group>,
    view: &View,
) -> Option<MembersOutline> {
    let mut groups = groups.peekable();
    groups.peek()?;
    let all = document.members_of_all(groups);
    Some(MembersOutline {
        paths: outline(document, &all.paths, view),
        symbols: symbols(document, &all, view),
    })
}

/// Positions of nodes and stations in a view, in pixels; the first ones, if there are too many to
/// tell apart.
fn symbols(document: &Document, elements: &Elements, view: &View) -> Vec<Point<f64>> {
    let nodes = elements
        .nodes
        .iter()
        .map(|node| document.node_position_m(node));
    let stations = elements.stations.iter();
    let stations = stations.filter_map(|station| document.station_position_m(station));
    let bounds = view.world_bounds();
    let visible = nodes.chain(stations).filter(|at_m| bounds.contains(*at_m));
    let first = visible.take(MAX_MARKED);
    first.map(|at_m| view.pixel_from_world(at_m)).collect()
}
