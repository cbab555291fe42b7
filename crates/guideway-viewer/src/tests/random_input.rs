//! Random mouse and keyboard input, the same on every computer for one seed.

use eframe::egui::{Event, Key, Modifiers, Pos2, Vec2};
use egui_kittest::kittest::Queryable;

use guideway_layout::Layout;
use guideway_spline::Point;

use super::complete_edits::complete;
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
pub(super) const MAX_POINTS: usize = 20_000;

/// Texts for fields, dialogs and the strip of typed points: sound ones and garbage.
const TEXTS: [&str; 18] = [
    "2, 12, 3",
    "ground",
    "upper",
    "n3 0",
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
    let what = match random.below(21) {
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
        11 | 12 => choose(window, random),
        13 => {
            click_elements(window, random);
            "click on elements"
        }
        14 => {
            show_floor_plan(window, random);
            "floor plan"
        }
        15 | 16 => complete(window, random),
        _ => press(window, random),
    };
    window.harness.step();
    what
}

/// Clicks on up to three elements, with Shift all but the first: a command then has something to
/// act on.
fn click_elements(window: &mut TestWindow, random: &mut RandomSource) {
    window.key(Modifiers::NONE, Key::V);
    for number in 0..=random.below(3) {
        let place = element(window.document().layout(), random);
        let Some(place) = place else { return };
        let at = window.at(place.x, place.y);
        // Beside the canvas is the button that closes the file.
        if !window.app().canvas.screen().rect.contains(at) {
            return;
        }
        let modifiers = match number {
            0 => Modifiers::NONE,
            _ => Modifiers::SHIFT,
        };
        window.click_with(at, modifiers);
    }
}

/// The place of a random node, or the start of a random path.
fn element(layout: &Layout, random: &mut RandomSource) -> Option<Point<f64>> {
    let (nodes, paths) = (layout.nodes.len(), layout.paths.len());
    match random.below(2) {
        0 if nodes > 0 => Some(layout.nodes.position_m(random.below(nodes) as u32)),
        _ if paths > 0 => {
            let (start, end) = layout.paths.get(random.below(paths)).ends()?;
            Some((start + end) * 0.5)
        }
        _ => None,
    }
}

/// Types the name of a floor plan, or removes it.
fn show_floor_plan(window: &mut TestWindow, random: &mut RandomSource) {
    let plans = ["hall.png@px-per-m=20,offset=0,0", "no such plan", ""];
    window.key(Modifiers::COMMAND, Key::L);
    window.answer(plans[random.below(plans.len())]);
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

/// Chooses a random entry of a menu that has no shortcut, and answers its dialog, if any. Returns
/// its name.
fn choose(window: &mut TestWindow, random: &mut RandomSource) -> &'static str {
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
    if command == Command::Network {
        make_network(window);
    }
    command.label()
}

/// Makes the network that the panel shows, as a layout of its own.
fn make_network(window: &mut TestWindow) {
    window.wait(|app| app.bottom.network.is_ready(&app.files) || app.bottom.view.is_none());
    window.harness.run_steps(2);
    let button = window.harness.query_by_label("Make the network");
    if let Some(button) = button {
        button.click();
        window.harness.run_steps(3);
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

/// Presses the shortcut of a random command, and answers its dialog, if any. Returns its name.
fn press(window: &mut TestWindow, random: &mut RandomSource) -> &'static str {
    let (command, shortcut) = &SHORTCUTS[random.below(SHORTCUTS.len())];
    if !may_run(window, *command) {
        return "key without effect";
    }
    window.key(shortcut.modifiers, shortcut.logical_key);
    let asks = matches!(command, Command::Array | Command::Fillet | Command::Rename);
    if asks && random.below(2) == 0 {
        window.answer(TEXTS[random.below(TEXTS.len())]);
        // A refused answer stays in its question.
        window.app().dialogs.close();
    }
    command.label()
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
