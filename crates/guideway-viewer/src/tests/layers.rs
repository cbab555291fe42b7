//! The Layers tab: several files at once, their kinds of elements, levels, colors and order.

use eframe::egui::accesskit::Toggled;
use eframe::egui::{Event, Key, Modifiers, Shape};
use egui_kittest::kittest::{NodeT, Queryable};
use guideway_layout::{Layout, Level};
use guideway_scene::Rgba;
use guideway_spline::Affine;

use super::services::{TestServices, lanes};
use super::test_window::{TestWindow, has_notice};
use crate::canvas::HOVER_COLOR;
use crate::editing::MarkedSeverities;
use crate::files::LayerLook;
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
fn pointer_means_what_is_shown_of_other_files() {
    let mut window = two_files();
    // Pins over nodes would tell their findings.
    window.app().findings.marked = MarkedSeverities([false; 3]);
    let (node, path) = (window.at(0.0, 4.0), window.at(5.0, 4.0));
    let says = |window: &mut TestWindow, at, text: &str| {
        window.wait(|app| app.is_settled());
        window.harness.event(Event::PointerMoved(at));
        window.harness.run_steps(3);
        let hint = format!("{text}, in low.arrow (a click edits this file)");
        window.harness.query_by_label_contains(&hint).is_some()
    };
    let rings = |window: &TestWindow| {
        let shapes = window.harness.output().shapes.iter();
        let rings = shapes.filter(|shape| match &shape.shape {
            Shape::Circle(circle) => circle.stroke.color == HOVER_COLOR,
            _ => false,
        });
        rings.count()
    };
    assert!(says(&mut window, node, "node n2 0") && rings(&window) == 1);
    assert!(!says(&mut window, path, "node") && rings(&window) == 0);
    // The paths of the file are hidden: its nodes are still there.
    window.app().files.layers_mut()[0].look.has_paths = false;
    assert!(says(&mut window, node, "node n2 0"));
    window.harness.event(Event::PointerMoved(path));
    window.harness.run_steps(3);
    assert!(window.app().other_hit.is_none(), "no path is shown");
    window.click(path);
    assert_eq!(window.app().files.active_index(), 1);
    // The other way round.
    let look = &mut window.app().files.layers_mut()[0].look;
    (look.has_paths, look.has_nodes) = (true, false);
    assert!(!says(&mut window, node, "node n2 0"));
    window.app().files.layers_mut()[0].look = LayerLook {
        has_paths: false,
        ..LayerLook::default()
    };
    window.wait(|app| app.is_settled());
    window.click(node);
    assert_eq!(window.app().files.active_index(), 0);
    let selected = window.document().selected();
    assert_eq!(selected.nodes.iter().collect::<Vec<_>>(), [4]);
    // A click means no path that is not shown.
    window.click(path);
    assert!(window.selected().is_empty());
}

#[test]
fn legends_name_their_files() {
    let mut window = two_files();
    window.app().settings.color_by = Some("speed".into());
    window.app().recolor();
    window.wait(|app| app.is_settled());
    window.harness.run_steps(2);
    let titles = |window: &TestWindow| {
        let shapes = window.harness.output().shapes.iter();
        let texts = shapes.filter_map(|shape| match &shape.shape {
            Shape::Text(text) if text.galley.text().ends_with("speed") => {
                Some((text.galley.text().to_owned(), text.pos.y))
            }
            _ => None,
        });
        texts.collect::<Vec<_>>()
    };
    let [(upper, above), (lower, below)] = &titles(&window)[..] else {
        panic!("there are two: {:?}", titles(&window));
    };
    assert_eq!(
        [&**upper, &**lower],
        ["high.arrow: speed", "low.arrow: speed"]
    );
    assert!(below - above > 40.0, "none is over the other");
    let picture = window.app().picture().unwrap();
    let texts: Vec<&str> = picture.marks.texts.iter().map(|of| &*of.text).collect();
    assert!(texts.contains(&"high.arrow: speed") && texts.contains(&"low.arrow: speed"));
    assert!(!picture.has_legend, "they are among the marks");
    window.app().files.layers_mut()[0].is_visible = false;
    window.harness.run_steps(2);
    let titles = titles(&window).into_iter().map(|(title, _)| title);
    assert_eq!(titles.collect::<Vec<_>>(), ["speed"]);
    assert!(window.app().picture().unwrap().has_legend);
}

#[test]
fn opacity_of_a_file_is_that_of_its_picture_and_marks() {
    let mut window = two_files();
    let alphas = |window: &mut TestWindow| {
        window.wait(|app| app.is_settled());
        window.harness.run_steps(2);
        let app = window.app();
        let textures = [0, 1].map(|file: usize| {
            let shown = app.files.layers()[file].picture.shown();
            shown.unwrap().texture_id()
        });
        let shapes: Vec<_> = window.harness.output().shapes.iter().collect();
        textures.map(|texture| {
            let mut tints = shapes.iter().filter_map(|shape| match &shape.shape {
                Shape::Mesh(mesh) if mesh.texture_id == texture => Some(mesh.vertices[0].color.a()),
                _ => None,
            });
            tints.next().expect("the file is painted")
        })
    };
    assert_eq!(alphas(&mut window), [255, 255]);
    let alpha_of_name = |window: &TestWindow, name: &str| {
        let shapes = window.harness.output().shapes.iter();
        let mut colors = shapes.filter_map(|shape| match &shape.shape {
            Shape::Text(text) if text.galley.text() == name => text.override_text_color,
            _ => None,
        });
        colors.next_back().expect("the name is painted").a()
    };
    let [below, above] = ["n4 0", "n0 0"];
    assert_eq!(alpha_of_name(&window, below), 255);
    window.app().files.layers_mut()[0].look.opacity = 0.4;
    assert_eq!(alphas(&mut window), [102, 255]);
    assert_eq!(alpha_of_name(&window, below), 102);
    assert_eq!(alpha_of_name(&window, above), 255);
    let picture = window.app().picture().unwrap();
    assert!((picture.others[0].opacity - 0.4).abs() < 1e-6);
    assert_eq!(picture.opacity, 1.0);
    let alpha = |name: &str| {
        // The name of the upper file is the last one.
        let mut texts = picture.marks.texts.iter();
        texts.rfind(|text| text.text == name).unwrap().color.a
    };
    assert_eq!((alpha(below), alpha(above)), (102, 255));
    window.app().files.layers_mut()[0].look.opacity = 1.0;
    window.app().files.layers_mut()[1].look.opacity = 0.25;
    let picture = window.app().picture().unwrap();
    assert_eq!((picture.others[0].opacity, picture.opacity), (1.0, 0.25));
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
    let names = |window: &mut TestWindow| {
        let layers = window.app().files.layers().iter();
        layers.map(|layer| layer.name()).collect::<Vec<_>>()
    };
    assert_eq!(names(&mut window), ["high.arrow", "low.arrow"]);
    // And up again; the first one cannot go up.
    let buttons: Vec<_> = window.harness.get_all_by_label("↑").collect();
    let is_possible = buttons.iter().map(|up| !up.accesskit_node().is_disabled());
    assert_eq!(is_possible.collect::<Vec<_>>(), [false, true]);
    buttons[1].click();
    drop(buttons);
    window.harness.run_steps(3);
    assert_eq!(names(&mut window), ["low.arrow", "high.arrow"]);
    assert_eq!(window.app().files.active_index(), 0);
    window.app().files.move_layer(0, 1);
    window.harness.run_steps(3);
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
