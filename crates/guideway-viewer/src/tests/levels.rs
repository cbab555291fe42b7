//! The current level: what is drawn goes there, and only it can be seen, hit and snapped to.

use eframe::egui::accesskit::Role;
use eframe::egui::{Key, Modifiers};
use egui_kittest::kittest::{By, Queryable};
use guideway_document::Document;
use guideway_layout::{Layout, Level};
use guideway_spline::Point;

use super::services::lanes;
use super::test_window::TestWindow;
use crate::panels::SideTab;

const NONE: Modifiers = Modifiers::NONE;

/// Two lanes on two levels: one along y = 0 in the hall, one along y = 2 upstairs.
pub(super) fn two_levels() -> Layout {
    let lanes = lanes(2);
    let level = |id: &str| Level {
        id: id.into(),
        ..Level::default()
    };
    let mut layout = Layout {
        levels: vec![level("hall"), level("upper")],
        ..Layout::default()
    };
    for row in 0..2u32 {
        let nodes = [2 * row, 2 * row + 1];
        for node in nodes {
            let at_m = lanes.nodes.position_m(node);
            layout.nodes.push(lanes.nodes.id(node), at_m, Some(row));
        }
        let path = lanes.paths.get(row as usize);
        let mut runs = guideway_spline::Runs::default();
        path.copy_runs(&mut runs);
        layout.paths.push(&guideway_layout::NewPath {
            id: path.id(),
            runs: &runs,
            start_node: Some(nodes[0]),
            end_node: Some(nodes[1]),
            level: Some(row),
            ..guideway_layout::NewPath::default()
        });
    }
    layout
}

/// Chooses a level in the drawing bar.
fn choose(window: &mut TestWindow, shown: &str, level: &str) {
    window
        .harness
        .get(By::new().role(Role::ComboBox).value(shown))
        .click();
    window.harness.run_steps(3);
    window.harness.get_by_label(level).click();
    window.harness.run_steps(3);
}

#[test]
fn what_is_drawn_goes_to_the_chosen_level() {
    let mut window = TestWindow::showing(two_levels());
    window.change(|document| document.show_level(Some(1)));
    window.key(NONE, Key::D);
    // Nodes of the hall are no targets.
    for (x, y) in [(0.0, 0.0), (5.0, 1.0)] {
        let at = window.at(x, y);
        window.click(at);
    }
    window.key(NONE, Key::Enter);
    let document = window.document();
    let path = document.layout().paths.get(2);
    let nodes = [path.start_node(), path.end_node()].map(Option::unwrap);
    assert!(nodes.iter().all(|&node| node >= 4), "{nodes:?}");
    let levels = nodes.map(|node| document.layout().nodes.level(node));
    assert_eq!((path.level(), levels), (Some(1), [Some(1); 2]));
    assert_eq!(document.layout().levels.len(), 2, "no level is invented");
}

#[test]
fn only_the_chosen_level_is_shown_hit_and_selected() {
    let mut window = TestWindow::showing(two_levels());
    window.change(|document| document.show_level(Some(0)));
    let shown = |document: &Document| document.scene().draw_order().to_vec();
    assert_eq!(shown(window.document()), [0]);
    let (hall, upper) = (window.at(5.0, 0.0), window.at(5.0, 2.0));
    let upper_node = window.at(10.0, 2.0);
    window.click(upper);
    assert!(window.document().selected().is_empty());
    window.click(upper_node);
    assert!(
        window.document().selected().is_empty(),
        "its node cannot be hit"
    );
    window.click(hall);
    assert_eq!(window.selected(), [0]);
    window.wait(|app| app.files.is_settled());
    let marks = |window: &mut TestWindow| {
        let layer = &window.app().files.layers()[0];
        layer.slot.overlay().last().unwrap().marks.nodes.len()
    };
    assert_eq!(marks(&mut window), 2);
    // Hidden paths of the level come back, others do not.
    window.key(NONE, Key::H);
    window.key(NONE, Key::U);
    assert_eq!(shown(window.document()), [0]);
    window.change(|document| document.show_level(None));
    assert_eq!(shown(window.document()).len(), 2);
    window.wait(|app| app.files.is_settled());
    assert_eq!(marks(&mut window), 4);
}

#[test]
fn on_all_levels_the_node_decides() {
    let mut window = TestWindow::showing(two_levels());
    for (from, level) in [
        ((10.0, 2.0), Some(1)),
        ((10.0, 0.0), Some(0)),
        ((4.0, 1.0), Some(0)),
    ] {
        window.key(NONE, Key::D);
        let at = window.at(from.0, from.1);
        window.click(at);
        let at = window.at(from.0 - 0.7, from.1 + 0.9);
        window.click(at);
        window.key(NONE, Key::Enter);
        let row = window.selected()[0];
        let path = window.document().layout().paths.get(row as usize);
        assert_eq!(path.level(), level, "from {from:?}");
    }
}

#[test]
fn level_is_chosen_in_the_bar_and_elements_move_to_another() {
    let mut window = TestWindow::showing(two_levels());
    choose(&mut window, "all", "upper");
    assert_eq!(window.document().level(), Some(1));
    let at = window.at(5.0, 2.0);
    window.click(at);
    let ctx = window.harness.ctx.clone();
    window
        .app()
        .perform(crate::command::Command::MoveToLevel, &ctx);
    window.answer("hall");
    let document = window.document();
    assert_eq!(document.layout().paths.get(1).level(), Some(0));
    assert!(
        document.scene().draw_order().is_empty(),
        "nothing is left on the shown level"
    );
    let node = document.node_near(Point::new(0.0, 2.0), 0.1);
    assert_eq!(node, None);
}

#[test]
fn several_levels_are_shown_beside_each_other() {
    let mut window = TestWindow::showing(two_levels());
    window.app().side.open(SideTab::Layers);
    window.harness.run_steps(3);
    let shown = |window: &mut TestWindow| window.document().scene().draw_order().to_vec();
    let switch = "Shows hall beside other levels";
    window.harness.get_by_label(switch).click();
    window.harness.run_steps(3);
    assert_eq!(shown(&mut window), [1]);
    let level = window.document().level();
    assert_eq!(level, Some(1), "paths are drawn on a level that is shown");
    window.harness.get_by_label(switch).click();
    window.harness.run_steps(3);
    assert_eq!(shown(&mut window).len(), 2);
    assert_eq!(window.document().level(), Some(1), "paths go there still");
    let choice = "Shows hall alone, and draws on it";
    window.harness.get_by_label(choice).click();
    window.harness.run_steps(3);
    assert_eq!(shown(&mut window), [0]);
    window.harness.get_by_label("All levels").click();
    window.harness.run_steps(3);
    assert_eq!(
        (shown(&mut window).len(), window.document().level()),
        (2, None)
    );
}
