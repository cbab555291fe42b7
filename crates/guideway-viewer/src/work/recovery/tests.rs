use guideway_spline::Point;

use super::*;
use crate::tests::table::lanes;

fn document() -> Document {
    Document::new(lanes(4).into(), &Default::default()).unwrap()
}

/// A file, and a document of it in which something was done and written down.
fn edited() -> (tempfile::TempDir, PathBuf, Document, Recovery) {
    let folder = tempfile::tempdir().unwrap();
    let site = folder.path().join("site.arrow");
    fs::write(&site, "as it was read").unwrap();
    let mut recovery = Recovery::of(&site);
    assert!(!recovery.has_found());
    let mut edited = document();
    edited.select_all();
    edited.delete_selection().unwrap();
    recovery.record(&mut edited, &site).unwrap();
    edited.undo();
    edited.move_node(0, Point::new(1.0, 1.0)).unwrap();
    recovery.record(&mut edited, &site).unwrap();
    (folder, site, edited, recovery)
}

fn files(folder: &tempfile::TempDir) -> usize {
    fs::read_dir(folder.path()).unwrap().count()
}

/// Does again what is found, as a viewer does that is started anew.
fn done_again(site: &Path) -> (Recovery, Found, ReplayProgress, Document) {
    let recovery = Recovery::of(site);
    let found = recovery.found(site).unwrap();
    let mut recovered = document();
    let done = found.do_again(&mut recovered, &Job::default()).unwrap();
    (recovery, found, done, recovered)
}

#[test]
fn work_is_found_after_a_crash_and_only_with_the_same_file() {
    let (_folder, site, edited, recovery) = edited();
    drop(recovery);
    let (mut recovery, found, done, mut recovered) = done_again(&site);
    assert_eq!((done.entries, found.file), (3, site.clone()));
    assert_eq!(recovered.scene().draw_order().len(), 4);
    assert_eq!(recovered.node_position_m(0), edited.node_position_m(0));
    assert!(recovery.go_on(done, &site).unwrap());
    recovered.move_node(2, Point::new(3.0, 3.0)).unwrap();
    recovery.record(&mut recovered, &site).unwrap();
    // It crashes once more.
    drop(recovery);
    let (_, _, done, recovered) = done_again(&site);
    assert_eq!(done.entries, 4);
    assert_eq!(recovered.node_position_m(0), edited.node_position_m(0));
    assert_eq!(recovered.node_position_m(2), Point::new(3.0, 3.0));
    fs::write(&site, "another layout").unwrap();
    let recovery = Recovery::of(&site);
    assert!(!recovery.has_found());
    // It is not thrown away.
    let aside = recovery.aside().unwrap();
    assert!(fs::metadata(aside).unwrap().len() > HEADER_BYTES as u64);
    assert!(Recovery::of(&site).aside().is_none(), "it is told of once");
}

#[test]
fn work_after_saving_is_found_with_the_file_as_it_was_read() {
    for name in ["site.arrow", "other.arrow"] {
        let (folder, site, mut edited, mut recovery) = edited();
        let target = folder.path().join(name);
        recovery.keep_base(&site).unwrap();
        let new = folder.path().join("new");
        fs::write(&new, "as it is saved").unwrap();
        fs::rename(&new, &target).unwrap();
        recovery.set_saved(&target).unwrap();
        edited.move_node(1, Point::new(2.0, 2.0)).unwrap();
        recovery.record(&mut edited, &target).unwrap();
        drop(recovery);
        let (_, found, done, recovered) = done_again(&target);
        assert_eq!(fs::read_to_string(found.file).unwrap(), "as it was read");
        assert_eq!(done.entries, 4);
        assert_eq!(recovered.node_position_m(1), Point::new(2.0, 2.0));
    }
}

