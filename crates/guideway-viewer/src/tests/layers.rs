//! The Layers tab: several files at once, their kinds of elements, levels, colors and order.

use eframe::egui::accesskit::Toggled;
use eframe::egui::{Event, Key, Modifiers};
use egui_kittest::kittest::{NodeT, Queryable};
use guideway_layout::{Layout, Level};
use guideway_scene::Rgba;
use guideway_spline::Affine;

use super::services::{TestServices, lanes};
use super::test_window::{TestWindow, has_notice};
use crate::panels::SideTab;

const NONE: Modifiers = Modifiers::NONE;

/// Two files, both in view.
fn two_files() -> TestWindow {
    let mut window = started_with_two_files();
    window.key(NONE, Key::F);
    window.wait(|app| app.is_settled());
    window
}

/// Two files: five lanes, and three lanes 20 m above them. The second one is active.
fn started_with_two_files() -> TestWindow {
    let mut above = lanes(3);
    above.paths.transform(
        0..3,
        Affine::translation(guideway_spline::Point::new(0.0, 20.0)),
    );
    for node in 0..6 {
        let at = above.nodes.position_m(node);
        let to = guideway_spline::Point::new(at.x, at.y + 20.0);
        above.nodes.set_position_m(node, to);
    }
    let disk = TestServices::with([("low.arrow", lanes(5)), ("high.arrow", above)]);
    let mut window = TestWindow::open(&disk, &["low.arrow", "high.arrow"], Some("cpu"));
    window.wait(|app| {
        let layers = app.files.layers();
        layers.iter().all(|layer| layer.document().is_some())
    });
    window
}

#[test]
fn click_selects_in_any_visible_file_and_activates_it() {
    let mut window = two_files();
    assert_eq!(window.app().files.active_index(), 1);
    let (low, high) = (window.at(5.0, 4.0), window.at(5.0, 22.0));
    window.harness.event(Event::PointerMoved(low));
    window.harness.run_steps(3);
    let hint = "in low.arrow (a click edits this file)";
    assert!(window.harness.query_by_label_contains(hint).is_some());
    window.click(low);
    assert_eq!(window.app().files.active_index(), 0);
    assert_eq!(window.selected(), [2]);
    window.click(high);
    assert_eq!(window.app().files.active_index(), 1);
    assert_eq!(window.selected(), [1]);
    // Nothing is there: the file stays.
    let nowhere = window.at(5.0, 13.0);
    window.click(nowhere);
    assert_eq!(window.app().files.active_index(), 1);
    assert!(window.selected().is_empty());
    // A hidden file cannot be picked.
    window.app().files.layers_mut()[0].is_visible = false;
    window.click(low);
    assert_eq!(window.app().files.active_index(), 1);
}

#[test]
fn all_visible_files_have_marks_of_the_kinds_that_are_on() {
    let mut window = two_files();
    let counts = |window: &mut TestWindow| {
        window.wait(|app| app.is_settled());
        window.harness.run_steps(2);
        let layers = window.app().files.layers().iter();
        let counts = layers.map(|layer| {
            let marks = &layer.slot.overlay().last().unwrap().marks;
            (marks.nodes.len(), marks.arrows.len())
        });
        counts.collect::<Vec<_>>()
    };
    let all = counts(&mut window);
    assert_eq!((all[0].0, all[1].0), (10, 6));
    assert!(all.iter().all(|(_, arrows)| *arrows > 0));
    window.app().files.layers_mut()[0].look.has_nodes = false;
    window.app().files.layers_mut()[1].look.has_arrows = false;
    let some = counts(&mut window);
    assert_eq!(some, [(0, all[0].1), (6, 0)]);
}

#[test]
fn color_of_a_file_is_that_of_its_paths() {
    let mut window = two_files();
    let red = Rgba::opaque(200, 0, 0);
    window.app().files.layers_mut()[0].look.color = Some(red);
    window.app().recolor();
    window.wait(|app| {
        let color = |file: usize| Some(app.files.layers()[file].document()?.scene().color(0));
        color(0) == Some(red) && color(1).is_some_and(|color| color != red)
    });
}

fn with_levels() -> Layout {
    let mut layout = lanes(4);
    for (id, name) in [("0", "Hall"), ("1", "Mezzanine")] {
        layout.levels.push(Level {
            id: id.into(),
            name: Some(name.into()),
            ..Level::default()
        });
    }
    for row in 0..4 {
        layout.paths.set_level(row, Some(row as u32 / 2));
    }
    layout
}

