//! Questions for file names: by the dialog of the desktop, else by the line of the window.

use std::path::{Path, PathBuf};

use super::state::App;
use crate::action::Action;
use crate::file_purpose::{Picked, PromptKind};
use crate::language::t;

/// Said where the desktop has no dialog.
const NO_DIALOG: &str = "This desktop has no file dialog: type the name";

impl App {
    /// Asks for a file name, beginning with one derived from the active file.
    pub(super) fn ask_for_file(&mut self, kind: PromptKind) {
        let active = self.files.active().map(|layer| layer.path());
        let suggestion = kind.suggestion(active);
        self.ask_for_name(kind, suggestion);
    }

    /// Asks for a file name, beginning with this one.
    pub(super) fn ask_for_name(&mut self, kind: PromptKind, suggestion: PathBuf) {
        // A PNG has a width beside its name, for which the dialogs of desktops have no place.
        if kind == PromptKind::ExportPng || !self.open_picker(kind, suggestion.clone()) {
            let prompt = &mut self.dialogs.prompt;
            prompt.ask_with_text(kind, text_of(&suggestion));
        }
    }

    /// Opens the dialog of the desktop from the line of the window.
    pub(super) fn browse(&mut self, kind: PromptKind) {
        let active = self.files.active().map(|layer| layer.path());
        let suggestion = kind.suggestion(active);
        if !self.open_picker(kind, suggestion) {
            self.dialogs.prompt.set_problem(t(NO_DIALOG));
        }
    }

    fn open_picker(&mut self, kind: PromptKind, suggestion: PathBuf) -> bool {
        if !self.settings.uses_desktop_dialogs {
            return false;
        }
        let active = self.files.active().map(|layer| layer.path().to_owned());
        let (services, repaint) = (&self.context.services, &self.context.repaint);
        let picker = &mut self.dialogs.picker;
        picker.ask(kind, suggestion, active.as_deref(), services, repaint)
    }

    /// Takes the answer of the dialog of the desktop. Returns the action that it asks for.
    pub(super) fn take_picked(&mut self, picked: Picked) -> Option<Action> {
        let prompt = &mut self.dialogs.prompt;
        match picked {
            Picked::File(kind, path) if prompt.fill(kind, &path) => None,
            Picked::File(PromptKind::FloorPlan, path) => {
                self.set_floor_plan_file(&path);
                None
            }
            Picked::File(kind, path) => kind.action(path, 0),
            Picked::Typed(..) if prompt.is_open() => {
                prompt.set_problem(t(NO_DIALOG));
                None
            }
            Picked::Typed(kind, suggestion) => {
                prompt.ask_with_text(kind, text_of(&suggestion));
                None
            }
        }
    }
}

fn text_of(path: &Path) -> String {
    path.to_string_lossy().into_owned()
}
