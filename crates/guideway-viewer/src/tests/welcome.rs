//! The empty window: its card, the example site, and what becomes of it when it is saved.

use std::path::{Path, PathBuf};

use eframe::egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable;

use super::services::TestServices;
use super::test_window::{TestWindow, has_notice};

const CTRL: Modifiers = Modifiers::COMMAND;

#[test]
fn card_opens_recent_files_and_leaves() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("hall.arrow");
    std::fs::write(&file, "").unwrap();
    let gone = folder.path().join("gone.arrow");
    let list = format!("{}\n{}\n", gone.display(), file.display());
    std::fs::write(folder.path().join("recent-files"), list).unwrap();
    let disk = TestServices::with([]);
    *disk.state.lock().unwrap() = Some(folder.path().to_owned());
    disk.files
        .lock()
        .unwrap()
        .insert(file.clone(), super::services::lanes(2));
    let mut window = TestWindow::open(&disk, &[], Some("cpu"));
    window.harness.run_steps(3);
    assert!(window.harness.query_by_label("gone.arrow").is_none());
    window.harness.get_by_label("hall.arrow").click();
    window.wait(|app| app.document().is_some());
    window.harness.run_steps(2);
    assert!(window.app().files.layers()[0].is_at(&file));
    let card = "Path layouts of automated guided vehicles";
    assert!(window.harness.query_by_label(card).is_none());
}

#[test]
fn example_site_has_no_file_until_it_is_saved() {
    let folder = tempfile::tempdir().unwrap();
    let disk = TestServices::with([]);
    *disk.state.lock().unwrap() = Some(folder.path().to_owned());
    let mut window = TestWindow::open(&disk, &[], Some("cpu"));
    window.harness.run_steps(3);
    window.harness.get_by_label_contains("Example site").click();
    window.wait(|app| app.document().is_some());
    assert_eq!(window.document().layout().paths.len(), 6);
    assert!(window.app().files.layers()[0].is_untitled());
    assert!(window.app().files.recent().files().is_empty());
    window.key(CTRL, Key::S);
    let drafts = folder.path().join("drafts");
    let saved = |path: &&PathBuf| !path.starts_with(&drafts);
    let files = disk.files.lock().unwrap().keys().filter(saved).count();
    assert_eq!(files, 0, "it asks for a name");
    let prompt = &mut window.app().dialogs.prompt;
    let file = folder.path().join("mine.arrow");
    prompt.open_mut().unwrap().text = file.to_string_lossy().into_owned();
    window.key(Modifiers::NONE, Key::Enter);
    window.wait(|app| has_notice(app, "Saved"));
    assert!(!window.app().files.layers()[0].is_untitled());
    assert!(disk.files.lock().unwrap().contains_key(Path::new(&file)));
    // From now on there is a journal, and a save needs no name.
    std::fs::write(&file, "").unwrap();
    window.key(CTRL, Key::A);
    window.key(Modifiers::NONE, Key::Delete);
    window.key(CTRL, Key::S);
    window.wait(|app| !app.files.layers()[0].is_changed());
    let files = disk.files.lock().unwrap();
    assert_eq!(files[Path::new(&file)].paths.iter().count(), 0);
}

#[test]
fn untitled_layouts_have_names_of_their_own_and_close_by_question() {
    let mut window = TestWindow::open(&TestServices::with([]), &[], Some("cpu"));
    for _ in 0..2 {
        let ctx = window.harness.ctx.clone();
        window
            .app()
            .perform(crate::command::Command::ExampleSite, &ctx);
    }
    window.wait(|app| app.document().is_some());
    let names: Vec<String> = window
        .app()
        .files
        .layers()
        .iter()
        .map(|layer| layer.name())
        .collect();
    assert_eq!(names, ["example-site.lif.json", "example-site-2.lif.json"]);
    window.key(CTRL, Key::A);
    window.key(Modifiers::NONE, Key::Delete);
    window.key(CTRL, Key::W);
    window.harness.get_by_label("Close without saving").click();
    window.harness.run_steps(3);
    assert_eq!(window.app().files.layers().len(), 1);
}
