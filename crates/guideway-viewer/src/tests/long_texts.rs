//! Long texts: kept inside of the canvas, wrapped, or cut and told whole under the pointer.

use eframe::egui::accesskit::Role;
use eframe::egui::epaint::TextShape;
use eframe::egui::{Event, Key, Modifiers, Pos2, Rect, Shape, Vec2, pos2};
use egui_kittest::kittest::{By, Queryable};
use guideway_layout::Value;

use super::services::{TestServices, lanes};
use super::test_window::TestWindow;
use crate::command::{Command, MENUS};
use crate::language::Language;
use crate::panels::SideTab;

const NONE: Modifiers = Modifiers::NONE;

/// The painted texts that contain a text, and the rectangles that they are clipped to.
fn painted<'a>(window: &'a TestWindow, text: &str) -> Vec<(&'a TextShape, Rect)> {
    let shapes = window.harness.output().shapes.iter();
    let texts = shapes.filter_map(|shape| match &shape.shape {
        Shape::Text(found) if found.galley.text().contains(text) => Some((found, shape.clip_rect)),
        _ => None,
    });
    texts.collect()
}

/// Returns `true` if a text is painted as a whole.
fn is_told(window: &TestWindow, text: &str) -> bool {
    painted(window, text)
        .iter()
        .any(|(text, _)| !text.galley.elided)
}

/// Moves the pointer to a point of the window and waits for the hint.
fn rest(window: &mut TestWindow, at: Pos2) {
    window.harness.event(Event::PointerMoved(at));
    window.harness.run_steps(8);
}

/// Makes the side panel as narrow as it can be.
fn narrow(window: &mut TestWindow) {
    let rect = window.app().canvas.screen().rect;
    let from = pos2(rect.right() + 1.0, rect.center().y);
    window.drag(from, from + Vec2::new(300.0, 0.0));
    window.harness.run_steps(4);
}

#[test]
fn dimensions_and_snaps_are_inside_of_the_canvas_at_its_edges() {
    let mut window = TestWindow::showing(lanes(3));
    window.key(NONE, Key::M);
    let first = window.at(5.0, 2.0);
    window.click(first);
    window.app().tools.snaps.to_grid = true;
    let canvas = window.app().canvas.screen().rect;
    for at in [
        pos2(canvas.right() - 2.0, canvas.center().y),
        pos2(canvas.center().x, canvas.bottom() - 2.0),
        pos2(canvas.center().x, canvas.top() + 2.0),
        canvas.max - Vec2::splat(2.0),
    ] {
        window.harness.event(Event::PointerMoved(at));
        window.harness.run_steps(2);
        for text in ["°", "grid"] {
            let found = painted(&window, text);
            let inside = found.iter().filter(|(text, clip)| {
                *clip == canvas && clip.contains_rect(text.visual_bounding_rect())
            });
            assert_eq!(inside.count(), 1, "{text} at {at:?}: {found:?}");
        }
    }
}

#[test]
fn cut_texts_of_lists_are_told_under_the_pointer() {
    let mut layout = lanes(3);
    let types = ["fork", "stacker-1200", "tugger-train-of-the-north-hall"];
    layout.paths.vehicle_types_mut().set(1, &types);
    let word = "KINEMATICCENTER";
    layout
        .paths
        .attributes
        .set(1, "corridor.referencePoint", Value::Text(word));
    let mut window = TestWindow::showing(layout);
    // The whole panel is in sight.
    window.harness.set_size(Vec2::new(1200.0, 1600.0));
    narrow(&mut window);
    let at = window.at(5.0, 2.0);
    window.click(at);
    for text in [types.join(", ").as_str(), word] {
        rest(&mut window, at);
        assert!(!is_told(&window, text), "{text} is cut");
        let list = By::new().role(Role::ComboBox).value(text);
        let list = window.harness.get(list).rect();
        rest(&mut window, list.left_center() + Vec2::new(12.0, 0.0));
        assert!(is_told(&window, text), "{text} {list:?}");
    }
    // A text that is not cut has no hint.
    let empty = window.at(5.0, 3.0);
    rest(&mut window, empty);
    let before = painted(&window, "one-way").len();
    let list = By::new().role(Role::ComboBox).value("one-way");
    let list = window.harness.get(list).rect().center();
    rest(&mut window, list);
    assert_eq!(painted(&window, "one-way").len(), before);
}

