//! Opening, reloading, saving and closing of files.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use eframe::egui::{DroppedFile, Key, Modifiers};
use egui_kittest::kittest::Queryable;

use super::services::{TestServices, lanes};
use super::test_window::{TestWindow, has_notice};

const NONE: Modifiers = Modifiers::NONE;
const CTRL: Modifiers = Modifiers::COMMAND;

#[test]
fn saves_a_file_and_keeps_changes_on_a_full_disk() {
    let mut window = TestWindow::showing(lanes(4));
    let at = window.at(5.0, 2.0);
    window.click(at);
    window.key(NONE, Key::Delete);
    *window.disk.is_full.lock().unwrap() = true;
    window.key(CTRL, Key::S);
    window.wait(|app| has_notice(app, "disk is full"));
    assert!(window.document().is_changed());
    *window.disk.is_full.lock().unwrap() = false;
    window.key(CTRL, Key::S);
    window.wait(|app| has_notice(app, "Saved"));
    assert!(!window.document().is_changed());
    let saved = window.disk.files.lock().unwrap()[Path::new("site.arrow")].clone();
    let ids: Vec<&str> = saved.paths.iter().map(|path| path.id()).collect();
    assert_eq!(ids, ["lane 0", "lane 2", "lane 3"]);
}

#[test]
fn prompts_for_a_name_instead_of_overwriting_a_drawing() {
    let disk = TestServices::with([("plan.dxf", lanes(2))]);
    let mut window = TestWindow::open(&disk, &["plan.dxf"], Some("cpu"));
    window.wait(|app| app.files.layers()[0].document().is_some());
    window.key(CTRL, Key::S);
    assert!(!window.app().writer.is_busy());
    assert_eq!(
        window.app().dialogs.prompt.open_mut().unwrap().text,
        "plan.lif.json"
    );
    window.key(NONE, Key::Enter);
    window.wait(|app| app.files.layers()[0].name() == "plan.lif.json");
    let files = window.disk.files.lock().unwrap();
    assert!(files.contains_key(Path::new("plan.lif.json")));
}

#[test]
fn file_being_saved_is_neither_closed_nor_reloaded() {
    let mut window = TestWindow::showing(lanes(4));
    let all = |window: &mut TestWindow| {
        window.key(CTRL, Key::A);
        window.key(NONE, Key::Delete);
        window.wait(|app| !app.files.layers()[0].is_busy());
    };
    all(&mut window);
    *window.disk.is_blocked.lock().unwrap() = true;
    window.key(CTRL, Key::S);
    assert!(!window.document().is_changed() && window.app().files.layers()[0].is_changed());
    window.key(CTRL, Key::W);
    assert!(
        window
            .harness
            .query_by_label("Close without saving")
            .is_some()
    );
    window.key(NONE, Key::Escape);
    window.app().reload(0, true);
    assert!(
        !window.app().files.layers()[0].is_loading(),
        "it would read the old file"
    );
    window.key(CTRL, Key::Q);
    assert!(
        window
            .harness
            .query_by_label("Quit without saving")
            .is_some()
    );
    *window.disk.is_blocked.lock().unwrap() = false;
    window.wait(|app| !app.files.layers()[0].is_changed());
    let file = Path::new("site.arrow");
    assert!(window.disk.files.lock().unwrap()[file].paths.is_empty());
    window.harness.run_steps(3);
    assert!(
        window
            .harness
            .query_by_label("Quit without saving")
            .is_none()
    );
}

#[test]
fn file_being_reloaded_is_not_saved() {
    let mut window = TestWindow::showing(lanes(4));
    *window.disk.is_blocked.lock().unwrap() = true;
    let others = [("site.arrow".into(), lanes(7))];
    window.disk.files.lock().unwrap().extend(others);
    window.app().reload(0, false);
    window.key(CTRL, Key::A);
    window.key(NONE, Key::Delete);
    window.key(CTRL, Key::S);
    assert!(has_notice(window.app(), "still being loaded") && !window.app().writer.is_busy());
    *window.disk.is_blocked.lock().unwrap() = false;
    window.wait(|app| has_notice(app, "has changed on disk"));
    assert!(window.document().is_changed());
    let file = Path::new("site.arrow");
    assert_eq!(
        window.disk.files.lock().unwrap()[file].paths.iter().count(),
        7
    );
}

