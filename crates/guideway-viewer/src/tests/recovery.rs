//! Unsaved work of a crashed run: recovery in the background, and nothing that loses the work.

use std::fs;
use std::path::PathBuf;
use std::sync::Arc;

use eframe::egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable;
use guideway_document::{Document, replay};
use guideway_spline::Point;
use tempfile::TempDir;

use super::services::{TestServices, lanes};
use super::test_window::{TestWindow, has_notice};
use crate::editing::{JournalFile, entries_on_disk};

/// A file of four lanes, all deleted in a run that crashed.
struct Crashed {
    folder: TempDir,
    disk: Arc<TestServices>,
}

impl Crashed {
    fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        let site = folder.path().join("site.arrow");
        fs::write(&site, "").unwrap();
        let mut document = Document::new(lanes(4).into(), &Default::default()).unwrap();
        document.select_all();
        document.delete_selection().unwrap();
        let mut journal = JournalFile::open(&site).unwrap();
        journal.record(&mut document, &site).unwrap();
        let disk = TestServices::with([]);
        disk.files.lock().unwrap().insert(site, lanes(4));
        Self { folder, disk }
    }

    /// Opens the file, which asks what to do with the unsaved work.
    fn opened(&self) -> TestWindow {
        let site = self.folder.path().join("site.arrow");
        let mut window = TestWindow::open(&self.disk, &[site.to_str().unwrap()], Some("cpu"));
        window.wait(|app| {
            app.files.layers()[0].is_settled() && app.files.layers()[0].has_unsaved_work()
        });
        window
    }

    /// Journal entries that a crash now would leave.
    fn entries(&self) -> usize {
        let site = self.folder.path().join("site.arrow");
        let mut document = Document::new(lanes(4).into(), &Default::default()).unwrap();
        let (entries, _) = entries_on_disk(&site).unwrap();
        replay(&entries, &mut document, |_| true).entries
    }

    fn set_blocked(&self, is_blocked: bool) {
        *self.disk.is_blocked.lock().unwrap() = is_blocked;
    }
}

/// Clicks Recover; the question says how much there is, and of when.
fn recover(window: &mut TestWindow) {
    window.harness.run_steps(3);
    let question = "unsaved step from an earlier run of this window, the last one";
    let question = window.harness.query_by_label_contains(question);
    assert!(question.is_some());
    window.harness.get_by_label("Recover").click();
    window.harness.run_steps(3);
}

fn wait_until_recovered(window: &mut TestWindow) {
    window.wait(|app| {
        let shown = app.files.layers()[0].picture.shown();
        let drawn = shown.map(|shown| shown.report.drawn);
        has_notice(app, "Recovered 1 step") && drawn == Some(0)
    });
    assert!(window.document().is_changed() && !window.app().files.layers()[0].has_unsaved_work());
    assert!(window.document().scene().draw_order().is_empty());
}

#[test]
fn window_responds_during_recovery() {
    let crashed = Crashed::new();
    let mut window = crashed.opened();
    crashed.set_blocked(true);
    recover(&mut window);
    assert!(window.app().files.layers()[0].is_recovering());
    assert!(window.harness.query_by_label("Recover").is_none());
    let before = window.app().canvas.camera.view();
    window.key(Modifiers::NONE, Key::Plus);
    assert_ne!(window.app().canvas.camera.view(), before);
    window.key(Modifiers::COMMAND, Key::A);
    assert_eq!(window.selected(), [0, 1, 2, 3]);
    window.wait(|app| {
        let shown = app.files.layers()[0].picture.shown();
        shown.map(|shown| shown.view) == app.canvas.camera.view()
    });
    // A save now would write the document without the recovered work.
    window.key(Modifiers::COMMAND, Key::S);
    assert!(has_notice(window.app(), "save again in a moment"));
    crashed.set_blocked(false);
    wait_until_recovered(&mut window);
}

#[test]
fn cancelled_recovery_asks_again() {
    let crashed = Crashed::new();
    let mut window = crashed.opened();
    crashed.set_blocked(true);
    recover(&mut window);
    window.key(Modifiers::NONE, Key::Escape);
    assert!(!window.app().files.layers()[0].is_recovering());
    recover(&mut window);
    window.harness.get_by_label("Cancel").click();
    window.wait(|app| has_notice(app, "cancelled"));
    recover(&mut window);
    // Closing the file keeps the work.
    drop(window);
    crashed.set_blocked(false);
    let mut window = crashed.opened();
    recover(&mut window);
    wait_until_recovered(&mut window);
}

#[test]
fn edits_are_refused_until_the_user_decides() {
    let crashed = Crashed::new();
    let mut window = crashed.opened();
    crashed.set_blocked(true);
    let delete_all = |window: &mut TestWindow| {
        window.app().dialogs.notices.clear();
        window.key(Modifiers::COMMAND, Key::A);
        window.key(Modifiers::NONE, Key::Delete);
    };
    let assert_refused = |window: &mut TestWindow| {
        delete_all(window);
        assert!(has_notice(window.app(), "Recover or discard"));
        assert!(!window.document().is_changed() && window.selected().len() == 4);
    };
    delete_all(&mut window);
    let is_unchanged =
        |window: &mut TestWindow| !window.document().is_changed() && window.selected().is_empty();
    assert!(
        is_unchanged(&mut window),
        "no key acts through the question"
    );
    recover(&mut window);
    assert_refused(&mut window);
    crashed.set_blocked(false);
    window.wait(|app| has_notice(app, "Recovered"));
    // Later edits follow the recovered entries.
    let aside = Point::new(0.0, 1.0);
    // The nodes of the deleted lanes are gone.
    window.edit(move |document| document.create_node(None, aside, None).map(drop));
    assert_eq!(crashed.entries(), 2);
}

