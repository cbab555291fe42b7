use std::sync::mpsc;
use std::thread;
use std::time::Duration;

use eframe::egui::{Key, Modifiers};
use guideway_document::{Document, SelectMode};

use super::Soak;

#[test]
fn a_save_that_ends_while_an_edit_is_done_loses_nothing() {
    let mut soak = Soak::new(3);
    soak.desk.app().patience = Duration::ZERO;
    let delete_one = |document: &mut Document, row: u32| {
        document.select([row].into_iter().collect(), SelectMode::Replace);
        document.delete_selection()
    };
    soak.desk
        .app()
        .edit(move |document| delete_one(document, 0));
    soak.desk.wait(|app| app.document().is_some());
    soak.desk.key(Modifiers::COMMAND, Key::S);
    let (finish, rest) = mpsc::channel::<()>();
    soak.desk.app().edit(move |document| {
        rest.recv().expect("the test lets it go on");
        delete_one(document, 1)
    });
    soak.desk.wait(|app| !app.is_writing());
    assert!(soak.desk.app().document().is_none());
    finish.send(()).unwrap();
    soak.desk.wait(|app| app.document().is_some());
    let saved = soak.shelf.layout(&soak.shelf.file).unwrap();
    assert_eq!(saved.paths.len(), soak.first.paths.len() - 1);
    assert!(soak.desk.document().is_changed());
    soak.desk.app().patience = Duration::from_secs(60);
    assert_eq!(soak.crash(), Ok(()));
}

#[test]
fn a_window_that_sleeps_after_a_save_does_not_take_it_for_the_work_of_others() {
    let mut soak = Soak::new(3);
    soak.desk.document().select_all();
    soak.desk.document().delete_selection().unwrap();
    soak.desk.key(Modifiers::COMMAND, Key::S);
    // Longer than the watcher takes to see that the file has changed and stays so.
    thread::sleep(Duration::from_millis(2500));
    soak.desk.wait(|app| !app.is_writing());
    thread::sleep(Duration::from_millis(100));
    soak.desk.harness.run_steps(3);
    assert!(!soak.desk.app().layers[0].is_reading());
    let notices = &soak.desk.app().notices;
    assert!(
        !notices.iter().any(|text| text.contains("changed on disk")),
        "{notices:?}"
    );
    assert!(
        soak.desk.document().undo().is_some(),
        "it can still be undone"
    );
}
