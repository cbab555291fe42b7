//! Background work: exports, long edits, overlays, swept areas, floor plans.

use std::sync::{Arc, mpsc};
use std::time::Duration;

use eframe::egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable;
use guideway_document::Document;
use guideway_document::decorations::outline;
use guideway_spline::Point;

use super::services::{TestServices, lanes};
use super::test_window::{TestWindow, has_notice};
use crate::panels::SideTab;
use crate::services::{AppServices, PictureRequest, SweptAreas};

const NONE: Modifiers = Modifiers::NONE;
const CTRL: Modifiers = Modifiers::COMMAND;

#[test]
fn exports_a_large_png_and_cancels_an_export() {
    let mut window = TestWindow::showing(lanes(4));
    let export = |window: &mut TestWindow, width_px| {
        window.key(CTRL, Key::E);
        let prompt = window.app().dialogs.prompt.open_mut().unwrap();
        (prompt.text, prompt.width_px) = ("large.png".into(), width_px);
        window.key(NONE, Key::Enter);
    };
    *window.disk.is_blocked.lock().unwrap() = true;
    export(&mut window, 40_000);
    window.wait(|app| app.writer.job().is_some_and(|job| job.fraction().is_some()));
    window.harness.get_by_label("Cancel").click();
    window.wait(|app| has_notice(app, "large.png was cancelled"));
    assert!(window.disk.pictures.lock().unwrap().is_empty());
    *window.disk.is_blocked.lock().unwrap() = false;
    export(&mut window, 40_000);
    window.wait(|app| has_notice(app, "Wrote large.png, 40000 x"));
    let size = window.disk.pictures.lock().unwrap()[0].1.view.size();
    let seen = window.app().canvas.camera.view().unwrap().size();
    let as_tall = f64::from(seen.height()) / f64::from(seen.width());
    assert!((f64::from(size.height()) - 40_000.0 * as_tall).abs() <= 0.5);
}

#[test]
fn measures_all_movements_without_changing_the_file() {
    let disk = TestServices::with([("site.arrow", lanes(300))]);
    let services: Arc<dyn AppServices> = disk.clone();
    let movements = crate::measure(services, "site.arrow".into(), Some("cpu".into())).unwrap();
    let names: Vec<_> = movements.iter().map(|m| m.name).collect();
    assert_eq!(
        names,
        [
            "still",
            "hover",
            "pan",
            "zoom",
            "drag a hundredth",
            "drag all",
            "zoom, all selected"
        ]
    );
    for movement in &movements {
        assert!(movement.frames_ms.len() == 120 && movement.frames_ms.iter().all(|ms| *ms > 0.0));
        assert!(movement.shown_ms <= movement.settled_ms);
        let is_still = ["still", "hover"].contains(&movement.name);
        assert_eq!(
            movement.pictures_ms.is_empty(),
            is_still,
            "{}",
            movement.name
        );
    }
    let services: Arc<dyn AppServices> = disk;
    let missing = crate::measure(services, "no.arrow".into(), None).unwrap_err();
    assert!(missing.message.contains("no such file"), "{missing}");
}

#[test]
fn long_edits_run_in_order_in_the_background() {
    let mut window = TestWindow::showing(lanes(200));
    window.app().edit_wait = Duration::ZERO;
    for _ in 0..20 {
        let (finish, rest) = mpsc::channel::<()>();
        window.change(move |document| {
            rest.recv().expect("the test holds the sender");
            document.select_all();
        });
        window.edit(Document::delete_selection);
        window.edit(|document: &mut Document| document.undo().map(drop).ok_or("nothing to undo"));
        // Commands meanwhile have no effect on the document.
        for key in [Key::F, Key::H, Key::Escape, Key::Plus] {
            window.key(NONE, key);
        }
        window.edit(|_: &mut Document| Err("refused"));
        assert!(window.app().files.layers()[0].is_busy());
        finish.send(()).unwrap();
        window.wait(|app| !app.files.layers()[0].is_busy());
        window.change(Document::show_all);
        window.wait(|app| !app.files.layers()[0].is_busy());
        // Edits of one task share a notice.
        let is_refusal = |n: &String| n.contains("refused");
        let notices = window.app().dialogs.notices.texts().to_vec();
        window.app().dialogs.notices.clear();
        assert!(notices.iter().any(is_refusal), "{notices:?}");
        let document = window.document();
        assert_eq!(document.scene().draw_order().len(), 200);
        assert_eq!(document.undo_redo_names(), (None, Some("delete")));
        assert!(!document.is_changed());
    }
    window.wait(|app| {
        app.files.layers()[0]
            .picture
            .shown()
            .is_some_and(|s| s.report.hidden == 0)
    });
}

#[test]
fn overlay_is_computed_in_the_background() {
    let mut window = TestWindow::showing(lanes(200));
    window.app().edit_wait = Duration::ZERO;
    for round in 0..40 {
        window.change(Document::select_all);
        window.key(NONE, [Key::Plus, Key::Minus][round % 2]);
        // In one of four rounds the overlay is certainly in progress.
        let slow = (round % 4 == 0).then(|| slow_overlay(&mut window));
        // The edit waits for the task that reads the layout.
        window.edit(Document::delete_selection);
        window.key(NONE, Key::ArrowLeft);
        window.key(CTRL, Key::Z);
        if let Some(finish) = slow {
            assert!(
                window.app().document().is_none(),
                "the edit waits for the overlay"
            );
            drop(finish);
        }
        window.wait(|app| app.files.layers()[0].is_settled());
        let view = window.app().canvas.camera.view().unwrap();
        let document = window.document();
        assert!(!document.is_changed() && document.undo_redo_names().1 == Some("delete"));
        let selected = outline(document, document.selection(), &view);
        let made = window.app().files.layers()[0]
            .slot
            .overlay()
            .last()
            .unwrap();
        assert!(made.view == view && made.selection == selected);
    }
}

