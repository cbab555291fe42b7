//! Random input on one file.

use eframe::egui::{Key, Modifiers};

use super::content::content;
use super::random_input::{RandomSource, act, close_dialogs, keep_open};
use super::services::lanes;
use super::test_window::TestWindow;

/// Events of the run: a minute or two of input. The soak goes on from there.
const EVENTS: usize = 1_200;

#[test]
fn random_input_keeps_document_history_and_picture_consistent() {
    let mut window = TestWindow::showing(lanes(40));
    let before = content(&window.document().to_layout());
    // Random input may reach Save, which must not replace the file.
    *window.disk.is_full.lock().unwrap() = true;
    let mut random = RandomSource(7);
    let mut with_changes = 0;
    for _ in 0..EVENTS {
        act(&mut window, &mut random);
        keep_open(&mut window, "site.arrow");
        with_changes += usize::from(window.document().is_changed());
    }
    assert!(
        with_changes > EVENTS / 10,
        "too little was done: {with_changes} of {EVENTS}"
    );
    close_dialogs(&mut window);
    let after = content(&window.document().to_layout());
    let steps = std::iter::from_fn(|| window.document().undo()).count();
    let undone = content(&window.document().to_layout());
    assert_eq!(undone, before, "undo restores the file");
    for _ in 0..steps {
        window.document().redo();
    }
    let done_again = content(&window.document().to_layout());
    assert_eq!(done_again, after, "redo restores the edits");
    // The picture shows the present layout.
    window.app().settings = crate::display_settings::DisplaySettings::default();
    window.document().show_all();
    window.key(Modifiers::NONE, Key::F);
    let all = window.document().scene().draw_order().len() as u64;
    window.wait(|app| {
        app.files.layers()[0]
            .picture
            .shown()
            .is_some_and(|shown| shown.report.drawn == all)
    });
}
