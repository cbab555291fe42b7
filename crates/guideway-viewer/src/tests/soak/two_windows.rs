//! A second window on the file of the soak test.

use eframe::egui::{Key, Modifiers};

use super::super::content::difference;
use super::super::random_input::{act, close_dialogs, keep_open};
use super::{Soak, open_window};
use crate::editing::entries_on_disk;

/// Random events in the second window.
const EVENTS: usize = 5;

impl Soak {
    /// Edits the file in a second window, and saves it there or not. The journal of the first
    /// window must stay as it is; what the second one saved is in the first one after a reload.
    pub(super) fn open_second_window(&mut self) -> Result<(), String> {
        close_dialogs(&mut self.window);
        self.window.wait(|app| !app.writer.is_busy());
        let before = entries_on_disk(&self.store.file);
        let mut second = open_window(&self.store);
        for _ in 0..EVENTS {
            act(&mut second, &mut self.random);
            keep_open(&mut second, &self.file());
        }
        close_dialogs(&mut second);
        let saves = self.random.below(2) == 0;
        if saves {
            second.key(Modifiers::COMMAND, Key::S);
            second.wait(|app| !app.writer.is_busy());
            second.wait(|app| {
                app.document()
                    .is_some_and(|document| !document.is_changed())
            });
        }
        second.app().files.close(0);
        drop(second);
        if entries_on_disk(&self.store.file) != before {
            return Err("a second window changed the journal of the first one".into());
        }
        self.record.count("second window");
        if saves {
            self.window.app().reload(0, true);
            self.window
                .wait(|app| !app.files.layers()[0].is_loading() && app.document().is_some());
            let saved = self.store.layout(&self.store.file);
            let saved = saved.expect("the file is there");
            let lines = difference(&saved, &self.window.document().to_layout());
            if let Some(lines) = lines {
                return Err(format!("a reload differs from the saved file: {lines}"));
            }
        }
        Ok(())
    }
}
