//! Every call of the disk fails once, and the old file stands; a file keeps what it was.

use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::Mutex;

use super::disk::{Disk, OsDisk};
use super::*;

/// A disk whose call number `at` fails.
struct FaultyDisk {
    at: usize,
    kind: io::ErrorKind,
    /// Names of the calls so far.
    calls: Mutex<Vec<&'static str>>,
}

impl FaultyDisk {
    fn new(at: usize, kind: io::ErrorKind) -> &'static Self {
        Box::leak(Box::new(Self {
            at,
            kind,
            calls: Mutex::default(),
        }))
    }

    fn calls(&self) -> Vec<&'static str> {
        self.calls.lock().unwrap().clone()
    }

    fn call(&self, name: &'static str) -> io::Result<()> {
        let mut calls = self.calls.lock().unwrap();
        calls.push(name);
        match calls.len() - 1 == self.at {
            true => Err(self.kind.into()),
            false => Ok(()),
        }
    }
}

impl Disk for FaultyDisk {
    fn create(&self, path: &Path, mode: u32) -> io::Result<File> {
        self.call("create")?;
        OsDisk.create(path, mode)
    }

    fn write(&self, file: &mut File, bytes: &[u8]) -> io::Result<usize> {
        self.call("write")?;
        // Disks may take a part only.
        OsDisk.write(file, &bytes[..bytes.len().min(50_000)])
    }

    fn sync(&self, file: &File) -> io::Result<()> {
        self.call("sync")?;
        OsDisk.sync(file)
    }

    fn close(&self, file: File) -> io::Result<()> {
        OsDisk.close(file)?;
        self.call("close")
    }

    fn rename(&self, from: &Path, to: &Path) -> io::Result<()> {
        self.call("rename")?;
        OsDisk.rename(from, to)
    }

    fn open_folder(&self, path: &Path) -> io::Result<Option<File>> {
        self.call("open folder")?;
        OsDisk.open_folder(path)
    }

    fn sync_folder(&self, folder: &File) -> io::Result<()> {
        self.call("sync folder")?;
        OsDisk.sync_folder(folder)
    }
}

fn new_text() -> Vec<u8> {
    b"new ".repeat(30_000)
}

fn write_on(disk: &'static dyn Disk, path: &Path) -> Result<(), SaveError> {
    let mut file = NewFile::create_on(disk, path)?;
    for part in new_text().chunks(1000) {
        // A writer that loses errors on the way.
        let _ = file.write_all(part);
    }
    file.commit()
}

fn put(path: &Path, text: &str) -> Result<(), SaveError> {
    replace_file(path, |file| {
        file.write_all(text.as_bytes())
            .map_err(|problem| SaveError {
                path: path.to_owned(),
                problem,
            })
    })
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let mut names: Vec<String> = entries
        .map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    names
}

/// A folder with a file `a` of this text.
fn folder_with(text: &str) -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a");
    fs::write(&path, text).unwrap();
    (folder, path)
}

#[test]
fn each_failed_call_is_an_error_and_keeps_the_old_file() {
    use io::ErrorKind::{Other, QuotaExceeded, StorageFull};
    for kind in [StorageFull, QuotaExceeded, Other] {
        let (folder, path) = folder_with("old");
        let all = FaultyDisk::new(usize::MAX, kind);
        write_on(all, &path).unwrap();
        let calls = all.calls();
        assert_eq!(fs::read(&path).unwrap(), new_text());
        for name in ["create", "write", "sync", "close", "rename", "open folder"] {
            assert!(calls.contains(&name), "{name}: {calls:?}");
        }
        // The last call has a test of its own.
        for (at, call) in calls.iter().enumerate().take(calls.len() - 1) {
            fs::write(&path, "old").unwrap();
            let error = write_on(FaultyDisk::new(at, kind), &path).unwrap_err();
            assert_eq!(error.problem.kind(), kind, "{call}");
            assert_eq!(fs::read_to_string(&path).unwrap(), "old", "{call}");
            assert_eq!(names(folder.path()), ["a"], "{call}");
        }
    }
}