#[test]
fn load_is_cancelled_by_key_or_button_and_restarts() {
    let disk = TestServices::with([("site.arrow", lanes(4))]);
    *disk.is_blocked.lock().unwrap() = true;
    let mut window = TestWindow::open(&disk, &["site.arrow"], Some("cpu"));
    for by_key in [true, false] {
        window.wait(|app| {
            let load = app.files.layers()[0].load_job();
            load.is_some_and(|load| load.fraction() == Some(0.5))
        });
        match by_key {
            true => window.key(NONE, Key::Escape),
            false => window.harness.get_by_label("Cancel").click(),
        }
        window.wait(|app| app.files.layers()[0].load_job().is_none());
        let error = window.app().files.layers()[0].error().map(str::to_owned);
        assert!(error.is_some_and(|error| error.contains("cancelled")));
        window.app().reload(0, false);
    }
    *disk.is_blocked.lock().unwrap() = false;
    window
        .wait(|app| app.files.layers()[0].is_settled() && app.files.layers()[0].error().is_none());
}

#[test]
fn digit_opens_a_recent_file() {
    let folder = tempfile::tempdir().unwrap();
    let [a, b, gone] = ["a.arrow", "b.arrow", "gone.arrow"].map(|name| folder.path().join(name));
    for file in [&a, &b] {
        std::fs::write(file, "").unwrap();
    }
    let disk = TestServices::with([]);
    *disk.state.lock().unwrap() = Some(folder.path().join("state"));
    for file in [&a, &b, &gone] {
        disk.files.lock().unwrap().insert(file.clone(), lanes(3));
    }
    let files = [&a, &gone, &b].map(|file| file.to_str().unwrap());
    let mut window = TestWindow::open(&disk, &files, Some("cpu"));
    window.wait(|app| {
        app.files
            .layers()
            .iter()
            .all(|layer| layer.document().is_some())
    });
    drop(window);
    let mut window = TestWindow::open(&disk, &[], Some("cpu"));
    window.wait(|app| app.files.recent().files().len() == 3);
    let order = window.app().files.recent().files();
    let there = order.iter().position(|(file, _)| *file == a).unwrap();
    let missing = order.iter().position(|(file, _)| *file == gone).unwrap();
    let digits = [Key::Num1, Key::Num2, Key::Num3];
    window.key(CTRL.plus(Modifiers::SHIFT), Key::O);
    window.key(NONE, digits[missing]);
    assert!(window.app().dialogs.recent.is_open() && window.app().files.layers().is_empty());
    window.key(NONE, digits[there]);
    assert!(!window.app().dialogs.recent.is_open() && window.app().files.layers()[0].is_at(&a));
    window.wait(|app| app.files.layers()[0].document().is_some());
    assert_eq!(
        window.app().files.recent().files()[0].0,
        a,
        "it is the newest"
    );
}

#[test]
fn unreadable_file_does_not_block_others() {
    let disk = TestServices::with([("b.arrow", lanes(3))]);
    let mut window = TestWindow::open(&disk, &["a.arrow", "b.arrow"], Some("cpu"));
    window.wait(|app| {
        app.files.layers()[0].error().is_some() && app.files.layers()[1].picture.shown().is_some()
    });
    let error = window.app().files.layers()[0]
        .error()
        .map(str::to_owned)
        .unwrap();
    assert!(error.contains("no such file"), "{error}");
}

#[test]
fn asks_before_discarding_unsaved_changes() {
    let mut window = TestWindow::showing(lanes(3));
    window.key(CTRL, Key::A);
    window.key(NONE, Key::Delete);
    window.key(CTRL, Key::W);
    assert_eq!(window.app().files.layers().len(), 1, "the file stays open");
    window.key(NONE, Key::Escape);
    window.key(CTRL, Key::Q);
    assert!(
        window
            .harness
            .query_by_label("Quit without saving")
            .is_some()
    );
    window.harness.get_by_label("Keep editing").click();
    window.harness.run_steps(3);
    assert!(
        window
            .harness
            .query_by_label("Quit without saving")
            .is_none()
    );
}

