//! Questions for file names, by the desktop and by the window, and the losses of a save.

use std::path::Path;

use eframe::egui::{Event, Key, Modifiers};
use egui_kittest::kittest::Queryable;

use super::services::{TestServices, lanes};
use super::test_window::{TestWindow, has_notice};
use crate::command::Command;
use crate::services::{AppServices, FileAnswer, LostPart};

const NONE: Modifiers = Modifiers::NONE;
const CTRL: Modifiers = Modifiers::COMMAND;
const CTRL_SHIFT: Modifiers = Modifiers::COMMAND.plus(Modifiers::SHIFT);

fn answer(window: &TestWindow, answer: FileAnswer) {
    window.disk.answers.lock().unwrap().push(answer);
}

#[test]
fn dialogs_of_the_desktop_name_the_files_to_open_and_save() {
    let disk = TestServices::with([("a.arrow", lanes(2)), ("b.arrow", lanes(5))]);
    let mut window = TestWindow::open(&disk, &["a.arrow"], Some("cpu"));
    window.wait(|app| app.document().is_some());
    answer(&window, FileAnswer::Chosen("b.arrow".into()));
    window.key(CTRL, Key::O);
    window.wait(|app| app.files.layers().len() == 2 && app.document().is_some());
    answer(&window, FileAnswer::Chosen("plans/c.arrow".into()));
    window.key(CTRL_SHIFT, Key::S);
    window.wait(|app| has_notice(app, "Saved plans/c.arrow"));
    let asked = window.disk.question.lock().unwrap().clone().unwrap();
    assert_eq!(asked.new_name.as_deref(), Some("b.arrow"));
    assert!(asked.formats.iter().any(|format| format.name == "Arrow"));
    // A file that exists is not replaced without the question of the window.
    answer(&window, FileAnswer::Chosen("a.arrow".into()));
    window.key(CTRL_SHIFT, Key::S);
    window.wait(|app| app.dialogs.confirm.is_open());
    let files = window.disk.files.lock().unwrap();
    assert_eq!(files[Path::new("a.arrow")].paths.len(), 2);
    assert_eq!(files[Path::new("plans/c.arrow")].paths.len(), 5);
}

#[test]
fn line_of_the_window_takes_over_where_no_dialog_answers() {
    let disk = TestServices::with([("b.arrow", lanes(5))]);
    let mut window = TestWindow::open(&disk, &[], Some("cpu"));
    // A cancellation at once is a desktop without dialogs, not a person.
    for early in [FileAnswer::NoDialog, FileAnswer::Cancelled] {
        answer(&window, early);
        window.key(CTRL, Key::O);
        window.wait(|app| app.dialogs.prompt.is_open());
        window.app().dialogs.prompt.open_mut().unwrap().text = "c.arrow".into();
        window.key(NONE, Key::Enter);
        window.wait(|app| !app.dialogs.prompt.is_checking());
        window.harness.run_steps(2);
        let problem = "There is no such file";
        assert!(window.harness.query_by_label(problem).is_some());
        assert!(window.app().files.layers().is_empty(), "nothing is opened");
        window.key(NONE, Key::Escape);
    }
    window.key(CTRL, Key::O);
    window.harness.get_by_label("Browse…").click();
    window.harness.run_steps(3);
    let problem = "This desktop has no file dialog: type the name";
    assert!(window.harness.query_by_label(problem).is_some());
    answer(&window, FileAnswer::Chosen("b.arrow".into()));
    window.harness.get_by_label("Browse…").click();
    window.wait(|app| !app.dialogs.picker.is_open());
    assert_eq!(
        window.app().dialogs.prompt.open_mut().unwrap().text,
        "b.arrow"
    );
    window.harness.run_steps(2);
    window.harness.get_by_label("OK").click();
    window.wait(|app| app.document().is_some());
}

#[test]
fn tab_completes_the_name_of_a_file() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("hall.arrow"), "").unwrap();
    let mut window = TestWindow::open(&TestServices::with([]), &[], Some("cpu"));
    window.key(CTRL, Key::O);
    let start = format!("{}/ha", folder.path().display());
    window.app().dialogs.prompt.open_mut().unwrap().text = start;
    window.harness.run_steps(2);
    window.key(NONE, Key::Tab);
    let text = window.app().dialogs.prompt.open_mut().unwrap().text.clone();
    assert!(text.ends_with("/hall.arrow"), "{text}");
}

