//! Work that must not be lost: order of events, keys behind dialogs, files that others changed.

use std::path::Path;

use eframe::egui::{Event, Key, Modifiers, PointerButton, Pos2, ViewportCommand, ViewportId};
use egui_kittest::kittest::Queryable;
use guideway_document::Document;
use guideway_spline::Point;

use super::services::{TestServices, lanes};
use super::test_window::{TestWindow, has_notice};
use crate::editing::entries_on_disk;

const NONE: Modifiers = Modifiers::NONE;
const CTRL: Modifiers = Modifiers::COMMAND;

pub(super) fn key(key: Key) -> [Event; 2] {
    [true, false].map(|pressed| Event::Key {
        key,
        physical_key: None,
        pressed,
        repeat: false,
        modifiers: NONE,
    })
}

fn button(pos: Pos2, button: PointerButton, pressed: bool) -> Event {
    Event::PointerButton {
        pos,
        button,
        pressed,
        modifiers: NONE,
    }
}

fn click(at: Pos2) -> [Event; 3] {
    let [down, up] = [true, false].map(|pressed| button(at, PointerButton::Primary, pressed));
    [Event::PointerMoved(at), down, up]
}

/// Sends events that all come before one slow frame.
pub(super) fn in_one_frame(window: &mut TestWindow, events: impl IntoIterator<Item = Event>) {
    window.harness.input_mut().events.extend(events);
    window.harness.run_steps(3);
}

pub(super) fn ids(document: &Document) -> Vec<&str> {
    let layout = document.layout();
    let rows = document.scene().draw_order().iter();
    let mut ids: Vec<_> = rows.map(|&row| layout.paths.id(row as usize)).collect();
    ids.sort_unstable();
    ids
}

pub(super) fn is_shown(window: &TestWindow, label: &str) -> bool {
    window.harness.query_by_label(label).is_some()
}

#[test]
fn delete_after_a_click_in_one_frame_removes_what_was_clicked() {
    let mut window = TestWindow::showing(lanes(3));
    let (first, second) = (window.at(5.0, 0.0), window.at(5.0, 2.0));
    window.click(first);
    let events = click(second).into_iter().chain(key(Key::Delete));
    in_one_frame(&mut window, events);
    assert_eq!(ids(window.document()), ["lane 0", "lane 2"]);
}

#[test]
fn point_before_enter_in_one_frame_belongs_to_the_path() {
    let mut window = TestWindow::showing(lanes(3));
    window.key(NONE, Key::D);
    let (from, to) = (window.at(10.0, 0.0), window.at(10.0, 4.0));
    window.click(from);
    let events = click(to).into_iter().chain(key(Key::Enter));
    in_one_frame(&mut window, events);
    let path = window.document().layout().paths.get(3);
    assert_eq!((path.start_node(), path.end_node()), (Some(1), Some(5)));
}

#[test]
fn each_press_of_a_key_counts() {
    let mut window = TestWindow::showing(lanes(3));
    let before = window.at(5.0, 2.0);
    let events = [(); 4].into_iter().flat_map(|()| key(Key::ArrowLeft));
    in_one_frame(&mut window, events);
    let four = window.at(5.0, 2.0).x - before.x;
    for _ in 0..4 {
        window.key(NONE, Key::ArrowLeft);
    }
    let eight = window.at(5.0, 2.0).x - before.x;
    assert!(
        four > 0.0 && (eight - 2.0 * four).abs() < 0.5,
        "{four} {eight}"
    );
}

#[test]
fn keys_behind_a_question_do_nothing() {
    let mut window = TestWindow::showing(lanes(3));
    window.key(CTRL, Key::A);
    window.key(NONE, Key::R);
    window.key(CTRL, Key::Q);
    assert!(is_shown(&window, "Quit without saving"));
    for (modifiers, key) in [(NONE, Key::Delete), (CTRL, Key::Z), (CTRL, Key::D)] {
        window.key(modifiers, key);
    }
    assert_eq!(ids(window.document()).len(), 3);
    assert_eq!(window.document().undo_redo_names().0, Some("rotate"));
    // A key that opens a question blocks those behind it in the same frame.
    window.key(NONE, Key::Escape);
    assert!(!is_shown(&window, "Quit without saving"));
    let quit = Event::Key {
        key: Key::W,
        physical_key: None,
        pressed: true,
        repeat: false,
        modifiers: CTRL,
    };
    in_one_frame(&mut window, [quit].into_iter().chain(key(Key::Delete)));
    assert!(is_shown(&window, "Close without saving"));
    assert_eq!(ids(window.document()).len(), 3);
}

