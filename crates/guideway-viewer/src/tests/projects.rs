//! Projects: what one window shows, another one opens again.

use std::path::PathBuf;

use eframe::egui::{Key, Modifiers};
use guideway_scene::Palette;

use super::services::{TestServices, lanes};
use super::test_window::{TestWindow, has_notice};
use crate::command::Command;
use crate::services::{AppServices, FileAnswer};

const NONE: Modifiers = Modifiers::NONE;

/// A folder on disk, and the same names in memory.
fn disk(folder: &std::path::Path) -> std::sync::Arc<TestServices> {
    let disk = TestServices::with([]);
    for (name, count) in [("a.arrow", 3), ("b.arrow", 5), ("plans/hall.png", 1)] {
        let mut files = disk.files.lock().unwrap();
        files.insert(folder.join(name), lanes(count));
    }
    disk
}

#[test]
fn project_restores_files_view_plan_and_look() {
    let folder = tempfile::tempdir().unwrap();
    let disk_of_first = disk(folder.path());
    let names = ["a.arrow", "b.arrow"].map(|name| folder.path().join(name));
    let names = names.each_ref().map(|name| name.to_str().unwrap());
    let mut window = TestWindow::open(&disk_of_first, &names, Some("cpu"));
    window.wait(|app| app.files.is_settled());
    let app = window.app();
    app.files.activate(0);
    app.files.layers_mut()[1].is_visible = false;
    app.settings.color_by = Some("speed".into());
    app.settings.palette = Palette::Cividis;
    app.settings.range = [None, Some(1.5)];
    app.settings.breaks.set_text("0.25; 1,5".into());
    app.settings.has_labels = false;
    let context = app.context.clone();
    let plan = folder.path().join("plans/hall.png");
    let text = format!("{}@px-per-m=20,offset=1,2", plan.display());
    app.floor_plan
        .set(&text, &context.services, &context.repaint);
    (app.floor_plan.opacity, app.floor_plan.is_locked) = (0.25, true);
    window.key(NONE, Key::Plus);
    window.key(NONE, Key::ArrowLeft);
    let view = window.app().canvas.camera.view().unwrap();
    let project: PathBuf = folder.path().join("hall");
    let chosen = FileAnswer::Chosen(project);
    disk_of_first.answers.lock().unwrap().push(chosen);
    let ctx = window.harness.ctx.clone();
    window.app().perform(Command::SaveProject, &ctx);
    window.wait(|app| has_notice(app, "Saved"));
    drop(window);

    let project = folder.path().join("hall.guideway-project.toml");
    let text = std::fs::read_to_string(&project).unwrap();
    assert!(text.contains("\"a.arrow\"") && text.contains("\"plans/hall.png\""));
    let disk_of_second = disk(folder.path());
    let launch = [project.to_str().unwrap()];
    let mut window = TestWindow::open(&disk_of_second, &launch, Some("cpu"));
    window.wait(|app| app.files.layers().len() == 2 && app.files.is_settled());
    let app = window.app();
    assert_eq!(app.files.active_index(), 0);
    let shown: Vec<bool> = app.files.layers().iter().map(|l| l.is_visible).collect();
    assert_eq!(shown, [true, false]);
    assert_eq!(app.settings.color_by.as_deref(), Some("speed"));
    assert_eq!(app.settings.palette, Palette::Cividis);
    assert_eq!(app.settings.range, [None, Some(1.5)]);
    assert_eq!(app.settings.breaks.text(), "0.25, 1.5");
    let breaks = app.settings.breaks.breaks().unwrap();
    assert_eq!(breaks.numbers(), [0.25, 1.5]);
    assert!(!app.settings.has_labels);
    let plan = &app.floor_plan;
    assert!(
        plan.text()
            .ends_with("plans/hall.png@px-per-m=20,offset=1,2")
    );
    assert_eq!((plan.opacity, plan.is_locked), (0.25, true));
    let restored = app.canvas.camera.view().unwrap();
    assert_eq!(restored.px_per_m(), view.px_per_m());
    assert!(restored.center_m().distance(view.center_m()) < 1e-9);
}

#[test]
fn missing_files_are_named_and_the_rest_opens() {
    let folder = tempfile::tempdir().unwrap();
    let project = folder.path().join("hall.guideway-project.toml");
    let text = "version = 1\nactive = 1\nbreaks = [2.0, 1.0]\n[[file]]\npath = \"gone.lif\"\n\
                [[file]]\npath = \"b.arrow\"\n[floor-plan]\npath = \"gone.png\"\n";
    std::fs::write(&project, text).unwrap();
    let disk = disk(folder.path());
    let mut window = TestWindow::open(&disk, &[project.to_str().unwrap()], Some("cpu"));
    window.wait(|app| app.files.layers().len() == 1 && app.is_settled());
    assert!(has_notice(window.app(), "gone.lif") && has_notice(window.app(), "gone.png"));
    assert_eq!(window.document().layout().paths.len(), 5);
    assert!(window.app().floor_plan.is_empty());
    assert!(window.app().settings.breaks.text().is_empty(), "no order");
    // A damaged project leaves the window as it is.
    std::fs::write(&project, "version = 1\n[[file]]\npath = 7\n").unwrap();
    window.app().open_any(project);
    window.wait(|app| has_notice(app, "line 3"));
    assert_eq!(window.app().files.layers().len(), 1);
}

#[test]
fn window_does_not_wait_for_the_disk_of_names_and_projects() {
    let folder = tempfile::tempdir().unwrap();
    let project = folder.path().join("hall.guideway-project.toml");
    let text = "version = 1\n[[file]]\npath = \"a.arrow\"\n[floor-plan]\npath = \"gone.png\"\n";
    std::fs::write(&project, text).unwrap();
    let disk = disk(folder.path());
    // The file of the command line comes after those of the project, which would close it.
    let b = folder.path().join("b.arrow");
    let launch = [&project, &b].map(|path| path.to_str().unwrap());
    let mut window = TestWindow::open(&disk, &launch, Some("cpu"));
    window.wait(|app| app.files.layers().len() == 2 && app.is_settled());
    assert!(has_notice(window.app(), "gone.png"));
    window.key(Modifiers::COMMAND, Key::N);
    window.wait(|app| app.files.layers().len() == 3 && app.is_settled());
    let ctx = window.harness.ctx.clone();
    window.app().perform(Command::ExportPng, &ctx);
    let typed = folder.path().join("hal").to_str().unwrap().to_owned();
    window.harness.run_steps(2);
    window.app().dialogs.prompt.open_mut().unwrap().text = typed;
    window.harness.run_steps(2);
    window.key(NONE, Key::Tab);
    window.wait(|app| {
        let text = app.dialogs.prompt.text();
        text.is_some_and(|text| text.ends_with("hall.guideway-project.toml"))
    });
    assert_eq!(*window.disk.on_window.lock().unwrap(), [""; 0]);
    // A recorder that records nothing would let all pass.
    assert!(!window.disk.names_in(folder.path(), 9, &|_| true).is_empty());
    let recorded = window.disk.on_window.lock().unwrap();
    assert_eq!(*recorded, ["listing a folder"]);
}
