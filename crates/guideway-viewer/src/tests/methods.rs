//! The choice of the render method, and the fallback when a device is lost.

use eframe::egui::{Event, Key, Modifiers, Vec2};
use egui_kittest::kittest::Queryable;

use super::services::{TestServices, lanes};
use super::test_window::TestWindow;
use crate::panels::SideTab;

const NONE: Modifiers = Modifiers::NONE;
const CTRL: Modifiers = Modifiers::COMMAND;

/// The method that rendered the picture of the first file.
fn rendered_by(app: &crate::app::App) -> Option<&'static str> {
    Some(app.files.layers()[0].picture.shown()?.report.method)
}

#[test]
fn selects_the_best_method_and_lets_the_user_choose() {
    let disk = TestServices::with([("site.arrow", lanes(3))]);
    let mut window = TestWindow::open(&disk, &["site.arrow"], None);
    window.wait(|app| rendered_by(app) == Some("device"));
    assert_eq!(window.app().methods.name(), "device");
    window.app().side.open(SideTab::View);
    window.harness.run_steps(2);
    window.harness.get_by_label("Rendering").click();
    window.harness.run_steps(8);
    window.harness.get_by_label("Render method").click();
    window.harness.run_steps(8);
    window.harness.get_by_label("cpu").click();
    window.wait(|app| rendered_by(app) == Some("cpu"));
}

#[test]
fn cpu_replaces_a_lost_device_for_all_files() {
    let disk = TestServices::with([("a.arrow", lanes(3)), ("b.arrow", lanes(4))]);
    let mut window = TestWindow::open(&disk, &["a.arrow", "b.arrow"], None);
    window.wait(|app| {
        rendered_by(app) == Some("device") && app.files.layers()[1].picture.shown().is_some()
    });
    window.wait(|app| app.document().is_some());
    window.key(CTRL, Key::A);
    window.key(NONE, Key::R);
    disk.lose_device();
    window.key(NONE, Key::Plus);
    window.wait(|app| rendered_by(app) == Some("cpu"));
    let app = window.app();
    assert_eq!(app.methods.name(), "cpu");
    let said = app
        .dialogs
        .notices
        .texts()
        .iter()
        .filter(|n| n.contains("device was lost") && n.contains("cpu"));
    assert_eq!(said.count(), 1, "{:?}", app.dialogs.notices.texts());
    assert!(app.files.layers()[1].is_changed(), "the edit is kept");
}

#[test]
fn device_lost_during_a_drag_leaves_the_layout_as_it_was_until_the_drop() {
    let disk = TestServices::with([("site.arrow", lanes(5))]);
    let mut window = TestWindow::open(&disk, &["site.arrow"], None);
    window.wait(|app| rendered_by(app) == Some("device") && app.document().is_some());
    let from = window.at(5.0, 4.0);
    window.click(from);
    window.press(from, NONE);
    let to = from + Vec2::new(0.0, 30.0);
    window.harness.event(Event::PointerMoved(to));
    window.harness.run_steps(4);
    disk.lose_device();
    let to = from + Vec2::new(0.0, 40.0);
    window.harness.event(Event::PointerMoved(to));
    window.wait(|app| rendered_by(app) == Some("cpu"));
    assert!(!window.document().is_changed());
    window.release(to, NONE);
    assert!(window.document().is_changed());
}
