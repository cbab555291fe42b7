//! Saving: checks what a save would lose, asks, writes, and ends the save.

use std::path::PathBuf;
use std::sync::Arc;

use guideway_layout::{UserError, shown_path};

use super::state::App;
use crate::action::Action;
use crate::command::Command;
use crate::file_purpose::PromptKind;
use crate::files::{
    BegunSave, DEFAULT_EXTENSION, SavedFile, Stamp, WriteOutcome, WriteTarget, Written, is_unknown,
};
use crate::language::{say, t};
use crate::panels::dialogs::{Question, Risk};
use crate::services::{LostPart, Saved};

impl App {
    /// Saves the next file of those that close after saving. Gives up where a question comes up or
    /// the file is not written.
    pub(super) fn save_before_leaving(&mut self) {
        let Some(index) = self.dialogs.leave.next_to_save(&self.files) else {
            return;
        };
        let is_ready = self.files.layers()[index].document().is_some();
        if self.writer.is_busy() || !is_ready {
            return;
        }
        self.files.activate(index);
        self.save_in_place();
        if !self.writer.is_busy() {
            self.dialogs.leave.close();
        }
    }

    /// Saves the active file in place; prompts for another name if that would lose content.
    pub(super) fn save_in_place(&mut self) {
        let Some(layer) = self.files.active() else {
            return;
        };
        let path = layer.path().to_owned();
        if layer.is_untitled() {
            return self.ask_for_name(PromptKind::SaveAs, path);
        }
        // A file written by this window holds no more than the layout.
        let unwritten = layer.document().filter(|_| !layer.save.is_written());
        let services = &self.context.services;
        let check = unwritten.map(|d| services.check_save_in_place(d.layout(), &path));
        let Some(Err(error)) = check else {
            return self.save_as(path);
        };
        self.dialogs.notices.add(error.to_string());
        let suggestion = path.with_extension(DEFAULT_EXTENSION);
        self.ask_for_name(PromptKind::SaveAs, suggestion);
    }

    /// Saves the active file under this name; asks before it overwrites what others wrote.
    pub(super) fn save_as(&mut self, path: PathBuf) {
        let Some(layer) = self.files.active() else {
            return;
        };
        let (known, risk) = match layer.is_at(&path) && !layer.is_untitled() {
            true => (layer.save.known(), Risk::OverwritesChanges),
            false => (None, Risk::ReplacesFile(Command::SaveAs)),
        };
        let question = Question {
            file: path.clone(),
            risk,
            confirmed: Action::SaveOver(path.clone()),
        };
        self.start_save(path, Some((known, question)));
    }

    /// Saves the active file under this name, over what is there.
    pub(super) fn save(&mut self, path: PathBuf) {
        self.start_save(path, None);
    }

    /// Starts to save the active file under this name. With a state, the save asks its question if
    /// a file in another state is there.
    fn start_save(&mut self, path: PathBuf, replaces: Option<(Stamp, Question)>) {
        if self.is_writer_busy() {
            return;
        }
        let Some(layer) = self.files.active_mut() else {
            return;
        };
        let accepted = layer.save.accepted_losses(&path);
        let Some(begun) = layer.begin_save() else {
            let notice = t("The file is still being loaded or edited; save again in a moment");
            return self.dialogs.notices.add(notice);
        };
        let BegunSave {
            snapshot,
            base,
            notices,
        } = begun;
        self.notify_all(notices);
        let (known, question) = replaces.unzip();
        self.question_of_write = question;
        let (services, file) = (Arc::clone(&self.context.services), path.clone());
        let write = move || {
            if known.is_some_and(|known| is_unknown(services.file_stamp(&file), known)) {
                return Ok(WriteOutcome::Exists);
            }
            let copied = base.map_or(Ok(()), |base| base.run());
            let is_known = |lost: &LostPart| accepted.iter().any(|known| known.is_same_part(lost));
            let accepts = |losses: &[LostPart]| losses.iter().all(is_known);
            let saved = services.save_layout(&snapshot.to_layout(), &file, &accepts)?;
            Ok(match saved {
                Saved::Written(_) => WriteOutcome::Saved {
                    state: services.file_stamp(&file),
                    copied,
                },
                Saved::TooLossy(losses) => WriteOutcome::TooLossy(losses),
            })
        };
        let (target, repaint) = (WriteTarget::Layout(path), &self.context.repaint);
        self.writer.start(target, None, repaint, write);
    }

    /// Saves the active file under this name, although its format cannot hold these parts.
    pub(super) fn save_lossy(&mut self, path: PathBuf, losses: Vec<LostPart>) {
        if let Some(layer) = self.files.active_mut() {
            layer.save.accept_losses(path.clone(), losses);
            self.save(path);
        }
    }

    /// Ends a write: a save completes or is taken back, and the user learns of it.
    pub(super) fn end_write(&mut self, written: Written) {
        let question = self.question_of_write.take();
        match (written.target, written.result) {
            (WriteTarget::Layout(path), Ok(WriteOutcome::Saved { state, copied })) => {
                let saved = say!("Saved {name}", name = shown_path(&path));
                self.end_save(Some(SavedFile {
                    path,
                    state,
                    copied,
                }));
                self.dialogs.notices.inform(saved);
            }
            (WriteTarget::Layout(path), unsaved) => {
                self.end_save(None);
                self.dialogs.leave.close();
                match unsaved {
                    Ok(WriteOutcome::TooLossy(losses)) => self.dialogs.losses.ask(path, losses),
                    unsaved => self.tell_end(unsaved, question),
                }
            }
            (WriteTarget::Project(path), Ok(WriteOutcome::Written(text))) => {
                self.dialogs.notices.inform(text);
                self.end_project_save(path);
            }
            (_, result) => self.tell_end(result, question),
        }
    }

    fn end_save(&mut self, saved: Option<SavedFile>) {
        let notices = self.files.end_save(saved);
        self.notify_all(notices);
    }

    /// Tells the end of a write, or asks the question of one that would replace a file.
    fn tell_end(&mut self, result: Result<WriteOutcome, UserError>, question: Option<Question>) {
        match (result, question) {
            (Ok(WriteOutcome::Written(text)), _) => self.dialogs.notices.inform(text),
            (Ok(WriteOutcome::Exists), Some(question)) => self.dialogs.confirm.ask(question),
            (Err(error), _) => self.dialogs.notices.add(error.to_string()),
            // Only saves of layouts have other ends.
            _ => {}
        }
    }
}
