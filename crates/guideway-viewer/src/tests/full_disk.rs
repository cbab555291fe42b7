//! A journal on a disk that is full: the user is told, edits go on in memory, the layout can be
//! saved elsewhere, and the journal is written again where there is room.

use std::fs;
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::process::Command;

use eframe::egui::{Key, Modifiers};
use guideway_document::{Document, replay};
use guideway_layout::Layout;

use super::content::difference;
use super::services::{TestServices, lanes};
use super::test_window::{TestWindow, has_notice};
use crate::editing::entries_on_disk;

const NONE: Modifiers = Modifiers::NONE;
const CTRL: Modifiers = Modifiers::COMMAND;
/// The folder of the small disk, for the tests that run on it.
const FOLDER: &str = "GUIDEWAY_SMALL_DISK";
/// Mounts a disk of 64 kB on a folder and runs a command.
const ON_SMALL_DISK: &str = r#"mount -t tmpfs -o size=64k none "$1" && shift && exec "$@""#;

/// Runs an ignored test of this file on a small disk. Skips it, loudly, where the system lets no
/// test mount one.
fn run_on_small_disk(test: &str) {
    let folder = tempfile::tempdir().expect("there is room for a folder");
    let ways: [&[&str]; 2] = [&["--mount"], &["--user", "--map-root-user", "--mount"]];
    let command = |way: &[&str]| {
        let mut command = Command::new("unshare");
        command.args(way).args(["sh", "-c", ON_SMALL_DISK, "sh"]);
        command.arg(folder.path()).env(FOLDER, folder.path());
        command
    };
    let can_mount = |way: &&&[&str]| {
        let probe = command(way).arg("true").output();
        probe.is_ok_and(|probe| probe.status.success())
    };
    let Some(way) = ways.iter().find(can_mount) else {
        eprintln!("SKIPPED {test}: this system lets no test mount a small disk");
        return;
    };
    let program = std::env::current_exe().expect("a test has a program");
    let test = format!(
        "{}::{test}",
        module_path!().split_once("::").unwrap_or_default().1
    );
    let ran = command(way)
        .arg(program)
        .args(["--ignored", "--exact", &test])
        .output();
    let ran = ran.expect("it ran before");
    let text = String::from_utf8_lossy(&ran.stdout);
    assert!(ran.status.success() && text.contains("1 passed"), "{text}");
}

/// A window with a file of three lanes on the small disk.
struct SmallDisk {
    window: TestWindow,
    site: PathBuf,
}

impl SmallDisk {
    fn new() -> Self {
        let folder = std::env::var_os(FOLDER).expect("a test of the small disk starts this one");
        let site = Path::new(&folder).join("site.arrow");
        fs::write(&site, "as it was read").expect("there is room for it");
        let disk = TestServices::with([]);
        let mut files = disk
            .files
            .lock()
            .expect("no test panics while it holds the lock");
        files.insert(site.clone(), lanes(3));
        drop(files);
        let name = site.display().to_string();
        let mut window = TestWindow::open(&disk, &[&name], Some("cpu"));
        window.wait(|app| app.files.layers()[0].is_settled());
        Self { window, site }
    }

    fn filler(&self) -> PathBuf {
        self.site.with_file_name("filler")
    }

    /// Takes all room of the disk.
    fn fill(&self) {
        let mut filler = fs::File::create(self.filler()).expect("a file without content fits");
        let full = std::iter::repeat_with(|| filler.write_all(&[0; 512]));
        let full = full.take(1000).find_map(Result::err);
        assert_eq!(full.map(|error| error.kind()), Some(ErrorKind::StorageFull));
    }

    fn make_room(&self) {
        fs::remove_file(self.filler()).expect("it was there");
    }

    /// Rotates everything until a notice contains a text.
    fn edit_until(&mut self, notice: &str) {
        self.window.app().dialogs.notices.clear();
        self.window.key(CTRL, Key::A);
        for _ in 0..500 {
            self.window.key(NONE, Key::R);
            if has_notice(self.window.app(), notice) {
                return;
            }
        }
        panic!("no notice: {notice}");
    }

