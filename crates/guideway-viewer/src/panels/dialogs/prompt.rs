//! The line in which a file name is typed: for desktops without a file dialog, and where a name
//! has more to it, as the width of a PNG.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use eframe::egui::{Context, DragValue, Id, Key, Modal, Modifiers, TextEdit, Ui};

use super::path_line::{Completion, complete, path_of};
use crate::action::Action;
use crate::background::{BackgroundTask, RepaintHandle, lay_out_again};
use crate::file_purpose::PromptKind;
use crate::language::{say, t};
use crate::services::AppServices;

/// Width of an exported PNG until the user changes it, in pixels: 4K UHD.
const DEFAULT_WIDTH_PX: u32 = 3840;
/// Greatest side of a frame, in pixels.
const MAX_WIDTH_PX: u32 = 65_535;
/// Longest time that a frame waits for the check of a name: half a frame at 60 Hz.
const CHECK_WAIT: Duration = Duration::from_millis(8);
/// Width of the line, in points.
const LINE_WIDTH: f32 = 480.0;

/// The open prompt, if any.
#[derive(Default)]
pub(crate) struct Prompt {
    open: Option<OpenPrompt>,
}

pub(crate) struct OpenPrompt {
    kind: PromptKind,
    pub(crate) text: String,
    /// Width of an exported PNG, in pixels.
    pub(crate) width_px: u32,
    /// True if the text field takes the focus in the next frame.
    wants_focus: bool,
    completion: Completion,
    /// The text of the completion in progress: its folder may be slow or gone.
    completing: Option<(String, BackgroundTask<Completion>)>,
    /// Why the text is no answer.
    problem: Option<String>,
    /// The check of the name that was confirmed, with its problem: a disk may be slow or gone.
    check: Option<BackgroundTask<Option<String>>>,
}

impl Prompt {
    /// Opens a prompt with this text.
    pub(crate) fn ask_with_text(&mut self, kind: PromptKind, text: String) {
        self.open = Some(OpenPrompt {
            kind,
            text,
            width_px: DEFAULT_WIDTH_PX,
            wants_focus: true,
            completion: Completion::default(),
            completing: None,
            problem: None,
            check: None,
        });
    }

    /// Puts a chosen file into the open prompt of this kind. Returns `false` if there is none.
    pub(crate) fn fill(&mut self, kind: PromptKind, file: &Path) -> bool {
        let Some(prompt) = self.open.as_mut().filter(|prompt| prompt.kind == kind) else {
            return false;
        };
        prompt.text = file.to_string_lossy().into_owned();
        prompt.problem = None;
        true
    }

    /// Shows a problem in the open prompt.
    pub(crate) fn set_problem(&mut self, problem: &str) {
        if let Some(prompt) = &mut self.open {
            prompt.problem = Some(problem.to_owned());
        }
    }

    pub(crate) fn is_open(&self) -> bool {
        self.open.is_some()
    }

    /// Returns `true` if a confirmed name is being checked.
    #[cfg(test)]
    pub(crate) fn is_checking(&self) -> bool {
        self.open.as_ref().is_some_and(|open| open.check.is_some())
    }

    /// The text of the open prompt.
    #[cfg(test)]
    pub(crate) fn text(&self) -> Option<&str> {
        self.open.as_ref().map(|open| &*open.text)
    }

    #[cfg(test)]
    pub(crate) fn open_mut(&mut self) -> Option<&mut OpenPrompt> {
        self.open.as_mut()
    }

    pub(super) fn close(&mut self) {
        self.open = None;
    }

    pub(super) fn show(
        &mut self,
        ctx: &Context,
        services: &Arc<dyn AppServices>,
        repaint: &RepaintHandle,
    ) -> Option<Action> {
        let prompt = self.open.as_mut()?;
        let modal =
            Modal::new(Id::unique("prompt")).show(ctx, |ui| prompt.content(ui, &**services));
        match modal.inner {
            Some(Answer::Browse) => return Some(Action::Browse(prompt.kind)),
            Some(Answer::Ok) => prompt.start_check(services, repaint),
            Some(Answer::Complete) => prompt.start_completion(services, repaint),
            Some(Answer::Cancel) => {
                self.open = None;
                return None;
            }
            None if modal.should_close() => {
                self.open = None;
                return None;
            }
            None => {}
        }
        prompt.take_completion(ctx);
        let result = prompt.check.as_ref()?.result_within(CHECK_WAIT)?;
        prompt.check = None;
        prompt.problem = result.unwrap_or_else(|error| Some(error.to_string()));
        if prompt.problem.is_some() {
            prompt.wants_focus = true;
            return None;
        }
        let prompt = self.open.take()?;
        prompt.kind.action(prompt.answer(), prompt.width_px)
    }
}