#[test]
fn a_name_that_is_not_on_the_disk_is_an_error_though_the_file_is_new() {
    use io::ErrorKind::{Other, PermissionDenied, ReadOnlyFilesystem};
    for kind in [Other, PermissionDenied, ReadOnlyFilesystem] {
        for old in [Some("old"), None] {
            let (folder, path) = folder_with("old");
            let all = FaultyDisk::new(usize::MAX, kind);
            write_on(all, &path).unwrap();
            assert_eq!(all.calls().last(), Some(&"sync folder"));
            match old {
                Some(text) => fs::write(&path, text).unwrap(),
                None => fs::remove_file(&path).unwrap(),
            }
            let disk = FaultyDisk::new(all.calls().len() - 1, kind);
            let error = write_on(disk, &path).unwrap_err();
            assert!(error.to_string().contains("power cut"), "{error}");
            assert!(error.remedy().contains("disk"), "{}", error.remedy());
            assert_eq!(fs::read(&path).unwrap(), new_text());
            assert_eq!(names(folder.path()), ["a"]);
        }
    }
}

#[test]
fn full_disk_is_told_as_such_whatever_the_writer_makes_of_it() {
    let (_folder, path) = folder_with("old");
    let disk = FaultyDisk::new(1, io::ErrorKind::StorageFull);
    let mut file = NewFile::create_on(disk, &path).unwrap();
    let hidden = file.write_all(&new_text()).map_err(|_| "cannot encode");
    assert_eq!(hidden, Err("cannot encode"));
    assert!(file.commit().unwrap_err().remedy().contains("room"));
}

#[test]
fn size_has_a_limit() {
    let (folder, path) = folder_with("old");
    let write = |limit: u64| {
        replace_file(&path, |file| {
            file.set_limit(limit);
            let _ = file.write_all(b"12345678");
            Ok::<u64, SaveError>(file.bytes())
        })
    };
    let error = write(7).unwrap_err();
    assert!(error.to_string().contains("limit of 7 bytes"), "{error}");
    assert!(error.remedy().contains("output-bytes"), "{error}");
    assert_eq!(fs::read_to_string(&path).unwrap(), "old");
    assert_eq!(names(folder.path()), ["a"]);
    assert_eq!(write(8).unwrap(), 8);
}

#[test]
fn stale_files_are_swept_and_those_of_living_runs_stay() {
    let (folder, path) = folder_with("old");
    let stale = folder.path().join(".guideway-1-0.part");
    fs::write(&stale, "left by a run that was killed").unwrap();
    fs::write(folder.path().join(".guideway.part"), "of the user").unwrap();
    let living = NewFile::create(&folder.path().join("b")).unwrap();
    assert!(!stale.exists());
    put(&path, "new").unwrap();
    living.commit().unwrap();
    assert_eq!(names(folder.path()), [".guideway.part", "a", "b"]);
}

#[test]
fn folder_is_no_target_and_a_missing_one_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let error = put(folder.path(), "").unwrap_err();
    assert!(error.remedy().contains("folder"), "{error}");
    let error = put(&folder.path().join("no/a"), "").unwrap_err();
    assert!(error.remedy().contains("Create the folder"), "{error}");
}

#[cfg(unix)]
mod unix {
    use std::os::unix::fs::{MetadataExt, PermissionsExt, fchown, symlink};

    use super::*;

    fn mode(path: &Path) -> u32 {
        fs::metadata(path).unwrap().permissions().mode() & 0o7777
    }

    #[test]
    fn keeps_permissions_and_owner() {
        let (folder, path) = folder_with("old");
        for bits in [0o600, 0o640, 0o666, 0o755] {
            fs::set_permissions(&path, fs::Permissions::from_mode(bits)).unwrap();
            let begun = NewFile::create(&path).unwrap();
            // Nobody may read the unfinished file who may not read the old one.
            let part = names(folder.path()).swap_remove(0);
            assert_eq!(mode(&folder.path().join(part)) & !(bits | 0o600), 0);
            begun.commit().unwrap();
            assert_eq!(mode(&path), bits);
        }
        let file = File::options().write(true).open(&path).unwrap();
        if fchown(&file, Some(1234), Some(2345)).is_ok() {
            put(&path, "new").unwrap();
            let is = fs::metadata(&path).unwrap();
            assert_eq!((is.uid(), is.gid()), (1234, 2345));
        } else {
            println!("SKIPPED: only an administrator can give a file to another user");
        }
    }

