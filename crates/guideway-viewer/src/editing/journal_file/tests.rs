use guideway_spline::Point;

use super::*;
use crate::services::Job;
use crate::tests::services::lanes;

fn document() -> Document {
    Document::new(lanes(4).into(), &Default::default()).unwrap()
}

fn open(site: &Path) -> JournalFile {
    JournalFile::open(site).unwrap()
}

/// A file with a document that has recorded edits.
fn edited() -> (tempfile::TempDir, PathBuf, Document, JournalFile) {
    let folder = tempfile::tempdir().unwrap();
    let site = folder.path().join("site.arrow");
    fs::write(&site, "as it was read").unwrap();
    let mut journal = open(&site);
    assert!(journal.unsaved_summary().is_none());
    let mut edited = document();
    edited.select_all();
    edited.delete_selection().unwrap();
    journal.record(&mut edited, &site).unwrap();
    edited.undo();
    edited.move_node(0, Point::new(1.0, 1.0)).unwrap();
    journal.record(&mut edited, &site).unwrap();
    (folder, site, edited, journal)
}

fn copy_base(journal: &mut JournalFile, site: &Path) -> io::Result<()> {
    journal.base_copy(site)?.run()
}

fn files(folder: &tempfile::TempDir) -> usize {
    fs::read_dir(folder.path()).unwrap().count()
}

/// Opens the journal and replays its work, as a restarted viewer does.
fn replayed(site: &Path) -> (JournalFile, UnsavedWork, ReplayProgress, Document) {
    let journal = open(site);
    let found = journal.unsaved_work(site).unwrap();
    let mut recovered = document();
    let done = found.replay(&mut recovered, &Job::default()).unwrap();
    (journal, found, done, recovered)
}

#[test]
fn finds_work_after_a_crash_of_the_same_file_only() {
    let (_folder, site, edited, journal) = edited();
    drop(journal);
    let (mut journal, found, done, mut recovered) = replayed(&site);
    assert_eq!((done.entries, found.base), (3, site.clone()));
    assert_eq!(recovered.scene().draw_order().len(), 4);
    assert_eq!(recovered.node_position_m(0), edited.node_position_m(0));
    assert!(journal.resume(done, &site).unwrap());
    recovered.move_node(2, Point::new(3.0, 3.0)).unwrap();
    journal.record(&mut recovered, &site).unwrap();
    // Another crash.
    drop(journal);
    let (_, _, done, recovered) = replayed(&site);
    assert_eq!(done.entries, 4);
    assert_eq!(recovered.node_position_m(0), edited.node_position_m(0));
    assert_eq!(recovered.node_position_m(2), Point::new(3.0, 3.0));
    fs::write(&site, "another layout").unwrap();
    let journal = open(&site);
    assert!(journal.unsaved_summary().is_none());
    // The work is kept.
    let copy = journal.mismatched_copy().unwrap();
    assert!(fs::metadata(copy).unwrap().len() > HEADER_BYTES as u64);
    drop(journal);
    assert!(
        open(&site).mismatched_copy().is_none(),
        "it is reported once"
    );
}

#[test]
fn journal_that_vanished_is_written_again() {
    let (folder, site, mut edited, mut journal) = edited();
    fs::remove_file(&journal.journal).unwrap();
    edited.move_node(1, Point::new(2.0, 2.0)).unwrap();
    journal.record(&mut edited, &site).unwrap();
    drop(journal);
    let (mut journal, _, done, recovered) = replayed(&site);
    assert_eq!(done.entries, 4);
    assert_eq!(recovered.node_position_m(1), Point::new(2.0, 2.0));
    journal.resume(done, &site).unwrap();
    // It is an error if that is impossible.
    fs::remove_dir_all(folder.path()).unwrap();
    edited.move_node(1, Point::new(3.0, 3.0)).unwrap();
    assert!(journal.record(&mut edited, &site).is_err());
}

#[test]
fn work_after_a_save_starts_from_the_file_as_read() {
    for name in ["site.arrow", "other.arrow"] {
        let (folder, site, mut edited, mut journal) = edited();
        let target = folder.path().join(name);
        copy_base(&mut journal, &site).unwrap();
        let new = folder.path().join("new");
        fs::write(&new, "as it is saved").unwrap();
        fs::rename(&new, &target).unwrap();
        journal.mark_saved(&target).unwrap();
        edited.move_node(1, Point::new(2.0, 2.0)).unwrap();
        journal.record(&mut edited, &target).unwrap();
        drop(journal);
        let (_, found, done, recovered) = replayed(&target);
        assert_eq!(fs::read_to_string(found.base).unwrap(), "as it was read");
        assert_eq!(done.entries, 4);
        assert_eq!(recovered.node_position_m(1), Point::new(2.0, 2.0));
    }
}

