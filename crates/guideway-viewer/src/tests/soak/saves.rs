//! Saves that overlap with edits and with the watcher.

use std::sync::mpsc;
use std::thread;
use std::time::Duration;

use eframe::egui::{Key, Modifiers};
use guideway_document::{Document, SelectMode};

use super::Soak;

#[test]
fn save_that_ends_during_an_edit_loses_nothing() {
    let mut soak = Soak::new(3);
    soak.window.app().edit_wait = Duration::ZERO;
    let delete_one = |document: &mut Document, row: u32| {
        document.select([row].into_iter().collect(), SelectMode::Replace);
        document.delete_selection()
    };
    soak.window.edit(move |document| delete_one(document, 0));
    soak.window.wait(|app| app.document().is_some());
    soak.window.key(Modifiers::COMMAND, Key::S);
    let (finish, rest) = mpsc::channel::<()>();
    soak.window.edit(move |document| {
        rest.recv().expect("the test lets it go on");
        delete_one(document, 1)
    });
    soak.window.wait(|app| !app.writer.is_busy());
    assert!(soak.window.app().document().is_none());
    finish.send(()).unwrap();
    soak.window.wait(|app| app.document().is_some());
    let saved = soak.store.layout(&soak.store.file).unwrap();
    assert_eq!(saved.paths.len(), soak.first.paths.len() - 1);
    assert!(soak.window.document().is_changed());
    soak.window.app().edit_wait = Duration::from_secs(60);
    assert_eq!(soak.crash(), Ok(()));
}

#[test]
fn own_save_does_not_count_as_a_foreign_change() {
    let mut soak = Soak::new(3);
    soak.window.document().select_all();
    soak.window.document().delete_selection().unwrap();
    soak.window.key(Modifiers::COMMAND, Key::S);
    // Longer than two intervals of the watcher.
    thread::sleep(Duration::from_millis(2500));
    soak.window.wait(|app| !app.writer.is_busy());
    thread::sleep(Duration::from_millis(100));
    soak.window.harness.run_steps(3);
    assert!(!soak.window.app().files.layers()[0].is_loading());
    let notices = soak.window.app().dialogs.notices.texts();
    assert!(
        !notices.iter().any(|text| text.contains("changed on disk")),
        "{notices:?}"
    );
    assert!(
        soak.window.document().undo().is_some(),
        "it can still be undone"
    );
}