    #[test]
    fn keeps_hard_links_and_symbolic_links() {
        let (folder, path) = folder_with(&"old".repeat(100));
        let [other, link, dangling, new] = ["b", "c", "d", "e"].map(|n| folder.path().join(n));
        fs::hard_link(&path, &other).unwrap();
        symlink("a", &link).unwrap();
        symlink("e", &dangling).unwrap();
        put(&path, "1").unwrap();
        assert_eq!(fs::read_to_string(&other).unwrap(), "1");
        put(&link, "2").unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), "2");
        put(&dangling, "3").unwrap();
        assert_eq!(fs::read_to_string(&new).unwrap(), "3");
        assert!([link, dangling].iter().all(|link| link.is_symlink()));
        assert_eq!(names(folder.path()), ["a", "b", "c", "d", "e"]);
    }

    #[test]
    fn keeps_the_new_content_when_an_overwritten_file_is_damaged() {
        let (folder, path) = folder_with("old");
        fs::hard_link(&path, folder.path().join("b")).unwrap();
        let all = FaultyDisk::new(usize::MAX, io::ErrorKind::Other);
        write_on(all, &path).unwrap();
        assert_eq!(all.calls().last(), Some(&"close"));
        for at in 0..all.calls().len() {
            let error = write_on(FaultyDisk::new(at, io::ErrorKind::Other), &path).unwrap_err();
            let rescued = folder.path().join("a.rescued");
            let is_damaged = error.to_string().contains("a.rescued");
            assert_eq!(rescued.exists(), is_damaged, "{at}: {error}");
            if is_damaged {
                assert_eq!(fs::read(&rescued).unwrap(), new_text());
                fs::remove_file(rescued).unwrap();
            }
            assert_eq!(names(folder.path()), ["a", "b"]);
        }
    }

    #[test]
    fn a_file_that_cannot_be_replaced_is_overwritten() {
        let (folder, path) = folder_with("old");
        let calls = FaultyDisk::new(usize::MAX, io::ErrorKind::Other);
        write_on(calls, &path).unwrap();
        let rename = calls.calls().iter().position(|call| *call == "rename");
        let inode = |path: &Path| fs::metadata(path).unwrap().ino();
        for (at, kind) in [
            // The system answers so for a file that is mounted singly.
            (rename.unwrap(), io::ErrorKind::ResourceBusy),
            // And so where the folder takes no second file.
            (0, io::ErrorKind::ReadOnlyFilesystem),
        ] {
            fs::write(&path, "old").unwrap();
            let before = inode(&path);
            write_on(FaultyDisk::new(at, kind), &path).unwrap();
            assert_eq!(fs::read(&path).unwrap(), new_text());
            assert_eq!(inode(&path), before);
            assert_eq!(names(folder.path()), ["a"]);
        }
    }

    #[test]
    fn write_protected_file_is_refused() {
        let (_folder, path) = folder_with("old");
        fs::set_permissions(&path, fs::Permissions::from_mode(0o444)).unwrap();
        let error = put(&path, "new").unwrap_err();
        assert!(error.to_string().contains("write-protected"), "{error}");
        assert_eq!(fs::read_to_string(&path).unwrap(), "old");
    }

    #[test]
    fn hard_link_is_the_same_file() {
        let (folder, path) = folder_with("old");
        let other = folder.path().join("b");
        fs::hard_link(&path, &other).unwrap();
        assert!(is_same_file(&path, &other));
        fs::copy(&path, folder.path().join("c")).unwrap();
        assert!(!is_same_file(&path, &folder.path().join("c")));
    }

    #[test]
    fn pipes_and_links_are_no_files_to_keep() {
        let (folder, path) = folder_with("old");
        let [pipe, link] = ["pipe", "link"].map(|name| folder.path().join(name));
        let made = std::process::Command::new("mkfifo").arg(&pipe).status();
        assert!(made.unwrap().success());
        symlink(&path, &link).unwrap();
        for path in [&pipe, &link] {
            assert!(lock_regular_file(path, true).is_err());
        }
        let locked = lock_regular_file(&path, false).unwrap();
        let error = lock_regular_file(&path, false).unwrap_err();
        assert_eq!(error.kind(), io::ErrorKind::WouldBlock);
        drop(locked);
        assert!(lock_regular_file(&path, false).is_ok());
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn keeps_extended_attributes() {
        use rustix::fs::{XattrFlags, fgetxattr, fsetxattr};
        let (_folder, path) = folder_with("old");
        let old = File::open(&path).unwrap();
        if fsetxattr(&old, "user.site", b"hall 3", XattrFlags::empty()).is_err() {
            println!("SKIPPED: this disk has no extended attributes");
            return;
        }
        put(&path, "new").unwrap();
        let mut value = [0; 6];
        fgetxattr(File::open(&path).unwrap(), "user.site", &mut value[..]).unwrap();
        assert_eq!(&value, b"hall 3");
    }
}