#[test]
fn edits_after_a_discard_survive_a_crash() {
    let crashed = Crashed::new();
    let mut window = crashed.opened();
    window.harness.run_steps(3);
    window.harness.get_by_label("Discard").click();
    window.harness.run_steps(3);
    for (x, acts) in [(1.0, 1), (2.0, 2)] {
        let aside = Point::new(x, 1.0);
        window.edit(move |document| document.move_node(0, aside));
        assert_eq!(crashed.entries(), acts);
    }
}

#[test]
fn discarded_work_is_deleted() {
    let crashed = Crashed::new();
    let mut window = crashed.opened();
    window.harness.run_steps(3);
    window.harness.get_by_label("Discard").click();
    window.harness.run_steps(3);
    assert!(!window.app().files.layers()[0].has_unsaved_work() && !window.document().is_changed());
    assert_eq!(fs::read_dir(crashed.folder.path()).unwrap().count(), 1);
}

#[test]
fn new_layout_survives_a_crash() {
    let folder = tempfile::tempdir().unwrap();
    let states = ["first", "second"].map(|name| folder.path().join(name));
    let disk = TestServices::with([]);
    *disk.state.lock().unwrap() = Some(states[0].clone());
    let mut window = TestWindow::open(&disk, &[], Some("cpu"));
    window.key(Modifiers::COMMAND, Key::N);
    window.wait(|app| app.document().is_some());
    window.key(Modifiers::NONE, Key::D);
    for point in ["0,0", "10,0", "10,5"] {
        window.type_line(point);
    }
    window.key(Modifiers::NONE, Key::Enter);
    window.harness.run_steps(3);
    assert!(window.app().dialogs.notices.texts().is_empty());
    // The crash leaves a draft, which the window cannot delete any more.
    fs::rename(&states[0], &states[1]).unwrap();
    drop(window);
    *disk.state.lock().unwrap() = Some(states[1].clone());
    let moved = |path: &PathBuf| {
        let inside = path
            .strip_prefix(&states[0])
            .map(|inside| states[1].join(inside));
        inside.unwrap_or_else(|_| path.clone())
    };
    let mut files = disk.files.lock().unwrap();
    *files = files
        .iter()
        .map(|(path, layout)| (moved(path), layout.clone()))
        .collect();
    drop(files);

    let mut window = TestWindow::open(&disk, &[], Some("cpu"));
    window.wait(|app| {
        app.files
            .layers()
            .iter()
            .any(|layer| layer.has_unsaved_work())
    });
    recover(&mut window);
    window.wait(|app| has_notice(app, "Recovered 1 step") && app.document().is_some());
    assert_eq!(window.app().files.layers()[0].name(), "untitled.lif.json");
    assert_eq!(window.document().layout().paths.len(), 2);
    assert!(window.document().is_changed());
    // Saved under a name, nothing is left of the draft.
    window.key(Modifiers::COMMAND, Key::S);
    let site = folder.path().join("site.lif.json");
    window.app().dialogs.prompt.open_mut().unwrap().text = site.to_string_lossy().into();
    window.key(Modifiers::NONE, Key::Enter);
    // The document may come back from writing a frame after the notice.
    window.wait(|app| has_notice(app, "Saved ") && app.document().is_some());
    assert!(!window.document().is_changed());
    drop(window);
    let left = fs::read_dir(states[1].join("drafts")).unwrap().count();
    assert_eq!(left, 0);
}

#[test]
fn edits_go_on_where_the_folder_of_the_journal_is_gone() {
    let folder = tempfile::tempdir().unwrap();
    let site = folder.path().join("site.arrow");
    fs::write(&site, "").unwrap();
    let disk = TestServices::with([]);
    disk.files.lock().unwrap().insert(site.clone(), lanes(4));
    let mut window = TestWindow::open(&disk, &[site.to_str().unwrap()], Some("cpu"));
    window.wait(|app| app.files.layers()[0].is_settled());
    fs::remove_dir_all(folder.path()).unwrap();
    window.key(Modifiers::COMMAND, Key::A);
    for deletes in [true, false] {
        let key = if deletes { Key::Delete } else { Key::Z };
        let modifiers = if deletes {
            Modifiers::NONE
        } else {
            Modifiers::COMMAND
        };
        window.key(modifiers, key);
        window.harness.run_steps(3);
        assert_eq!(window.document().scene().draw_order().is_empty(), deletes);
        // It is said once.
        assert_eq!(has_notice(window.app(), "save often"), deletes);
        window.app().dialogs.notices.clear();
    }
    // A save says that, too, and writes the file once the folder is back.
    window.key(Modifiers::COMMAND, Key::A);
    window.key(Modifiers::NONE, Key::Delete);
    disk.files.lock().unwrap().clear();
    window.key(Modifiers::COMMAND, Key::S);
    window.wait(|app| has_notice(app, "No such file"));
    assert!(window.document().is_changed());
    fs::create_dir_all(folder.path()).unwrap();
    window.key(Modifiers::COMMAND, Key::S);
    window.wait(|app| has_notice(app, "Saved"));
    assert!(disk.files.lock().unwrap()[&site].paths.is_empty());
}
