use eframe::egui::{Key, Modifiers};

use super::content::content;
use super::desk::Desk;
use super::hand::{Chance, act, calm_down, keep_open};
use super::table::lanes;

/// Events of the run: some minutes of a very busy person.
const EVENTS: usize = 3_000;

#[test]
fn nothing_that_hands_can_do_breaks_it() {
    let mut desk = Desk::looking_at(lanes(40));
    let before = content(&desk.document().to_layout());
    // The file must stay what it is, whatever menu is reached.
    *desk.table.is_full.lock().unwrap() = true;
    let mut chance = Chance(7);
    let mut with_changes = 0;
    for _ in 0..EVENTS {
        act(&mut desk, &mut chance);
        keep_open(&mut desk, "site.arrow");
        with_changes += usize::from(desk.document().is_changed());
    }
    assert!(
        with_changes > EVENTS / 10,
        "too little was done: {with_changes} of {EVENTS}"
    );
    calm_down(&mut desk);
    let after = content(&desk.document().to_layout());
    let steps = std::iter::from_fn(|| desk.document().undo()).count();
    let undone = content(&desk.document().to_layout());
    assert_eq!(undone, before, "all of it can be undone");
    for _ in 0..steps {
        desk.document().redo();
    }
    let done_again = content(&desk.document().to_layout());
    assert_eq!(done_again, after, "and done again");
    // The picture is that of the layout as it is now.
    desk.app().look = crate::app::Look::default();
    desk.document().show_all();
    desk.key(Modifiers::NONE, Key::F);
    let all = desk.document().scene().draw_order().len() as u64;
    desk.wait(|app| {
        app.layers[0]
            .shown
            .as_ref()
            .is_some_and(|shown| shown.report.drawn == all)
    });
}