#[test]
fn what_is_done_after_saving_it_unchanged_is_found_with_the_file_as_it_was_read() {
    for name in ["site.arrow", "other.arrow"] {
        let folder = tempfile::tempdir().unwrap();
        let [site, target] = ["site.arrow", name].map(|name| folder.path().join(name));
        fs::write(&site, "as it was read").unwrap();
        let mut recovery = Recovery::of(&site);
        let mut edited = document();
        recovery.keep_base(&site).unwrap();
        fs::write(folder.path().join("new"), "as it is saved").unwrap();
        fs::rename(folder.path().join("new"), &target).unwrap();
        recovery.set_saved(&target).unwrap();
        edited.move_node(1, Point::new(2.0, 2.0)).unwrap();
        recovery.record(&mut edited, &target).unwrap();
        drop(recovery);
        let (mut recovery, found, done, _) = done_again(&target);
        assert_eq!(fs::read_to_string(found.file).unwrap(), "as it was read");
        assert_eq!(done.entries, 1);
        recovery.clear();
        assert_eq!(files(&folder), if site == target { 1 } else { 2 });
    }
}

#[test]
fn what_was_undone_after_saving_is_not_saved() {
    let (_folder, site, mut edited, mut recovery) = edited();
    recovery.set_saved(&site).unwrap();
    edited.undo();
    recovery.record(&mut edited, &site).unwrap();
    drop(recovery);
    // Once more after it was done again.
    for _ in 0..2 {
        let (mut recovery, _, done, mut recovered) = done_again(&site);
        assert!(recovered.is_changed());
        recovered.redo();
        assert!(!recovered.is_changed());
        assert!(recovery.go_on(done, &site).unwrap());
    }
}

#[test]
fn what_a_crash_cut_off_is_told_of_and_is_in_nobodys_way() {
    let (_folder, site, mut edited, mut recovery) = edited();
    edited.move_node(1, Point::new(2.0, 2.0)).unwrap();
    recovery.record(&mut edited, &site).unwrap();
    let journal = recovery.journal.clone();
    drop(recovery);
    let bytes = fs::read(&journal).unwrap();
    fs::write(&journal, &bytes[..bytes.len() - 1]).unwrap();
    let (mut recovery, _, done, mut recovered) = done_again(&site);
    assert_eq!(done.entries, 3);
    assert!(!recovery.go_on(done, &site).unwrap());
    recovered.move_node(1, Point::new(4.0, 4.0)).unwrap();
    recovery.record(&mut recovered, &site).unwrap();
    drop(recovery);
    let (mut recovery, _, done, recovered) = done_again(&site);
    assert!(recovery.go_on(done, &site).unwrap());
    assert_eq!(recovered.node_position_m(1), Point::new(4.0, 4.0));
}

#[test]
fn work_stays_until_it_is_decided_about() {
    let (_folder, site, _, recovery) = edited();
    drop(recovery);
    let mut recovery = Recovery::of(&site);
    let job = Job::default();
    job.cancel();
    let mut other = document();
    let stopped = recovery.found(&site).unwrap().do_again(&mut other, &job);
    assert!(stopped.unwrap_err().message.contains("cancelled"));
    let mut other = document();
    other.move_node(3, Point::new(5.0, 5.0)).unwrap();
    recovery.record(&mut other, &site).unwrap();
    assert_eq!(done_again(&site).2.entries, 3);
    // What was done before it is forgotten takes its place then.
    recovery.clear();
    recovery.record(&mut other, &site).unwrap();
    drop(recovery);
    let (_, _, done, recovered) = done_again(&site);
    assert_eq!(done.entries, 1);
    assert_eq!(recovered.node_position_m(3), Point::new(5.0, 5.0));
}

#[test]
fn what_is_saved_or_not_wanted_leaves_nothing_behind() {
    let (folder, site, _, mut recovery) = edited();
    recovery.keep_base(&site).unwrap();
    recovery.set_saved(&site).unwrap();
    assert_eq!(files(&folder), 3);
    drop(recovery);
    // A crash with nothing unsaved.
    assert!(!Recovery::of(&site).has_found());
    assert_eq!(files(&folder), 1);
    let (folder, _, _, mut recovery) = edited();
    recovery.clear();
    assert_eq!(files(&folder), 1);
}