#[test]
fn escape_and_the_other_button_take_a_drag_back() {
    let mut window = TestWindow::showing(lanes(3));
    window.key(NONE, Key::P);
    let (from, to) = (window.at(10.0, 2.0), window.at(12.0, 3.0));
    for by_key in [true, false] {
        let drag = [
            Event::PointerMoved(from),
            button(from, PointerButton::Primary, true),
            Event::PointerMoved(to),
        ];
        in_one_frame(&mut window, drag);
        assert!(window.document().is_changed());
        match by_key {
            true => window.key(NONE, Key::Escape),
            false => in_one_frame(&mut window, [button(to, PointerButton::Secondary, true)]),
        }
        let release = [PointerButton::Secondary, PointerButton::Primary];
        in_one_frame(&mut window, release.map(|which| button(to, which, false)));
        let end = window.document().layout().paths.get(1).ends().unwrap().1;
        assert_eq!(end, Point::new(10.0, 2.0));
        assert!(!window.document().is_changed());
    }
}

#[test]
fn saving_over_changes_of_others_asks_first() {
    let mut window = TestWindow::showing(lanes(3));
    let saved = |window: &TestWindow| {
        let files = window.disk.files.lock().unwrap();
        files[Path::new("site.arrow")].paths.len()
    };
    let at = window.at(5.0, 2.0);
    window.click(at);
    window.key(NONE, Key::Delete);
    window.disk.overwrite("site.arrow", lanes(7));
    window.key(CTRL, Key::S);
    window.wait(|app| app.dialogs.confirm.is_open());
    window.harness.run_steps(2);
    assert!(is_shown(&window, "Overwrite its changes"));
    window.key(NONE, Key::Escape);
    assert_eq!(saved(&window), 7, "the other program's file is there");
    assert!(window.document().is_changed());
    window.key(CTRL, Key::S);
    window.wait(|app| app.dialogs.confirm.is_open());
    window.harness.run_steps(2);
    window.harness.get_by_label("Overwrite its changes").click();
    window.wait(|app| has_notice(app, "Saved"));
    assert_eq!(saved(&window), 2);
    // Its own save is no change of others.
    window.key(CTRL, Key::A);
    window.key(NONE, Key::Delete);
    window.key(CTRL, Key::S);
    window.wait(|app| !app.files.layers()[0].is_changed());
    assert_eq!(saved(&window), 0);
}

#[test]
fn saving_over_another_file_asks_first() {
    let disk = TestServices::with([("a.arrow", lanes(2)), ("b.arrow", lanes(5))]);
    let mut window = TestWindow::open(&disk, &["a.arrow"], Some("cpu"));
    window.wait(|app| app.document().is_some());
    window.key(CTRL.plus(Modifiers::SHIFT), Key::S);
    window.app().dialogs.prompt.open_mut().unwrap().text = "b.arrow".into();
    window.key(NONE, Key::Enter);
    window.wait(|app| app.dialogs.confirm.is_open());
    window.harness.run_steps(2);
    assert!(is_shown(&window, "Replace it"));
    window.harness.get_by_label("Choose another name").click();
    window.harness.run_steps(2);
    window.app().dialogs.prompt.open_mut().unwrap().text = "c.arrow".into();
    window.key(NONE, Key::Enter);
    window.wait(|app| has_notice(app, "Saved c.arrow"));
    let files = window.disk.files.lock().unwrap();
    assert_eq!(files[Path::new("b.arrow")].paths.len(), 5);
    assert_eq!(files[Path::new("c.arrow")].paths.len(), 2);
}

#[test]
fn reading_again_asks_before_it_discards_changes() {
    let mut window = TestWindow::showing(lanes(3));
    window.key(CTRL, Key::A);
    window.key(NONE, Key::Delete);
    window.key(CTRL, Key::R);
    assert!(is_shown(&window, "Discard them"));
    window.key(NONE, Key::Escape);
    assert!(window.document().is_changed());
    window.key(CTRL, Key::R);
    window.harness.get_by_label("Discard them").click();
    window.wait(|app| {
        app.document()
            .is_some_and(|document| !document.is_changed())
    });
    assert_eq!(ids(window.document()).len(), 3);
}