#[test]
fn work_after_an_unchanged_save_starts_from_the_file_as_read() {
    for name in ["site.arrow", "other.arrow"] {
        let folder = tempfile::tempdir().unwrap();
        let [site, target] = ["site.arrow", name].map(|name| folder.path().join(name));
        fs::write(&site, "as it was read").unwrap();
        let mut journal = open(&site);
        let mut edited = document();
        copy_base(&mut journal, &site).unwrap();
        fs::write(folder.path().join("new"), "as it is saved").unwrap();
        fs::rename(folder.path().join("new"), &target).unwrap();
        journal.mark_saved(&target).unwrap();
        edited.move_node(1, Point::new(2.0, 2.0)).unwrap();
        journal.record(&mut edited, &target).unwrap();
        drop(journal);
        let (mut journal, found, done, _) = replayed(&target);
        assert_eq!(fs::read_to_string(found.base).unwrap(), "as it was read");
        assert_eq!(done.entries, 1);
        journal.delete();
        assert_eq!(files(&folder), if site == target { 1 } else { 2 });
    }
}

#[test]
fn undo_after_a_save_is_unsaved_work() {
    let (_folder, site, mut edited, mut journal) = edited();
    journal.mark_saved(&site).unwrap();
    edited.undo();
    journal.record(&mut edited, &site).unwrap();
    drop(journal);
    // Also after a recovery.
    for _ in 0..2 {
        let (mut journal, _, done, mut recovered) = replayed(&site);
        assert!(recovered.is_changed());
        recovered.redo();
        assert!(!recovered.is_changed());
        assert!(journal.resume(done, &site).unwrap());
    }
}

#[test]
fn truncated_entry_is_reported_and_overwritten() {
    let (_folder, site, mut edited, mut journal) = edited();
    edited.move_node(1, Point::new(2.0, 2.0)).unwrap();
    journal.record(&mut edited, &site).unwrap();
    let path = journal.journal.clone();
    drop(journal);
    let bytes = fs::read(&path).unwrap();
    fs::write(&path, &bytes[..bytes.len() - 1]).unwrap();
    let (mut journal, _, done, mut recovered) = replayed(&site);
    assert_eq!(done.entries, 3);
    assert!(!journal.resume(done, &site).unwrap());
    recovered.move_node(1, Point::new(4.0, 4.0)).unwrap();
    journal.record(&mut recovered, &site).unwrap();
    drop(journal);
    let (mut journal, _, done, recovered) = replayed(&site);
    assert!(journal.resume(done, &site).unwrap());
    assert_eq!(recovered.node_position_m(1), Point::new(4.0, 4.0));
}

#[test]
fn work_stays_until_recovered_or_discarded() {
    let (_folder, site, _, journal) = edited();
    drop(journal);
    let mut journal = open(&site);
    let job = Job::default();
    job.cancel();
    let mut other = document();
    let stopped = journal
        .unsaved_work(&site)
        .unwrap()
        .replay(&mut other, &job);
    assert!(stopped.unwrap_err().message.contains("cancelled"));
    let mut other = document();
    other.move_node(3, Point::new(5.0, 5.0)).unwrap();
    journal.record(&mut other, &site).unwrap();
    drop(journal);
    let (mut journal, _, done, _) = replayed(&site);
    assert_eq!(done.entries, 3);
    // The edits before the discard form the new journal.
    journal.delete();
    journal.record(&mut other, &site).unwrap();
    drop(journal);
    let (_, _, done, recovered) = replayed(&site);
    assert_eq!(done.entries, 1);
    assert_eq!(recovered.node_position_m(3), Point::new(5.0, 5.0));
}

