//! Random mouse and keyboard input, the same on every computer for one seed.

use eframe::egui::{Event, Key, Modifiers, Pos2, Vec2};

use super::test_window::TestWindow;
use crate::command::{Command, MENUS, SHORTCUTS, shortcuts_of};
use crate::panels::SideTab;

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

/// Texts for fields, dialogs and the strip of typed points: sound ones and garbage.
const TEXTS: [&str; 14] = [
    "speed > 3",
    "12,3",
    "@2,-1",
    "5<30",
    "r2",
    "1.5",
    "0.4 km/h",
    "-7",
    "1e99",
    "hall 2",
    "tug: 1.5, fork",
    "lane 1",
    "Gr\u{f6}\u{df}e\0",
    "",
];

/// Sends one random input. Returns its kind.
pub(super) fn act(window: &mut TestWindow, random: &mut RandomSource) -> &'static str {
    let at = random.place();
    let what = match random.below(16) {
        0 | 1 => {
            window.click(at);
            "click"
        }
        2 | 3 => {
            let to = random.place();
            window.drag(at, to);
            "drag"
        }
        4 => {
            window.wheel(at, random.below(9) as f32 - 4.0);
            "wheel"
        }
        5 => {
            resize(window, random);
            "resize"
        }
        6 => {
            let text = TEXTS[random.below(TEXTS.len())];
            window.harness.event(Event::Text(text.into()));
            "text"
        }
        7 => {
            window.harness.event(Event::PointerGone);
            "pointer gone"
        }
        8 => {
            window.right_click(at);
            "right click"
        }
        9 | 10 => {
            use_panel(window, random);
            "side panel"
        }
        11 => {
            choose(window, random);
            "menu"
        }
        _ => {
            press(window, random);
            "key"
        }
    };
    window.harness.step();
    what
}

/// Clicks in a tab of the side panel, and types a text that Enter, Tab or Escape ends. The tab of
/// the layers is left out: it closes files.
fn use_panel(window: &mut TestWindow, random: &mut RandomSource) {
    let tabs = [
        SideTab::Properties,
        SideTab::Properties,
        SideTab::Find,
        SideTab::Findings,
        SideTab::View,
    ];
    window.app().side.open(tabs[random.below(tabs.len())]);
    window.harness.step();
    let at = Pos2::new(
        890.0 + random.below(300) as f32,
        70.0 + random.below(500) as f32,
    );
    window.click(at);
    let text = TEXTS[random.below(TEXTS.len())];
    window.harness.event(Event::Text(text.into()));
    window.harness.step();
    let ends = [Key::Enter, Key::Tab, Key::Escape];
    window.key(Modifiers::NONE, ends[random.below(ends.len())]);
}

/// Chooses a random entry of a menu that has no shortcut, and answers its dialog, if any.
fn choose(window: &mut TestWindow, random: &mut RandomSource) {
    let groups = MENUS.iter().flat_map(|menu| menu.groups);
    let commands = groups.flat_map(|group| group.iter().copied());
    let commands: Vec<Command> = commands
        .filter(|command| shortcuts_of(*command).next().is_none() && may_run(window, *command))
        .collect();
    let command = commands[random.below(commands.len())];
    let ctx = window.harness.ctx.clone();
    window.app().perform(command, &ctx);
    window.harness.run_steps(2);
    if random.below(2) == 0 {
        let text = TEXTS[random.below(TEXTS.len())];
        window.harness.event(Event::Text(text.into()));
        window.key(Modifiers::NONE, Key::Enter);
    }
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

/// Presses the shortcut of a random command.
fn press(window: &mut TestWindow, random: &mut RandomSource) {
    let (command, shortcut) = &SHORTCUTS[random.below(SHORTCUTS.len())];
    if may_run(window, *command) {
        window.key(shortcut.modifiers, shortcut.logical_key);
    }
}

/// Returns `true` for a command that neither ends the run, nor reads or writes files, nor makes a
/// large layout larger.
fn may_run(window: &mut TestWindow, command: Command) -> bool {
    let grows = matches!(
        command,
        Command::Duplicate
            | Command::Refine
            | Command::Paste
            | Command::Array
            | Command::Split
            | Command::SplitCrossings
    );
    let ends_the_run = matches!(
        command,
        Command::Quit
            | Command::Close
            | Command::Reload
            | Command::Save
            | Command::SaveAs
            | Command::SaveProject
            | Command::NewLayout
            | Command::ExampleSite
    );
    let points = window.document().layout().paths.geometry().point_count();
    !(ends_the_run || grows && points > MAX_POINTS)
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