#[test]
fn saves_and_closes_on_request() {
    let mut window = TestWindow::showing(lanes(3));
    window.key(CTRL, Key::A);
    window.key(NONE, Key::Delete);
    // A save that fails keeps the file open.
    *window.disk.is_full.lock().unwrap() = true;
    window.key(CTRL, Key::W);
    window.harness.get_by_label("Save and close").click();
    window.wait(|app| has_notice(app, "disk is full"));
    window.harness.run_steps(3);
    assert!(window.app().files.layers().len() == 1 && !is_shown(&window, "Save and close"));
    *window.disk.is_full.lock().unwrap() = false;
    window.key(CTRL, Key::W);
    window.harness.get_by_label("Save and close").click();
    window.wait(|app| app.files.layers().is_empty());
    let files = window.disk.files.lock().unwrap();
    assert!(files[Path::new("site.arrow")].paths.is_empty());
}

#[test]
fn exporting_over_a_file_asks_first() {
    let disk = TestServices::with([("a.arrow", lanes(2)), ("over.png", lanes(1))]);
    let mut window = TestWindow::open(&disk, &["a.arrow"], Some("cpu"));
    window.wait(|app| app.document().is_some());
    window.key(CTRL, Key::E);
    window.app().dialogs.prompt.open_mut().unwrap().text = "over.png".into();
    window.key(NONE, Key::Enter);
    window.wait(|app| app.dialogs.confirm.is_open());
    window.harness.run_steps(2);
    assert!(window.disk.pictures.lock().unwrap().is_empty());
    window.harness.get_by_label("Replace it").click();
    window.wait(|app| has_notice(app, "over.png"));
    assert_eq!(window.disk.pictures.lock().unwrap().len(), 1);
}

#[test]
fn second_window_of_a_file_leaves_the_journal_to_the_first() {
    let folder = tempfile::tempdir().unwrap();
    let site = folder.path().join("site.arrow");
    std::fs::write(&site, "").unwrap();
    let disk = TestServices::with([]);
    disk.files.lock().unwrap().insert(site.clone(), lanes(3));
    let open = || {
        let mut window = TestWindow::open(&disk, &[site.to_str().unwrap()], Some("cpu"));
        window.wait(|app| app.files.layers()[0].is_settled());
        window
    };
    let mut first = open();
    first.key(CTRL, Key::A);
    first.key(NONE, Key::Delete);
    let left = |site| entries_on_disk(site).unwrap().0.len();
    let work = left(&site);
    assert!(work > 0);
    let mut second = open();
    second.key(CTRL, Key::A);
    second.key(NONE, Key::R);
    second.harness.run_steps(3);
    assert!(has_notice(second.app(), "open in another window"));
    assert!(!is_shown(&second, "Recover"), "the work is not its own");
    assert!(second.document().is_changed());
    assert_eq!(left(&site), work);
    drop(second);
    assert_eq!(left(&site), work, "the first one's work is still there");
}

#[test]
fn quitting_saves_all_files_first_or_discards_their_changes() {
    for (answer, left) in [("Save and quit", 0), ("Quit without saving", 3)] {
        let disk = TestServices::with([("a.arrow", lanes(3)), ("b.arrow", lanes(3))]);
        let mut window = TestWindow::open(&disk, &["a.arrow", "b.arrow"], Some("cpu"));
        window.wait(|app| app.is_settled());
        for file in 0..2 {
            window.app().files.activate(file);
            window.key(CTRL, Key::A);
            window.key(NONE, Key::Delete);
        }
        window.key(CTRL, Key::Q);
        window.harness.get_by_label(answer).click();
        let closes = |window: &TestWindow| {
            let root = window
                .harness
                .output()
                .viewport_output
                .get(&ViewportId::ROOT);
            root.is_some_and(|root| root.commands.contains(&ViewportCommand::Close))
        };
        for _ in 0..5_000 {
            window.harness.step();
            if closes(&window) {
                break;
            }
            std::thread::sleep(std::time::Duration::from_millis(1));
        }
        assert!(closes(&window), "{answer}");
        for name in ["a.arrow", "b.arrow"] {
            let files = window.disk.files.lock().unwrap();
            assert_eq!(files[Path::new(name)].paths.len(), left, "{answer}: {name}");
        }
    }
}
