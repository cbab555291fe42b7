//! Files that are opened, read again, saved and left.

use eframe::egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable;

use super::desk::Desk;
use super::table::{Table, lanes};

const NONE: Modifiers = Modifiers::NONE;
const CTRL: Modifiers = Modifiers::COMMAND;

#[test]
fn a_file_is_saved_and_a_full_disk_loses_nothing() {
    let mut desk = Desk::looking_at(lanes(4));
    let at = desk.at(5.0, 2.0);
    desk.click(at);
    desk.key(NONE, Key::Delete);
    *desk.table.is_full.lock().unwrap() = true;
    desk.key(CTRL, Key::S);
    desk.wait(|app| {
        app.notices
            .iter()
            .any(|notice| notice.contains("disk is full"))
    });
    assert!(desk.document().is_changed());
    *desk.table.is_full.lock().unwrap() = false;
    desk.key(CTRL, Key::S);
    desk.wait(|app| app.notices.iter().any(|notice| notice.contains("is saved")));
    assert!(!desk.document().is_changed());
    let saved = desk.table.files.lock().unwrap()[std::path::Path::new("site.arrow")].clone();
    let ids: Vec<&str> = saved.paths.iter().map(|path| path.id()).collect();
    assert_eq!(ids, ["lane 0", "lane 2", "lane 3"]);
}

#[test]
fn a_drawing_is_not_replaced_by_its_paths() {
    let table = Table::with([("plan.dxf", lanes(2))]);
    let mut desk = Desk::with(&table, &["plan.dxf"], Some("cpu"));
    desk.wait(|app| app.layers[0].document.is_some());
    desk.key(CTRL, Key::S);
    assert!(!desk.app().is_writing());
    assert_eq!(desk.app().prompt.as_ref().unwrap().text, "plan.lif.json");
    desk.key(NONE, Key::Enter);
    desk.wait(|app| app.layers[0].name() == "plan.lif.json");
    let files = desk.table.files.lock().unwrap();
    assert!(files.contains_key(std::path::Path::new("plan.lif.json")));
}

#[test]
fn a_file_that_is_being_saved_is_neither_left_nor_read_again() {
    let mut desk = Desk::looking_at(lanes(4));
    let all = |desk: &mut Desk| {
        desk.key(CTRL, Key::A);
        desk.key(NONE, Key::Delete);
        desk.wait(|app| !app.layers[0].is_busy());
    };
    all(&mut desk);
    *desk.table.is_slow.lock().unwrap() = true;
    desk.key(CTRL, Key::S);
    assert!(!desk.document().is_changed() && desk.app().layers[0].is_changed());
    desk.key(CTRL, Key::W);
    desk.app().reload(0, true);
    assert!(!desk.app().layers[0].is_reading(), "it would read what was");
    desk.key(CTRL, Key::Q);
    assert!(desk.harness.query_by_label("Quit without saving").is_some());
    *desk.table.is_slow.lock().unwrap() = false;
    desk.wait(|app| !app.layers[0].is_changed());
    let file = std::path::Path::new("site.arrow");
    assert!(desk.table.files.lock().unwrap()[file].paths.is_empty());
    desk.harness.run_steps(3);
    assert!(desk.harness.query_by_label("Quit without saving").is_none());
}

#[test]
fn a_file_that_is_being_read_again_is_not_saved_over() {
    let mut desk = Desk::looking_at(lanes(4));
    *desk.table.is_slow.lock().unwrap() = true;
    let others = [("site.arrow".into(), lanes(7))];
    desk.table.files.lock().unwrap().extend(others);
    desk.app().reload(0, false);
    desk.key(CTRL, Key::A);
    desk.key(NONE, Key::Delete);
    desk.key(CTRL, Key::S);
    let said = |app: &crate::App, text: &str| app.notices.iter().any(|n| n.contains(text));
    assert!(said(desk.app(), "still being read") && !desk.app().is_writing());
    *desk.table.is_slow.lock().unwrap() = false;
    desk.wait(|app| said(app, "has changed on disk"));
    assert!(desk.document().is_changed());
    let file = std::path::Path::new("site.arrow");
    assert_eq!(
        desk.table.files.lock().unwrap()[file].paths.iter().count(),
        7
    );
}