#[test]
fn losses_are_told_before_the_file_is_written() {
    let mut window = TestWindow::showing(lanes(4));
    let lost = |what: &str, count, detail: &str| LostPart {
        what: what.into(),
        count,
        detail: detail.into(),
    };
    let losses = vec![
        lost("column vmax", 75, "values of paths"),
        lost("column lane", 9, "values of paths"),
    ];
    *window.disk.losses.lock().unwrap() = losses.clone();
    let writes = |window: &TestWindow| window.disk.writes.lock().unwrap().len();
    window.key(CTRL, Key::A);
    window.key(NONE, Key::Delete);
    window.wait(|app| app.document().is_some());
    window.key(CTRL, Key::S);
    window.wait(|app| app.dialogs.losses.is_open());
    let line = "• values of paths: vmax (75), lane (9)";
    window.harness.run_steps(2);
    assert!(window.harness.query_by_label(line).is_some());
    assert!(writes(&window) == 0 && window.document().is_changed());
    window.key(NONE, Key::Escape);
    assert!(writes(&window) == 0 && !window.app().dialogs.losses.is_open());
    window.key(CTRL, Key::S);
    window.wait(|app| app.dialogs.losses.is_open());
    window.harness.run_steps(2);
    window.harness.get_by_label("Save anyway").click();
    window.wait(|app| has_notice(app, "Saved"));
    assert!(writes(&window) == 1 && !window.document().is_changed());
    // The same losses need no second answer; another one does.
    window.app().dialogs.notices.clear();
    window.key(CTRL, Key::S);
    window.wait(|app| has_notice(app, "Saved"));
    let another = lost("stations", 2, "stations");
    window.disk.losses.lock().unwrap().push(another);
    window.key(CTRL, Key::S);
    window.wait(|app| app.dialogs.losses.is_open());
    window.harness.run_steps(2);
    let choose = "Choose another format";
    window.harness.get_by_label(choose).click();
    window.wait(|app| app.dialogs.prompt.is_open());
}

#[test]
fn window_does_not_wait_for_the_disk_of_a_file_to_write() {
    let folder = tempfile::tempdir().unwrap();
    let project = folder.path().join("hall.guideway-project.toml");
    std::fs::write(&project, "").unwrap();
    let mut window = TestWindow::showing(lanes(4));
    let files = window.disk.files.lock().unwrap().clone();
    let there = files.into_values().map(|layout| (project.clone(), layout));
    window.disk.files.lock().unwrap().extend(there);
    for (command, name, is_there) in [
        (Command::SaveAs, "a.arrow", false),
        (Command::SaveAs, "site.arrow", true),
        (Command::ExportSvg, "b.svg", false),
        (Command::ExportSvg, "b.svg", true),
        (Command::ExportPng, "a.arrow", true),
        (Command::SaveProject, project.to_str().unwrap(), true),
    ] {
        window.app().dialogs.notices.clear();
        let ctx = window.harness.ctx.clone();
        window.app().perform(command, &ctx);
        window.app().dialogs.prompt.open_mut().unwrap().text = name.into();
        window.harness.run_steps(2);
        window.key(NONE, Key::Enter);
        if is_there {
            window.wait(|app| app.dialogs.confirm.is_open());
            window.harness.run_steps(2);
            window.harness.get_by_label("Replace it").click();
        }
        window.wait(|app| has_notice(app, "Saved") || has_notice(app, "Wrote"));
    }
    window.key(CTRL, Key::S);
    window.key(CTRL, Key::R);
    window.wait(|app| !app.writer.is_busy() && app.files.is_settled());
    assert_eq!(*window.disk.on_window.lock().unwrap(), [""; 0]);
    // A recorder that records nothing would let all pass.
    assert!(window.disk.file_stamp(Path::new("a.arrow")).is_some());
    assert_eq!(
        *window.disk.on_window.lock().unwrap(),
        ["looking at a file"]
    );
}

#[test]
fn typing_goes_on_behind_the_suggested_name() {
    let disk = TestServices::with([("site.arrow", lanes(2))]);
    let mut window = TestWindow::open(&disk, &["site.arrow"], Some("cpu"));
    window.wait(|app| app.document().is_some());
    // An empty line leaves its cursor at the start.
    window.key(CTRL, Key::O);
    window.key(NONE, Key::Escape);
    window.key(CTRL_SHIFT, Key::S);
    window.harness.run_steps(2);
    window.harness.event(Event::Text("2".into()));
    window.harness.run_steps(2);
    assert_eq!(window.app().dialogs.prompt.text(), Some("site.arrow2"));
}