#[test]
fn saved_or_discarded_work_leaves_no_files() {
    let (folder, site, _, mut journal) = edited();
    copy_base(&mut journal, &site).unwrap();
    journal.mark_saved(&site).unwrap();
    assert_eq!(files(&folder), 3);
    drop(journal);
    // A crash without unsaved work.
    assert!(open(&site).unsaved_summary().is_none());
    assert_eq!(files(&folder), 1);
    let (folder, _, _, mut journal) = edited();
    journal.delete();
    assert_eq!(files(&folder), 1);
}

#[test]
fn another_window_leaves_the_journal_alone() {
    let (folder, site, mut edited, mut journal) = edited();
    let busy = |result: io::Result<()>| {
        let error = result.unwrap_err();
        assert_eq!(error.kind(), ErrorKind::WouldBlock, "{error}");
    };
    let bytes = || fs::read(sibling(&site, "journal")).unwrap();
    let before = bytes();
    busy(JournalFile::open(&site).map(drop));
    assert_eq!(bytes(), before);
    // A window that was open before there was a journal.
    journal.delete();
    let mut second = open(&site);
    edited.move_node(1, Point::new(2.0, 2.0)).unwrap();
    journal.record(&mut edited, &site).unwrap();
    let before = bytes();
    let mut other = document();
    other.move_node(3, Point::new(5.0, 5.0)).unwrap();
    busy(second.record(&mut other, &site));
    busy(copy_base(&mut second, &site));
    second.delete();
    assert_eq!(bytes(), before);
    // A window that saves under the name of this file.
    let third_site = folder.path().join("third.arrow");
    fs::write(&third_site, "third").unwrap();
    let mut third = open(&third_site);
    copy_base(&mut third, &third_site).unwrap();
    busy(third.mark_saved(&site));
    assert_eq!(bytes(), before);
    journal.delete();
    third.mark_saved(&site).unwrap();
    assert_eq!(files(&folder), 4);
}

#[test]
fn saving_over_a_file_keeps_its_unsaved_work() {
    let (folder, site, _, journal) = edited();
    let left = fs::read(&journal.journal).unwrap();
    drop(journal);
    let other = folder.path().join("other.arrow");
    fs::write(&other, "other").unwrap();
    let mut journal = open(&other);
    copy_base(&mut journal, &other).unwrap();
    journal.mark_saved(&site).unwrap();
    let kept = with_suffix(&sibling(&site, "journal"), "-old");
    assert_eq!(fs::read(kept).unwrap(), left);
}

#[test]
fn later_writes_into_the_file_do_not_reach_the_base() {
    let (_folder, site, _, mut journal) = edited();
    copy_base(&mut journal, &site).unwrap();
    fs::write(&site, "written in place").unwrap();
    let base = fs::read_to_string(sibling(&site, "base")).unwrap();
    assert_eq!(base, "as it was read");
}

#[cfg(unix)]
#[test]
fn pipe_or_link_of_the_name_of_the_journal_is_an_error() {
    let folder = tempfile::tempdir().unwrap();
    let site = folder.path().join("site.arrow");
    fs::write(&site, "").unwrap();
    let journal = sibling(&site, "journal");
    std::os::unix::fs::symlink(&site, &journal).unwrap();
    assert!(JournalFile::open(&site).is_err());
    fs::remove_file(&journal).unwrap();
    let made = std::process::Command::new("mkfifo").arg(&journal).status();
    assert!(made.unwrap().success());
    assert!(JournalFile::open(&site).is_err());
}

#[cfg(unix)]
#[test]
fn names_that_are_not_utf8_have_journals_of_their_own() {
    use std::ffi::OsStr;
    use std::os::unix::ffi::OsStrExt;
    let [a, b] = [b"h\xe4lle", b"h\xf6lle"].map(|name| Path::new(OsStr::from_bytes(name)));
    assert_ne!(sibling(a, "journal"), sibling(b, "journal"));
}

#[cfg(unix)]
#[test]
fn journal_is_as_private_as_the_layout() {
    use std::os::unix::fs::PermissionsExt;
    let folder = tempfile::tempdir().unwrap();
    let site = folder.path().join("site.arrow");
    fs::write(&site, "").unwrap();
    fs::set_permissions(&site, fs::Permissions::from_mode(0o600)).unwrap();
    copy_base(&mut open(&site), &site).unwrap();
    for kind in ["journal", "base"] {
        let mode = fs::metadata(sibling(&site, kind))
            .unwrap()
            .permissions()
            .mode();
        assert_eq!(mode & 0o777, 0o600, "{kind}");
    }
}
