//! Work that a crash left behind is done again beside the window, and is lost by nothing that is done meanwhile.

use std::fs;
use std::sync::Arc;

use eframe::egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable;
use guideway_document::Document;
use guideway_spline::Point;
use tempfile::TempDir;

use super::desk::Desk;
use super::table::{Table, lanes};
use crate::services::Job;
use crate::work::recovery::Recovery;

/// A file of four lanes that were all deleted when the program crashed.
struct Crashed {
    folder: TempDir,
    table: Arc<Table>,
}

impl Crashed {
    fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        let site = folder.path().join("site.arrow");
        fs::write(&site, "").unwrap();
        let mut document = Document::new(lanes(4).into(), &Default::default()).unwrap();
        document.select_all();
        document.delete_selection().unwrap();
        Recovery::of(&site).record(&mut document, &site).unwrap();
        let table = Table::with([]);
        table.files.lock().unwrap().insert(site, lanes(4));
        Self { folder, table }
    }

    /// Opened again, with the question what is to become of the work.
    fn opened(&self) -> Desk {
        let site = self.folder.path().join("site.arrow");
        let mut desk = Desk::with(&self.table, &[site.to_str().unwrap()], Some("cpu"));
        desk.wait(|app| app.layers[0].is_settled() && app.layers[0].has_found_work());
        desk
    }

    /// How many acts there would be to be done again after a crash now.
    fn written(&self) -> usize {
        let site = self.folder.path().join("site.arrow");
        let mut document = Document::new(lanes(4).into(), &Default::default()).unwrap();
        let found = Recovery::of(&site).found(&site).unwrap();
        let done = found.do_again(&mut document, &Job::default());
        done.unwrap().entries
    }

    fn set_slow(&self, is_slow: bool) {
        *self.table.is_slow.lock().unwrap() = is_slow;
    }
}

/// Chooses to have the work done again.
fn choose(desk: &mut Desk) {
    desk.harness.run_steps(3);
    desk.harness.get_by_label("Do it again").click();
    desk.harness.run_steps(3);
}

fn said(app: &crate::App, text: &str) -> bool {
    app.notices.iter().any(|notice| notice.contains(text))
}

fn wait_until_done(desk: &mut Desk) {
    desk.wait(|app| {
        let shown = app.layers[0].shown.as_ref();
        let drawn = shown.map(|shown| shown.report.drawn);
        said(app, "1 step is done again") && drawn == Some(0)
    });
    assert!(desk.document().is_changed() && !desk.app().layers[0].has_found_work());
    assert!(desk.document().scene().draw_order().is_empty());
}

#[test]
fn the_window_is_used_while_work_is_done_again() {
    let crashed = Crashed::new();
    let mut desk = crashed.opened();
    crashed.set_slow(true);
    choose(&mut desk);
    assert!(desk.app().layers[0].is_recovering());
    assert!(desk.harness.query_by_label("Do it again").is_none());
    let before = desk.app().camera.view();
    desk.key(Modifiers::NONE, Key::Plus);
    assert_ne!(desk.app().camera.view(), before);
    desk.key(Modifiers::COMMAND, Key::A);
    assert_eq!(desk.selected(), [0, 1, 2, 3]);
    desk.wait(|app| {
        let shown = app.layers[0].shown.as_ref();
        shown.map(|shown| shown.view) == app.camera.view()
    });
    // What would be written is not what there is to be.
    desk.key(Modifiers::COMMAND, Key::S);
    assert!(said(desk.app(), "save again in a moment"));
    crashed.set_slow(false);
    wait_until_done(&mut desk);
}

#[test]
fn work_that_was_not_done_again_to_its_end_is_asked_about_again() {
    let crashed = Crashed::new();
    let mut desk = crashed.opened();
    crashed.set_slow(true);
    choose(&mut desk);
    desk.key(Modifiers::NONE, Key::Escape);
    assert!(!desk.app().layers[0].is_recovering());
    choose(&mut desk);
    desk.harness.get_by_label("Cancel").click();
    desk.wait(|app| said(app, "cancelled"));
    choose(&mut desk);
    // The file is closed.
    drop(desk);
    crashed.set_slow(false);
    let mut desk = crashed.opened();
    choose(&mut desk);
    wait_until_done(&mut desk);
}

#[test]
fn nothing_is_changed_until_it_is_decided_what_becomes_of_work() {
    let crashed = Crashed::new();
    let mut desk = crashed.opened();
    crashed.set_slow(true);
    let delete_all = |desk: &mut Desk| {
        desk.app().notices.clear();
        desk.key(Modifiers::COMMAND, Key::A);
        desk.key(Modifiers::NONE, Key::Delete);
    };
    let assert_refused = |desk: &mut Desk| {
        delete_all(desk);
        assert!(said(desk.app(), "choose first"));
        assert!(!desk.document().is_changed() && desk.selected().len() == 4);
    };
    assert_refused(&mut desk);
    choose(&mut desk);
    assert_refused(&mut desk);
    crashed.set_slow(false);
    desk.wait(|app| said(app, "done again"));
    // What is done then is written down behind it.
    let aside = Point::new(0.0, 1.0);
    desk.app()
        .edit(move |document| document.move_node(0, aside));
    assert_eq!(crashed.written(), 2);
}

#[test]
fn what_is_done_after_work_was_forgotten_survives_a_crash() {
    let crashed = Crashed::new();
    let mut desk = crashed.opened();
    desk.harness.run_steps(3);
    desk.harness.get_by_label("Forget it").click();
    desk.harness.run_steps(3);
    for (x, acts) in [(1.0, 1), (2.0, 2)] {
        let aside = Point::new(x, 1.0);
        desk.app()
            .edit(move |document| document.move_node(0, aside));
        assert_eq!(crashed.written(), acts);
    }
}

#[test]
fn work_that_is_forgotten_is_gone() {
    let crashed = Crashed::new();
    let mut desk = crashed.opened();
    desk.harness.run_steps(3);
    desk.harness.get_by_label("Forget it").click();
    desk.harness.run_steps(3);
    assert!(!desk.app().layers[0].has_found_work() && !desk.document().is_changed());
    assert_eq!(fs::read_dir(crashed.folder.path()).unwrap().count(), 1);
}
