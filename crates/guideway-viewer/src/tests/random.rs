use eframe::egui::{Event, Key, Modifiers, Pos2, Vec2};

use super::desk::Desk;
use super::table::lanes;
use crate::app::command::{Command, ENTRIES};

/// Events of the run: some minutes of a very busy person.
const EVENTS: usize = 3_000;

/// SplitMix64 (Steele, Lea, Flood 2014): the same run on every machine.
struct Chance(u64);

impl Chance {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn below(&mut self, end: usize) -> usize {
        (self.next() % end as u64) as usize
    }

    /// A place in the picture: beside it are buttons that close the file, which ends the run too early.
    fn place(&mut self) -> Pos2 {
        Pos2::new(self.below(880) as f32, 40.0 + self.below(720) as f32)
    }
}

/// Hands that reach the menus by keys may close the file, or open another one: then they begin again.
fn keep_open(desk: &mut Desk) {
    desk.app().layers.truncate(1);
    desk.app().active = 0;
    if desk.app().layers.is_empty() {
        desk.app().open("site.arrow".into());
        desk.wait(|app| app.document().is_some());
    }
}

/// The whole of a layout, as text.
fn content(desk: &mut Desk) -> String {
    let layout = desk.document().to_layout();
    let path = |path: guideway_layout::PathRef<'_>| {
        let points: Vec<_> = path.runs().flat_map(|run| run.iter()).collect();
        format!("{} {points:?}\n", path.id())
    };
    let nodes =
        (0..layout.nodes.len() as u32).map(|n| format!("{:?}\n", layout.nodes.position_m(n)));
    layout.paths.iter().map(path).chain(nodes).collect()
}

#[test]
fn nothing_that_hands_can_do_breaks_it() {
    let mut desk = Desk::looking_at(lanes(40));
    let before = content(&mut desk);
    // The file must stay what it is, whatever menu is reached.
    *desk.table.is_full.lock().unwrap() = true;
    let mut chance = Chance(7);
    let mut with_changes = 0;
    for _ in 0..EVENTS {
        let at = chance.place();
        match chance.below(12) {
            0 => desk.click(at),
            1 | 2 => {
                let to = chance.place();
                desk.drag(at, to);
            }
            3 => desk.wheel(at, chance.below(9) as f32 - 4.0),
            4 => {
                let sizes = [
                    (0, 0),
                    (1, 1),
                    (300, 200),
                    (1200, 800),
                    (8192, 200),
                    (200, 8192),
                ];
                let (width, height) = sizes[chance.below(sizes.len())];
                desk.harness
                    .set_size(Vec2::new(width as f32, height as f32));
                desk.harness.step();
                desk.harness.set_size(Vec2::new(1200.0, 800.0));
            }
            5 => desk.harness.event(Event::Text("speed > 3".into())),
            6 => desk.harness.event(Event::PointerGone),
            _ => {
                let entry = &ENTRIES[chance.below(ENTRIES.len())];
                // Doubling for ever would fill any memory, and the run must not end early.
                let is_too_much = matches!(entry.command, Command::Duplicate | Command::Refine)
                    && desk.document().layout().paths.geometry().point_count() > 20_000;
                let ends_the_run = matches!(
                    entry.command,
                    Command::Quit
                        | Command::Close
                        | Command::Reload
                        | Command::Save
                        | Command::SaveAs
                );
                if !is_too_much && !ends_the_run {
                    desk.key(entry.shortcut.modifiers, entry.shortcut.logical_key);
                }
            }
        }
        desk.harness.step();
        keep_open(&mut desk);
        with_changes += usize::from(desk.document().is_changed());
    }
    assert!(
        with_changes > EVENTS / 10,
        "too little was done: {with_changes} of {EVENTS}"
    );
    desk.key(Modifiers::NONE, Key::Escape);
    let after = content(&mut desk);
    let steps = std::iter::from_fn(|| desk.document().undo()).count();
    assert_eq!(content(&mut desk), before, "all of it can be undone");
    for _ in 0..steps {
        desk.document().redo();
    }
    assert_eq!(content(&mut desk), after, "and done again");
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