#[test]
fn reading_a_file_is_stopped_by_a_key_or_a_button_and_begun_anew() {
    let table = Table::with([("site.arrow", lanes(4))]);
    *table.is_slow.lock().unwrap() = true;
    let mut desk = Desk::with(&table, &["site.arrow"], Some("cpu"));
    for by_key in [true, false] {
        desk.wait(|app| {
            let load = app.layers[0].load();
            load.is_some_and(|load| load.fraction() == Some(0.5))
        });
        match by_key {
            true => desk.key(NONE, Key::Escape),
            false => desk.harness.get_by_label("Cancel").click(),
        }
        desk.wait(|app| app.layers[0].load().is_none());
        let trouble = desk.app().layers[0].trouble.clone();
        assert!(trouble.is_some_and(|trouble| trouble.contains("cancelled")));
        desk.app().reload(0, false);
    }
    *table.is_slow.lock().unwrap() = false;
    desk.wait(|app| app.layers[0].is_settled() && app.layers[0].trouble.is_none());
}

#[test]
fn a_file_that_was_open_lately_is_opened_by_its_digit() {
    let folder = tempfile::tempdir().unwrap();
    let [a, b, gone] = ["a.arrow", "b.arrow", "gone.arrow"].map(|name| folder.path().join(name));
    for file in [&a, &b] {
        std::fs::write(file, "").unwrap();
    }
    let table = Table::with([]);
    *table.state.lock().unwrap() = Some(folder.path().join("state"));
    for file in [&a, &b, &gone] {
        table.files.lock().unwrap().insert(file.clone(), lanes(3));
    }
    let files = [&a, &gone, &b].map(|file| file.to_str().unwrap());
    let mut desk = Desk::with(&table, &files, Some("cpu"));
    desk.wait(|app| app.layers.iter().all(|layer| layer.document.is_some()));
    drop(desk);
    let mut desk = Desk::with(&table, &[], Some("cpu"));
    desk.wait(|app| app.recent.files().len() == 3);
    let order = desk.app().recent.files();
    let there = order.iter().position(|(file, _)| *file == a).unwrap();
    let missing = order.iter().position(|(file, _)| *file == gone).unwrap();
    let digits = [Key::Num1, Key::Num2, Key::Num3];
    desk.key(CTRL.plus(Modifiers::SHIFT), Key::O);
    desk.key(NONE, digits[missing]);
    assert!(desk.app().choosing.is_some() && desk.app().layers.is_empty());
    desk.key(NONE, digits[there]);
    assert!(desk.app().choosing.is_none() && desk.app().layers[0].is_at(&a));
    desk.wait(|app| app.layers[0].document.is_some());
    assert_eq!(desk.app().recent.files()[0].0, a, "it is the newest now");
}

#[test]
fn one_bad_file_does_not_keep_others_from_opening() {
    let table = Table::with([("b.arrow", lanes(3))]);
    let mut desk = Desk::with(&table, &["a.arrow", "b.arrow"], Some("cpu"));
    desk.wait(|app| app.layers[0].trouble.is_some() && app.layers[1].shown.is_some());
    let trouble = desk.app().layers[0].trouble.clone().unwrap();
    assert!(trouble.contains("no such file"), "{trouble}");
}

#[test]
fn unsaved_changes_are_asked_about() {
    let mut desk = Desk::looking_at(lanes(3));
    desk.key(CTRL, Key::A);
    desk.key(NONE, Key::Delete);
    desk.key(CTRL, Key::W);
    assert_eq!(desk.app().layers.len(), 1, "it stays open");
    desk.key(CTRL, Key::Q);
    assert!(desk.harness.query_by_label("Quit without saving").is_some());
    desk.harness.get_by_label("Stay").click();
    desk.harness.run_steps(3);
    assert!(desk.harness.query_by_label("Quit without saving").is_none());
}