    /// The layout that a restart after a crash would recover, beside this file.
    fn recovered(&self, site: &Path) -> Option<Layout> {
        let (entries, _) = entries_on_disk(site)?;
        let document = Document::new(lanes(3).into(), &Default::default());
        let mut document = document.expect("the options name no column");
        let done = replay(&entries, &mut document, |_| true);
        assert_eq!(done.bytes, entries.len(), "no entry is torn");
        Some(document.to_layout())
    }

    fn assert_recoverable(&mut self, site: &Path) {
        let recovered = self.recovered(site).expect("there is a journal");
        let shown = self.window.document().to_layout();
        assert_eq!(difference(&recovered, &shown), None);
    }
}

#[test]
fn full_disk_is_told_and_the_journal_written_again() {
    run_on_small_disk("edits_on_a_full_disk");
}

#[test]
#[ignore = "runs on a small disk, which the test above mounts"]
fn edits_on_a_full_disk() {
    let mut disk = SmallDisk::new();
    let site = disk.site.clone();
    disk.fill();
    disk.edit_until("the disk is full, so the journal beside this file cannot be written");
    assert!(has_notice(disk.window.app(), &site.display().to_string()));
    assert!(disk.recovered(&site).is_none());
    disk.window.key(CTRL, Key::Z);
    assert!(!disk.window.document().is_changed(), "edits go on");
    disk.make_room();
    disk.window.key(NONE, Key::R);
    disk.window
        .wait(|app| has_notice(app, "unsaved work is recorded again"));
    disk.assert_recoverable(&site);
    // The disk becomes full in the middle of an entry.
    disk.fill();
    disk.edit_until("the disk is full");
    assert!(disk.recovered(&site).is_some());
    // The layout can be saved elsewhere, and its journal is there then.
    let other = tempfile::tempdir().unwrap();
    let other = other.path().join("other.arrow");
    disk.window.key(CTRL.plus(Modifiers::SHIFT), Key::S);
    let prompt = disk.window.app().dialogs.prompt.open_mut();
    prompt.unwrap().text = other.display().to_string();
    disk.window.key(NONE, Key::Enter);
    disk.window.wait(|app| has_notice(app, "Saved"));
    disk.window.harness.run_steps(3);
    disk.assert_recoverable(&other);
    disk.window.key(NONE, Key::R);
    disk.window.harness.run_steps(3);
    disk.assert_recoverable(&other);
    let base = entries_on_disk(&other).unwrap().1;
    assert_eq!(fs::read_to_string(base).unwrap(), "as it was read");
}

#[test]
fn save_without_room_for_the_file_as_read_ends_the_journal() {
    run_on_small_disk("save_on_a_full_disk");
}

#[test]
#[ignore = "runs on a small disk, which the test above mounts"]
fn save_on_a_full_disk() {
    let mut disk = SmallDisk::new();
    let site = disk.site.clone();
    disk.fill();
    disk.edit_until("the disk is full");
    disk.window.app().dialogs.notices.clear();
    disk.window.key(CTRL, Key::S);
    disk.window.wait(|app| has_notice(app, "Saved"));
    disk.window
        .wait(|app| has_notice(app, "Unsaved work would not survive a crash: save often"));
    disk.make_room();
    // Its entries would begin with a file that is no more.
    disk.window.key(NONE, Key::R);
    disk.window.harness.run_steps(3);
    assert!(disk.recovered(&site).is_none());
    // The file that is read again has a journal.
    disk.window.app().reload(0, true);
    disk.window
        .wait(|app| !app.files.layers()[0].is_loading() && app.document().is_some());
    disk.window.key(CTRL, Key::A);
    disk.window.key(NONE, Key::R);
    disk.window.harness.run_steps(3);
    assert!(disk.recovered(&site).is_some());
}