impl OpenPrompt {
    fn content(&mut self, ui: &mut Ui, services: &dyn AppServices) -> Option<Answer> {
        let mut answer = None;
        ui.set_max_width(LINE_WIDTH);
        let is_checking = self.check.is_some();
        let title = ui.label(self.kind.title());
        let id = line_id();
        let tab = |ui: &mut Ui| ui.input_mut(|i| i.consume_key(Modifiers::NONE, Key::Tab));
        if ui.memory(|memory| memory.has_focus(id)) && tab(ui) {
            answer = Some(Answer::Complete);
        }
        let line = TextEdit::singleline(&mut self.text).id(id).lock_focus(true);
        let field = ui.add_enabled(!is_checking, line.desired_width(LINE_WIDTH));
        let field = field.labelled_by(title.id);
        if std::mem::take(&mut self.wants_focus) {
            field.request_focus();
            // egui keeps the place of the cursor in the last text.
            place_cursor_at_end(ui.ctx(), id, &self.text);
        }
        if field.changed() {
            (self.completion, self.problem) = (Completion::default(), None);
        }
        if let Some(problem) = &self.problem {
            ui.colored_label(ui.visuals().error_fg_color, problem);
        }
        self.show_candidates(ui);
        if self.kind == PromptKind::ExportPng {
            ui.horizontal(|ui| {
                ui.label(t("Width"));
                let width = DragValue::new(&mut self.width_px);
                ui.add(width.range(1..=MAX_WIDTH_PX).suffix(" px"));
            });
        }
        if self.kind == PromptKind::SaveAs {
            ui.small(formats_line(services));
        }
        ui.small(t(
            "Tab completes names of files and folders; ~ is your home folder",
        ));
        ui.horizontal(|ui| {
            let enters = field.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
            ui.add_enabled_ui(!is_checking, |ui| {
                if ui.button(t("OK")).clicked() || enters {
                    answer = Some(Answer::Ok);
                }
                if ui.button(t("Browse…")).clicked() {
                    answer = Some(Answer::Browse);
                }
            });
            if ui.button(t("Cancel")).clicked() {
                answer = Some(Answer::Cancel);
            }
        });
        answer
    }

    /// Shows the names that the text can become, if there are several.
    fn show_candidates(&self, ui: &mut Ui) {
        if self.completion.candidates.len() > 1 {
            let more = if self.completion.has_more { " …" } else { "" };
            let names = self.completion.candidates.join("   ");
            ui.small(names + more);
        }
    }

    /// The text as a path, or as it is where it is more than a path.
    fn answer(&self) -> PathBuf {
        match self.kind {
            PromptKind::FloorPlan => PathBuf::from(self.text.trim()),
            _ => path_of(&self.text),
        }
    }

    /// Starts to complete the text, beside the window.
    fn start_completion(&mut self, services: &Arc<dyn AppServices>, repaint: &RepaintHandle) {
        let (text, services) = (self.text.clone(), Arc::clone(services));
        let done = move || complete(&text, &*services);
        self.completing = Some((self.text.clone(), BackgroundTask::start(repaint, done)));
    }

    /// Takes a completion that has ended, unless the text is another one by now.
    fn take_completion(&mut self, ctx: &Context) {
        let task = self.completing.as_ref();
        let Some(done) = task.and_then(|(_, task)| task.result_within(CHECK_WAIT)) else {
            return;
        };
        if let (Some((text, _)), Ok(done)) = (self.completing.take(), done)
            && text == self.text
        {
            self.completion = done;
            self.text.clone_from(&self.completion.text);
            place_cursor_at_end(ctx, line_id(), &self.text);
            lay_out_again(ctx, "the line is completed");
        }
    }

    /// Starts to check the text, beside the window.
    fn start_check(&mut self, services: &Arc<dyn AppServices>, repaint: &RepaintHandle) {
        let (kind, path, services) = (self.kind, self.answer(), Arc::clone(services));
        let check = move || problem_of(kind, &path, &*services);
        self.check = Some(BackgroundTask::start(repaint, check));
    }
}

/// The identifier of the text field.
fn line_id() -> Id {
    Id::unique("prompt line")
}

/// Why a path is no answer, if it is none.
fn problem_of(kind: PromptKind, path: &Path, services: &dyn AppServices) -> Option<String> {
    if path.as_os_str().is_empty() || kind == PromptKind::FloorPlan {
        return None;
    }
    if path.is_dir() {
        return Some(t("This is a folder: add the name of a file").into());
    }
    if kind.opens() {
        let is_there = services.file_stamp(path).is_some();
        return (!is_there).then(|| t("There is no such file").into());
    }
    let folder = path
        .parent()
        .filter(|folder| !folder.as_os_str().is_empty())?;
    (!folder.is_dir()).then(|| t("There is no such folder").into())
}

#[derive(Clone, Copy)]
enum Answer {
    Ok,
    Complete,
    Browse,
    Cancel,
}

/// The formats of layouts and their extensions.
fn formats_line(services: &dyn AppServices) -> String {
    let formats = services.layout_formats().into_iter().map(|format| {
        let extensions: Vec<String> = format.extensions.iter().map(|e| format!(".{e}")).collect();
        format!("{} ({})", format.name, extensions.join(", "))
    });
    say!(
        "Formats: {all}",
        all = formats.collect::<Vec<_>>().join(", ")
    )
}

fn place_cursor_at_end(ctx: &Context, id: Id, text: &str) {
    use eframe::egui::text::{CCursor, CCursorRange};
    use eframe::egui::text_edit::TextEditState;
    let mut state = TextEditState::load(ctx, id).unwrap_or_default();
    let end = CCursorRange::one(CCursor::new(text.chars().count()));
    state.cursor.set_char_range(Some(end));
    state.store(ctx, id);
}
