//! `view`, `guideway FILE` and `doctor` where the program of the window is not installed.

use std::fs;
use std::path::Path;
use std::process::Command;

use super::support::{json, site, stderr, stdout};

/// The command in a folder without a program of the window, and none on `PATH`.
fn without_window(folder: &Path) -> Command {
    let lonely = folder.join("guideway");
    fs::hard_link(env!("CARGO_BIN_EXE_guideway"), &lonely).unwrap();
    let mut command = Command::new(lonely);
    // A display that nobody opens, as there is no window.
    command.env("PATH", folder).env("DISPLAY", ":4711");
    command
}

#[test]
fn view_without_a_window_says_how_to_get_one() {
    // On the file system of the command, where it can have a second name.
    let folder = tempfile::tempdir_in(env!("CARGO_TARGET_TMPDIR")).unwrap();
    let mut command = without_window(folder.path());
    let refused = command.arg("view").arg(site()).output().unwrap();
    assert_eq!(refused.status.code(), Some(2));
    let said = stderr(&refused);
    assert!(said.contains("neither beside this command nor"), "{said}");
    assert!(said.contains("cargo install --path"), "{said}");
    let error = json(&command.arg("--json").output().unwrap(), "error");
    assert_eq!(
        error["error"]["code"], "usage",
        "`view` has no answer in JSON"
    );
}

#[test]
fn a_file_is_summarized_where_there_is_no_window() {
    let folder = tempfile::tempdir_in(env!("CARGO_TARGET_TMPDIR")).unwrap();
    let shown = without_window(folder.path()).arg(site()).output().unwrap();
    assert!(stdout(&shown).contains("LIF 1.0"), "{}", stdout(&shown));
}

#[test]
fn doctor_says_how_to_get_what_is_missing() {
    let folder = tempfile::tempdir_in(env!("CARGO_TARGET_TMPDIR")).unwrap();
    let mut command = without_window(folder.path());
    let nowhere = folder.path().join("nowhere");
    command.args(["doctor", "--json"]).env("TMPDIR", &nowhere);
    let answer = json(&command.output().unwrap(), "doctor");
    assert!(answer["window"].is_null(), "{answer}");
    let advice = answer["advice"].as_array().unwrap();
    let is_said = |words: &str| {
        advice
            .iter()
            .any(|line| line.as_str().unwrap().contains(words))
    };
    assert!(is_said("crates/guideway-window"), "{advice:?}");
    assert!(is_said("nowhere (temporary files)"), "{advice:?}");
    fs::create_dir(&nowhere).unwrap();
    fs::write(folder.path().join("guideway-window"), "").unwrap();
    let answer = json(&command.output().unwrap(), "doctor");
    assert!(answer["window"].is_string(), "{answer}");
    let advice = answer["advice"].to_string();
    assert!(
        !advice.contains("guideway-window") && !advice.contains("nowhere"),
        "{advice}"
    );
}

#[test]
fn view_starts_the_window_beside_the_command_with_its_arguments() {
    let folder = tempfile::tempdir_in(env!("CARGO_TARGET_TMPDIR")).unwrap();
    let mut command = without_window(folder.path());
    let window = folder.path().join("guideway-window");
    fs::write(&window, "#!/bin/sh\necho \"$@\"\nexit 7\n").unwrap();
    let args = ["--quiet", "view", "--method", "gpu+stages"];
    let unreadable = command.args(args).arg(site()).output().unwrap();
    let said = stderr(&unreadable);
    assert!(said.contains("cannot start the window"), "{said}");
    assert_eq!(unreadable.status.code(), Some(2));
    make_executable(&window);
    let started = command.output().unwrap();
    let site = site();
    let expected = format!("--quiet --method gpu+stages {}\n", site.display());
    assert_eq!(stdout(&started), expected);
    assert_eq!(started.status.code(), Some(7));
}

fn make_executable(file: &Path) {
    use std::os::unix::fs::PermissionsExt;
    fs::set_permissions(file, fs::Permissions::from_mode(0o755)).unwrap();
}