#[test]
fn long_name_of_a_file_is_cut_and_told_under_the_pointer() {
    let name = "north-hall-with-all-of-its-aisles-and-the-yard-as-of-2026-11-30-final.arrow";
    let disk = TestServices::with([(name, lanes(2))]);
    let mut window = TestWindow::open(&disk, &[name], Some("cpu"));
    window.wait(|app| app.document().is_some());
    window.app().side.open(SideTab::Layers);
    window.harness.run_steps(4);
    let canvas = window.app().canvas.screen().rect;
    let width = window.harness.ctx.content_rect().right();
    let is_row = |text: &&TextShape| text.pos.x > canvas.right();
    let row = |window: &TestWindow| {
        let found = painted(window, name);
        let row = found.iter().map(|(text, _)| *text).find(is_row);
        row.map(|text| (text.galley.elided, text.visual_bounding_rect()))
    };
    let (is_cut, rect) = row(&window).expect("the row of the file");
    let close = window.harness.get_by_label("×").rect();
    assert!(is_cut && rect.right() < close.left(), "{rect:?} {close:?}");
    assert!(close.right() <= width);
    assert!(!is_told(&window, name));
    rest(&mut window, rect.center());
    assert!(is_told(&window, name));
}

#[test]
fn reason_why_a_file_gives_no_swept_area_is_wrapped() {
    let mut layout = lanes(2);
    for side in ["corridor.leftWidth", "corridor.rightWidth"] {
        layout.paths.attributes.set(0, side, Value::Float(0.5));
    }
    let mut window = TestWindow::showing(layout);
    window.app().swept_areas.is_visible = true;
    window.app().swept_areas.vehicle_text = "file".into();
    window.app().side.open(SideTab::View);
    window.wait(|app| app.swept_areas.error().is_some());
    window.harness.run_steps(2);
    let reason = "a corridor for the center of the vehicle, but not its size";
    let found = painted(&window, reason);
    let [(text, clip)] = found[..] else {
        panic!("{found:?}");
    };
    let rect = text.visual_bounding_rect();
    assert!(text.galley.rows.len() > 1 && !text.galley.elided);
    assert!(clip.x_range().contains(rect.left()) && clip.x_range().contains(rect.right()));
}

#[test]
fn all_shortcuts_fit_the_width_of_a_small_window() {
    for language in Language::ALL {
        let mut window = TestWindow::showing(lanes(2));
        window.app().settings.language = Some(language);
        let mut columns = |size: Vec2, scale: f32| {
            window.harness.set_pixels_per_point(scale);
            window.harness.step();
            window.harness.set_size(size);
            window.app().dialogs.shortcuts.is_open = true;
            window.harness.run_steps(6);
            let mut columns = Vec::new();
            for command in MENUS
                .iter()
                .flat_map(|menu| menu.groups.iter().copied().flatten())
            {
                let name = By::new().role(Role::Label).label(command.label());
                let names: Vec<Rect> = window.harness.query_all(name).map(|n| n.rect()).collect();
                let inside = names
                    .iter()
                    .filter(|r| r.left() >= 0.0 && r.right() <= size.x);
                assert!(inside.count() > 0, "{command:?} {names:?}");
                columns.extend(names.iter().map(|rect| rect.left() as i32));
            }
            let ctx = window.harness.ctx.clone();
            window.app().perform(Command::Shortcuts, &ctx);
            window.harness.run_steps(2);
            columns.sort_unstable();
            columns.dedup();
            columns.len()
        };
        assert!(columns(Vec2::new(600.0, 400.0), 2.0) < columns(Vec2::new(1200.0, 800.0), 1.0));
    }
}