#[test]
fn level_is_marked_and_shown_alone() {
    let mut window = TestWindow::showing(with_levels());
    window.app().side.open(SideTab::Layers);
    window.harness.run_steps(3);
    let mezzanine = "Shows Mezzanine alone, and draws on it";
    window.harness.get_by_label(mezzanine).click();
    window.harness.run_steps(3);
    assert_eq!(window.document().level(), Some(1));
    assert_eq!(window.document().scene().hidden_count(), 2);
    let is_marked = |window: &TestWindow, name: &str| {
        let label = window.harness.get_by_label(name);
        label.accesskit_node().toggled() == Some(Toggled::True)
    };
    assert!(is_marked(&window, mezzanine) && !is_marked(&window, "All levels"));
    window.harness.get_by_label("All levels").click();
    window.harness.run_steps(3);
    assert_eq!(window.document().scene().hidden_count(), 0);
    assert!(is_marked(&window, "All levels"));
}

#[test]
fn buttons_of_a_row_move_activate_and_close_files() {
    let mut window = two_files();
    window.app().side.open(SideTab::Layers);
    window.harness.run_steps(3);
    window.harness.get_by_label("low.arrow").click();
    window.harness.run_steps(3);
    assert_eq!(window.app().files.active_index(), 0);
    let buttons: Vec<_> = window.harness.get_all_by_label("↓").collect();
    buttons[0].click();
    drop(buttons);
    window.harness.run_steps(3);
    assert_eq!(
        window.app().files.active_index(),
        1,
        "it moved with its file"
    );
    let buttons: Vec<_> = window.harness.get_all_by_label("×").collect();
    buttons[0].click();
    drop(buttons);
    window.harness.run_steps(3);
    let layers = window.app().files.layers();
    assert_eq!(
        (layers.len(), layers[0].name()),
        (1, "low.arrow".to_owned())
    );
}

#[test]
fn view_shows_all_files_until_the_user_moves_it() {
    let mut window = started_with_two_files();
    let sees = |window: &mut TestWindow, y: f64| {
        let seen = window.app().canvas.camera.view().unwrap().world_bounds();
        [0.0, 10.0]
            .iter()
            .all(|&x| seen.contains(guideway_spline::Point::new(x, y)))
    };
    assert!([0.0, 8.0, 20.0, 24.0].iter().all(|&y| sees(&mut window, y)));
    let at = window.at(5.0, 4.0);
    window.wheel(at, 6.0);
    window.harness.run_steps(10);
    assert!(!sees(&mut window, 20.0));
    let before = window.app().canvas.camera.view();
    window.disk.overwrite("far.arrow", lanes(60));
    window.app().open_any("far.arrow".into());
    window.wait(|app| app.files.layers().len() == 3 && app.document().is_some());
    assert_eq!(window.app().canvas.camera.view(), before);
}

#[test]
fn names_of_a_lower_file_do_not_cover_those_of_the_upper_one() {
    let mut below = lanes(2);
    let ids = [(0, "b0"), (1, "b1"), (2, "b2"), (3, "b3")];
    below.nodes.set_ids(&ids);
    let disk = TestServices::with([("below.arrow", below), ("above.arrow", lanes(2))]);
    let mut window = TestWindow::open(&disk, &["below.arrow", "above.arrow"], Some("cpu"));
    window.wait(|app| app.is_settled());
    window.key(NONE, Key::F);
    window.wait(|app| app.is_settled());
    window.key(Modifiers::COMMAND, Key::E);
    window.app().dialogs.prompt.open_mut().unwrap().text = "both.png".into();
    window.key(NONE, Key::Enter);
    window.wait(|app| has_notice(app, "both.png"));
    let pictures = window.disk.pictures.lock().unwrap();
    let texts = pictures[0].1.marks.texts.iter();
    let texts: Vec<&str> = texts.map(|line| &*line.text).collect();
    assert!(texts.contains(&"n0 0"), "{texts:?}");
    assert!(!texts.iter().any(|text| text.starts_with('b')), "{texts:?}");
    let mut distinct = texts.clone();
    distinct.sort_unstable();
    distinct.dedup();
    assert_eq!(distinct.len(), texts.len(), "{texts:?}");
}
