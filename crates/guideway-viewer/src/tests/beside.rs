//! What goes on beside the window: pictures, long edits, areas.

use std::sync::{Arc, mpsc};
use std::time::Duration;

use eframe::egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable;
use guideway_document::Document;
use guideway_document::decorations::outline;
use guideway_spline::Point;

use super::desk::Desk;
use super::table::{Table, lanes};
use crate::services::{AppServices, PictureRequest, SweptAreas};

const NONE: Modifiers = Modifiers::NONE;
const CTRL: Modifiers = Modifiers::COMMAND;

#[test]
fn a_picture_of_any_size_is_written_and_can_be_stopped() {
    let mut desk = Desk::looking_at(lanes(4));
    let export = |desk: &mut Desk, width_px| {
        desk.key(CTRL, Key::E);
        let prompt = desk.app().prompt.as_mut().unwrap();
        (prompt.text, prompt.width_px) = ("large.png".into(), width_px);
        desk.key(NONE, Key::Enter);
    };
    let said = |app: &crate::App, text: &str| app.notices.iter().any(|n| n.contains(text));
    *desk.table.is_slow.lock().unwrap() = true;
    export(&mut desk, 40_000);
    desk.wait(|app| app.writing().is_some_and(|job| job.fraction().is_some()));
    desk.harness.get_by_label("Cancel").click();
    desk.wait(|app| said(app, "large.png was cancelled"));
    assert!(desk.table.pictures.lock().unwrap().is_empty());
    *desk.table.is_slow.lock().unwrap() = false;
    export(&mut desk, 40_000);
    desk.wait(|app| said(app, "large.png is written, 40000 x"));
    let size = desk.table.pictures.lock().unwrap()[0].1.view.size();
    let seen = desk.app().camera.view().unwrap().size();
    let as_tall = f64::from(seen.height()) / f64::from(seen.width());
    assert!((f64::from(size.height()) - 40_000.0 * as_tall).abs() <= 0.5);
}

#[test]
fn a_file_is_measured_by_moving_it_about_and_stays_as_it_is() {
    let table = Table::with([("site.arrow", lanes(300))]);
    let services: Arc<dyn AppServices> = table.clone();
    let movements = crate::measure(services, "site.arrow".into(), Some("cpu".into())).unwrap();
    let names: Vec<_> = movements.iter().map(|m| m.name).collect();
    assert_eq!(
        names,
        [
            "still",
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
        let is_still = movement.name == "still";
        assert_eq!(
            movement.pictures_ms.is_empty(),
            is_still,
            "{}",
            movement.name
        );
    }
    let services: Arc<dyn AppServices> = table;
    let missing = crate::measure(services, "no.arrow".into(), None).unwrap_err();
    assert!(missing.message.contains("no such file"), "{missing}");
}

#[test]
fn edits_that_take_longer_than_a_frame_are_done_beside_the_window_in_order() {
    let mut desk = Desk::looking_at(lanes(200));
    desk.app().patience = Duration::ZERO;
    for _ in 0..20 {
        let (finish, rest) = mpsc::channel::<()>();
        desk.app().change(move |document| {
            rest.recv().expect("the test lets it go on");
            document.select_all();
        });
        desk.app().edit(Document::delete_selection);
        desk.app()
            .edit(|document: &mut Document| document.undo().map(drop).ok_or("nothing"));
        // Nothing that is asked of it meanwhile does harm.
        for key in [Key::F, Key::H, Key::Escape, Key::Plus] {
            desk.key(NONE, key);
        }
        desk.app().edit(|_: &mut Document| Err("it cannot be done"));
        assert!(desk.app().layers[0].is_busy());
        finish.send(()).unwrap();
        desk.wait(|app| !app.layers[0].is_busy());
        desk.app().change(Document::show_all);
        desk.wait(|app| !app.layers[0].is_busy());
        // In one notice with others where all was done in one go.
        let is_told = |n: &String| n.contains("it cannot be done");
        let notices = std::mem::take(&mut desk.app().notices);
        assert!(notices.iter().any(is_told), "{notices:?}");
        let document = desk.document();
        assert_eq!(document.scene().draw_order().len(), 200);
        assert_eq!(document.undo_redo_names(), (None, Some("delete")));
        assert!(!document.is_changed());
    }
    desk.wait(|app| {
        app.layers[0]
            .shown
            .as_ref()
            .is_some_and(|s| s.report.hidden == 0)
    });
}

#[test]
fn what_lies_over_the_picture_is_made_beside_the_window_too() {
    let mut desk = Desk::looking_at(lanes(200));
    desk.app().patience = Duration::ZERO;
    for round in 0..40 {
        desk.app().change(Document::select_all);
        desk.key(NONE, [Key::Plus, Key::Minus][round % 2]);
        // Most rounds are as swift as they come; in others it certainly is at work still.
        let slow = (round % 4 == 0).then(|| slow_overlay(&mut desk));
        // An edit waits for what still looks at the layout, and is not lost.
        desk.app().edit(Document::delete_selection);
        desk.key(NONE, Key::ArrowLeft);
        desk.key(CTRL, Key::Z);
        if let Some(finish) = slow {
            assert!(desk.app().document().is_none(), "the edit has not waited");
            drop(finish);
        }
        desk.wait(|app| app.layers[0].is_settled());
        let view = desk.app().camera.view().unwrap();
        let document = desk.document();
        assert!(!document.is_changed() && document.undo_redo_names().1 == Some("delete"));
        let selected = outline(document, document.selection(), &view);
        let made = desk.app().layers[0].overlay.last().unwrap();
        assert!(made.view == view && made.selection == selected);
    }
}

/// What lies over the picture is made again, until what is returned goes away.
fn slow_overlay(desk: &mut Desk) -> mpsc::Sender<()> {
    desk.wait(|app| app.layers[0].is_settled());
    let (finish, rest) = mpsc::channel();
    let app = desk.app();
    let layer = &mut app.layers[0];
    let document = layer.document.as_ref().expect("all is settled");
    layer.overlay.make_again(document, &app.wake, rest);
    finish
}

#[test]
fn an_edit_is_in_the_picture_before_all_of_it_is_done() {
    let mut desk = Desk::looking_at(lanes(4));
    desk.app().patience = Duration::ZERO;
    let (finish, rest) = mpsc::channel::<()>();
    desk.app().edit(move |document: &mut Document| {
        document.select_all();
        let done = document.delete_selection();
        rest.recv().expect("the test lets it go on");
        done
    });
    let drawn = |app: &crate::App| app.layers[0].shown.as_ref().map(|s| s.report.drawn);
    desk.wait(|app| drawn(app) == Some(0));
    assert!(desk.app().document().is_none(), "it is still at work");
    finish.send(()).unwrap();
    desk.wait(|app| app.document().is_some());
    assert!(desk.document().is_changed());
}

#[test]
fn swept_areas_are_those_of_the_selection_or_of_all() {
    let mut desk = Desk::looking_at(lanes(4));
    let of = |rows: &'static [u32]| {
        move |app: &crate::App, table: &Table| {
            let drawn = table.swept.lock().unwrap();
            app.swept.drawn.picture.is_some() && *drawn == rows
        }
    };
    let table = Arc::clone(&desk.table);
    desk.key(NONE, Key::E);
    desk.wait(|app| of(&[0, 1, 2, 3])(app, &table));
    let at = desk.at(5.0, 2.0);
    desk.click(at);
    desk.wait(|app| of(&[1])(app, &table));
    desk.app().swept.vehicle = "a lorry".into();
    desk.wait(|app| {
        app.swept
            .drawn
            .trouble
            .as_ref()
            .is_some_and(|t| t.contains("not a vehicle"))
    });
    assert!(desk.app().swept.drawn.picture.is_none());
    desk.key(NONE, Key::E);
    assert_eq!(desk.app().swept.drawn.trouble, None);
}