#[test]
fn pictures_for_print_are_exported_by_their_keys() {
    let mut window = TestWindow::showing(lanes(3));
    let keys = [
        (CTRL, Key::P, "site.pdf"),
        (CTRL.plus(Modifiers::SHIFT), Key::E, "site.svg"),
    ];
    for (modifiers, key, name) in keys {
        window.key(modifiers, key);
        let prompt = window.app().dialogs.prompt.open_mut().unwrap();
        assert_eq!(prompt.text, name);
        window.key(NONE, Key::Enter);
        window.wait(|app| has_notice(app, name));
        assert!(
            window
                .disk
                .files
                .lock()
                .unwrap()
                .contains_key(Path::new(name))
        );
    }
}

/// A file that was dropped on the window.
#[derive(Debug)]
struct Dropped(PathBuf);

impl DroppedFile for Dropped {
    fn path(&self) -> &Path {
        &self.0
    }

    fn bytes(&self) -> Result<Vec<u8>, String> {
        std::fs::read(&self.0).map_err(|error| error.to_string())
    }
}

#[test]
fn dropped_maps_and_images_become_floor_plans() {
    let folder = tempfile::tempdir().unwrap();
    let mut window = TestWindow::showing(lanes(1));
    let mut drop = |name: &str, bytes: &[u8]| {
        let path = folder.path().join(name);
        std::fs::write(&path, bytes).unwrap();
        let dropped = &mut window.harness.input_mut().dropped_files;
        dropped.push(Arc::new(Dropped(path.clone())));
        window.harness.run_steps(2);
        let app = window.app();
        let prompt = app
            .dialogs
            .prompt
            .open_mut()
            .map(|prompt| prompt.text.clone());
        let name = |text: &str| text.replace(&*folder.path().to_string_lossy(), "");
        let (plan, prompt) = (name(app.floor_plan.text()), prompt.as_deref().map(name));
        (plan, prompt, app.files.layers().len())
    };
    let map = b"image: hall.pgm\nresolution: 0.05\n";
    assert_eq!(drop("map.yaml", map), ("/map.yaml".into(), None, 1));
    assert_eq!(drop("site.json", b"{}"), ("/map.yaml".into(), None, 2));
    let (plan, prompt, files) = drop("hall.pgm", b"P5 1 1 255\n\0");
    let placed = "/hall.pgm@px-per-m=20,offset=0,0";
    assert_eq!((&*plan, prompt, files), (placed, None, 2));
    assert!(window.app().plan_editor.is_open, "its scale is to be set");
    // A file that is named in the dialog is one that is dropped.
    let page = folder.path().join("hall.pdf").display().to_string();
    std::fs::write(&page, b"%PDF-1.7\n").unwrap();
    window.key(Modifiers::COMMAND, Key::L);
    window.answer(&page);
    let plan = window.app().floor_plan.text().to_owned();
    assert_eq!(plan, format!("{page}@page=1,px-per-m=20,offset=0,0"));
}

#[test]
fn file_that_vanishes_stays_open_and_is_written_again() {
    let folder = tempfile::tempdir().unwrap();
    let site = folder.path().join("site.arrow");
    std::fs::write(&site, "").unwrap();
    let disk = TestServices::with([]);
    disk.files.lock().unwrap().insert(site.clone(), lanes(4));
    let mut window = TestWindow::open(&disk, &[site.to_str().unwrap()], Some("cpu"));
    window.wait(|app| app.files.layers()[0].is_settled());
    window.key(CTRL, Key::A);
    window.key(NONE, Key::Delete);
    std::fs::remove_file(&site).unwrap();
    disk.files.lock().unwrap().clear();
    window.wait(|app| has_notice(app, "is gone"));
    assert!(window.document().is_changed());
    window.key(CTRL, Key::S);
    window.wait(|app| has_notice(app, "Saved"));
    assert!(site.exists() && disk.files.lock().unwrap()[&site].paths.is_empty());
}