/// Repeats the overlay with a task that blocks until the sender is dropped.
fn slow_overlay(window: &mut TestWindow) -> mpsc::Sender<()> {
    window.wait(|app| app.files.layers()[0].is_settled());
    let (finish, rest) = mpsc::channel();
    let app = window.app();
    let repaint = app.context.repaint.clone();
    let layer = &mut app.files.layers_mut()[0];
    layer.slot.block_overlay(&repaint, rest);
    finish
}

#[test]
fn picture_shows_an_edit_before_its_task_ends() {
    let mut window = TestWindow::showing(lanes(4));
    window.app().edit_wait = Duration::ZERO;
    let (finish, rest) = mpsc::channel::<()>();
    window.edit(move |document: &mut Document| {
        document.select_all();
        let done = document.delete_selection();
        rest.recv().expect("the test holds the sender");
        done
    });
    let drawn = |app: &crate::app::App| {
        app.files.layers()[0]
            .picture
            .shown()
            .map(|s| s.report.drawn)
    };
    window.wait(|app| drawn(app) == Some(0));
    assert!(window.app().document().is_none(), "the edit is in progress");
    finish.send(()).unwrap();
    window.wait(|app| app.document().is_some());
    assert!(window.document().is_changed());
}

#[test]
fn swept_areas_follow_the_selection() {
    let mut window = TestWindow::showing(lanes(4));
    let of = |rows: &'static [u32]| {
        move |app: &crate::app::App, disk: &TestServices| {
            let drawn = disk.swept.lock().unwrap();
            app.swept_areas.shown().is_some() && *drawn == rows
        }
    };
    let disk = Arc::clone(&window.disk);
    window.key(NONE, Key::E);
    window.wait(|app| of(&[0, 1, 2, 3])(app, &disk));
    let at = window.at(5.0, 2.0);
    window.click(at);
    window.wait(|app| of(&[1])(app, &disk));
    window.app().swept_areas.vehicle_text = "a truck".into();
    window.wait(|app| {
        app.swept_areas
            .error()
            .is_some_and(|t| t.contains("not a vehicle"))
    });
    assert!(window.app().swept_areas.shown().is_none());
    window.key(NONE, Key::E);
    assert_eq!(window.app().swept_areas.error(), None);
}

#[test]
fn exported_picture_has_all_visible_parts() {
    let disk = TestServices::with([("low.arrow", lanes(2)), ("top.arrow", lanes(3))]);
    let mut window = TestWindow::open(&disk, &["low.arrow", "top.arrow"], Some("cpu"));
    window.wait(|app| {
        app.files
            .layers()
            .iter()
            .all(|layer| layer.document().is_some())
    });
    window.key(CTRL, Key::L);
    window.app().dialogs.prompt.open_mut().unwrap().text = "hall.png@px-per-m=20".into();
    window.key(NONE, Key::Enter);
    window.wait(|app| app.floor_plan.shown().is_some());
    window.key(NONE, Key::E);
    window.key(NONE, Key::F);
    let hall = Point::new(-20.0, -15.0);
    let view = window.app().canvas.camera.view().unwrap();
    assert!(
        view.world_bounds().contains(hall),
        "the floor plan is in the view"
    );
    let export = |window: &mut TestWindow| {
        window.key(CTRL, Key::E);
        window.key(NONE, Key::Enter);
        window.wait(|app| !app.writer.is_busy());
        disk.pictures.lock().unwrap().pop().unwrap().1
    };
    let all = export(&mut window);
    let counts = |e: &PictureRequest| {
        let others = e.others.iter().map(|other| other.scene.path_count());
        (e.scene.path_count(), others.collect::<Vec<_>>())
    };
    assert_eq!(counts(&all), (3, vec![2]));
    assert_eq!(all.floor_plan.as_ref().unwrap().bounds().unwrap().min, hall);
    let vehicle = "2x1.2".parse().unwrap();
    let rows = vec![0, 1, 2];
    assert_eq!(all.swept, Some(SweptAreas { vehicle, rows }));
    assert!(!all.grid.fills.is_empty());
    let names = |e: &PictureRequest| e.marks.texts.iter().any(|text| text.text == "lane 2");
    assert!(names(&all));

    window.key(NONE, Key::PageDown);
    let turned = export(&mut window);
    assert_eq!(counts(&turned), (2, vec![3]), "the active file is on top");
    window.app().floor_plan.is_visible = false;
    window.app().files.layers_mut()[1].is_visible = false;
    for key in [Key::E, Key::G, Key::L] {
        window.key(NONE, key);
    }
    let bare = export(&mut window);
    assert_eq!(counts(&bare), (2, vec![]));
    assert!(bare.floor_plan.is_none() && bare.swept.is_none());
    assert!(bare.grid.fills.is_empty() && !names(&bare));
}

#[test]
fn unreadable_floor_plan_shows_its_error_until_removed() {
    let mut window = TestWindow::showing(lanes(2));
    window.app().side.open(SideTab::Layers);
    set_floor_plan(&mut window, "hall.png");
    window.wait(|app| app.floor_plan.error().is_some());
    assert!(
        window
            .harness
            .query_by_label_contains("not a floor plan")
            .is_some()
    );
    set_floor_plan(&mut window, "");
    window.harness.run_steps(3);
    assert!(
        window
            .harness
            .query_by_label_contains("Floor plan")
            .is_none()
    );
}

fn set_floor_plan(window: &mut TestWindow, text: &str) {
    let app = window.app();
    let context = app.context.clone();
    app.floor_plan
        .set(text, &context.services, &context.repaint);
}