#[test]
fn an_exported_picture_has_all_that_is_seen() {
    let table = Table::with([("low.arrow", lanes(2)), ("top.arrow", lanes(3))]);
    let mut desk = Desk::with(&table, &["low.arrow", "top.arrow"], Some("cpu"));
    desk.wait(|app| app.layers.iter().all(|layer| layer.document.is_some()));
    desk.key(CTRL, Key::L);
    desk.app().prompt.as_mut().unwrap().text = "hall.png@px-per-m=20".into();
    desk.key(NONE, Key::Enter);
    desk.wait(|app| app.floor.drawn.picture.is_some());
    desk.key(NONE, Key::E);
    desk.key(NONE, Key::F);
    let hall = Point::new(-20.0, -15.0);
    let view = desk.app().camera.view().unwrap();
    assert!(view.world_bounds().contains(hall), "the floor plan is seen");
    let export = |desk: &mut Desk| {
        desk.key(CTRL, Key::E);
        desk.key(NONE, Key::Enter);
        desk.wait(|app| !app.is_writing());
        table.pictures.lock().unwrap().pop().unwrap().1
    };
    let all = export(&mut desk);
    let counts = |e: &PictureRequest| {
        let others = e.others.iter().map(|scene| scene.path_count());
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

    desk.key(NONE, Key::PageDown);
    let turned = export(&mut desk);
    assert_eq!(counts(&turned), (2, vec![3]), "what is edited is on top");
    desk.app().floor.is_visible = false;
    desk.app().layers[1].is_visible = false;
    for key in [Key::E, Key::G, Key::L] {
        desk.key(NONE, key);
    }
    let bare = export(&mut desk);
    assert_eq!(counts(&bare), (2, vec![]));
    assert!(bare.floor_plan.is_none() && bare.swept.is_none());
    assert!(bare.grid.fills.is_empty() && !names(&bare));
}

#[test]
fn a_floor_plan_that_cannot_be_read_says_why_and_goes_away() {
    let mut desk = Desk::looking_at(lanes(2));
    desk.app().lay_floor_plan("hall.png");
    desk.wait(|app| app.floor.trouble.is_some());
    assert!(
        desk.harness
            .query_by_label_contains("that is no floor plan")
            .is_some()
    );
    desk.app().lay_floor_plan("");
    desk.harness.run_steps(3);
    assert!(desk.harness.query_by_label_contains("floor plan").is_none());
}
