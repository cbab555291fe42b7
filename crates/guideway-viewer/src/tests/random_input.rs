//! Random mouse and keyboard input, the same on every computer for one seed.

use eframe::egui::{Event, Key, Modifiers, Pos2, Vec2};

use super::test_window::TestWindow;
use crate::command::{Command, SHORTCUTS};

/// SplitMix64 (Steele, Lea, Flood 2014).
pub(super) struct RandomSource(pub(super) u64);

impl RandomSource {
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

    /// A point of the canvas: the side panel has a button that closes the file.
    fn place(&mut self) -> Pos2 {
        Pos2::new(self.below(880) as f32, 40.0 + self.below(720) as f32)
    }
}

/// Control points beyond which paths are no longer duplicated or refined.
const MAX_POINTS: usize = 20_000;

/// Sends one random input. Returns its kind.
pub(super) fn act(window: &mut TestWindow, random: &mut RandomSource) -> &'static str {
    let at = random.place();
    let what = match random.below(12) {
        0 => {
            window.click(at);
            "click"
        }
        1 | 2 => {
            let to = random.place();
            window.drag(at, to);
            "drag"
        }
        3 => {
            window.wheel(at, random.below(9) as f32 - 4.0);
            "wheel"
        }
        4 => {
            resize(window, random);
            "resize"
        }
        5 => {
            window.harness.event(Event::Text("speed > 3".into()));
            "text"
        }
        6 => {
            window.harness.event(Event::PointerGone);
            "pointer gone"
        }
        _ => {
            press(window, random);
            "key"
        }
    };
    window.harness.step();
    what
}

fn resize(window: &mut TestWindow, random: &mut RandomSource) {
    let sizes = [
        (0, 0),
        (1, 1),
        (300, 200),
        (1200, 800),
        (8192, 200),
        (200, 8192),
    ];
    let (width, height) = sizes[random.below(sizes.len())];
    let size = Vec2::new(width as f32, height as f32);
    window.harness.set_size(size);
    window.harness.step();
    window.harness.set_size(Vec2::new(1200.0, 800.0));
}

/// Presses the shortcut of a random command that neither ends the run nor reads or writes files.
fn press(window: &mut TestWindow, random: &mut RandomSource) {
    let (command, shortcut) = &SHORTCUTS[random.below(SHORTCUTS.len())];
    let geometry = window.document().layout().paths.geometry();
    let is_too_large = matches!(
        command,
        Command::Duplicate | Command::Refine | Command::Paste | Command::Array
    ) && geometry.point_count() > MAX_POINTS;
    let ends_the_run = matches!(
        command,
        Command::Quit
            | Command::Close
            | Command::Reload
            | Command::Save
            | Command::SaveAs
            | Command::NewLayout
    );
    if !is_too_large && !ends_the_run {
        window.key(shortcut.modifiers, shortcut.logical_key);
    }
}

/// Opens the file again if random input closed it, and closes all others.
pub(super) fn keep_open(window: &mut TestWindow, file: &str) {
    let files = &mut window.app().files;
    let is_other = |layer: &crate::files::Layer| !layer.is_at(file.as_ref());
    while let Some(index) = files.layers().iter().position(is_other) {
        files.close(index);
    }
    files.activate(0);
    if window.app().files.layers().is_empty() {
        window.app().open(file.into());
    }
    if window.app().document().is_none() {
        window.wait(|app| app.document().is_some());
    }
}

/// Closes all dialogs and leaves all fields.
pub(super) fn close_dialogs(window: &mut TestWindow) {
    for _ in 0..3 {
        window.key(Modifiers::NONE, Key::Escape);
    }
}
