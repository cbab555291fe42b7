//! Hands that do anything, the same on every machine for one seed.

use eframe::egui::{Event, Key, Modifiers, Pos2, Vec2};

use super::desk::Desk;
use crate::app::command::{Command, ENTRIES};

/// SplitMix64 (Steele, Lea, Flood 2014).
pub(super) struct Chance(pub(super) u64);

impl Chance {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    pub(super) fn below(&mut self, end: usize) -> usize {
        (self.next() % end as u64) as usize
    }

    /// A place in the picture: beside it are buttons that close the file, which ends the run too early.
    fn place(&mut self) -> Pos2 {
        Pos2::new(self.below(880) as f32, 40.0 + self.below(720) as f32)
    }
}

/// Doubling for ever would fill any memory.
const MOST_POINTS: usize = 20_000;

/// Does something with mouse, keys or window, and says what.
pub(super) fn act(desk: &mut Desk, chance: &mut Chance) -> &'static str {
    let at = chance.place();
    let what = match chance.below(12) {
        0 => {
            desk.click(at);
            "click"
        }
        1 | 2 => {
            let to = chance.place();
            desk.drag(at, to);
            "drag"
        }
        3 => {
            desk.wheel(at, chance.below(9) as f32 - 4.0);
            "wheel"
        }
        4 => {
            resize(desk, chance);
            "resize"
        }
        5 => {
            desk.harness.event(Event::Text("speed > 3".into()));
            "text"
        }
        6 => {
            desk.harness.event(Event::PointerGone);
            "pointer gone"
        }
        _ => {
            press(desk, chance);
            "key"
        }
    };
    desk.harness.step();
    what
}

fn resize(desk: &mut Desk, chance: &mut Chance) {
    let sizes = [
        (0, 0),
        (1, 1),
        (300, 200),
        (1200, 800),
        (8192, 200),
        (200, 8192),
    ];
    let (width, height) = sizes[chance.below(sizes.len())];
    let size = Vec2::new(width as f32, height as f32);
    desk.harness.set_size(size);
    desk.harness.step();
    desk.harness.set_size(Vec2::new(1200.0, 800.0));
}

/// Presses the keys of any command that neither ends the run nor reads or writes files.
fn press(desk: &mut Desk, chance: &mut Chance) {
    let entry = &ENTRIES[chance.below(ENTRIES.len())];
    let geometry = desk.document().layout().paths.geometry();
    let is_too_much = matches!(entry.command, Command::Duplicate | Command::Refine)
        && geometry.point_count() > MOST_POINTS;
    let ends_the_run = matches!(
        entry.command,
        Command::Quit | Command::Close | Command::Reload | Command::Save | Command::SaveAs
    );
    if !is_too_much && !ends_the_run {
        desk.key(entry.shortcut.modifiers, entry.shortcut.logical_key);
    }
}

/// Hands that reach the menus by keys may close the file, or open another one: then they begin again.
pub(super) fn keep_open(desk: &mut Desk, file: &str) {
    desk.app().layers.retain(|layer| layer.is_at(file.as_ref()));
    desk.app().active = 0;
    if desk.app().layers.is_empty() {
        desk.app().open(file.into());
    }
    if desk.app().document().is_none() {
        desk.wait(|app| app.document().is_some());
    }
}

/// Leaves every question and every field.
pub(super) fn calm_down(desk: &mut Desk) {
    for _ in 0..3 {
        desk.key(Modifiers::NONE, Key::Escape);
    }
}
