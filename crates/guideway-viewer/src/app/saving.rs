//! Saving: checks what a save would lose, asks, writes, and ends the save.

use std::path::PathBuf;
use std::sync::Arc;

use guideway_layout::shown_path;

use super::state::App;
use crate::action::Action;
use crate::command::Command;
use crate::file_purpose::PromptKind;
use crate::files::{DEFAULT_EXTENSION, WriteOutcome, Written};
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
        let on_disk = self.context.services.file_stamp(&path);
        let risk = match layer.is_at(&path) && !layer.is_untitled() {
            true if layer.save.is_changed_by_others(on_disk) => Some(Risk::OverwritesChanges),
            false if on_disk.is_some() => Some(Risk::ReplacesFile(Command::SaveAs)),
            _ => None,
        };
        match risk {
            Some(risk) => self.dialogs.confirm.ask(Question {
                file: path.clone(),
                risk,
                confirmed: Action::SaveOver(path),
            }),
            None => self.save(path),
        }
    }

    /// Saves the active file under this name.
    pub(super) fn save(&mut self, path: PathBuf) {
        if self.is_writer_busy() {
            return;
        }
        let Some(layer) = self.files.active_mut() else {
            return;
        };
        let accepted = layer.save.accepted_losses(&path);
        let Some((snapshot, notices)) = layer.begin_save() else {
            let notice = t("The file is still being loaded or edited; save again in a moment");
            return self.dialogs.notices.add(notice);
        };
        for notice in notices {
            self.dialogs.notices.add(notice);
        }
        let (services, file) = (Arc::clone(&self.context.services), path.clone());
        let write = move || {
            let is_known = |lost: &LostPart| accepted.iter().any(|known| known.is_same_part(lost));
            let accepts = |losses: &[LostPart]| losses.iter().all(is_known);
            let saved = services.save_layout(&snapshot.to_layout(), &file, &accepts)?;
            Ok(match saved {
                Saved::Written(_) => {
                    WriteOutcome::Written(say!("Saved {name}", name = shown_path(&file)))
                }
                Saved::TooLossy(losses) => WriteOutcome::TooLossy(losses),
            })
        };
        self.writer
            .start(Some(path), None, &self.context.repaint, write);
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
        let is_written = matches!(written.result, Ok(WriteOutcome::Written(_)));
        if let Some(path) = &written.layout_path {
            let saved_as = is_written.then(|| path.clone());
            let notices = self.files.end_save(saved_as);
            self.notify_all(notices);
        }
        if !is_written {
            self.dialogs.leave.close();
        }
        match written.result {
            Ok(WriteOutcome::Written(text)) => self.dialogs.notices.inform(text),
            Ok(WriteOutcome::TooLossy(losses)) => {
                if let Some(path) = written.layout_path {
                    self.dialogs.losses.ask(path, losses);
                }
            }
            Err(error) => self.dialogs.notices.add(error.to_string()),
        }
    }
}
