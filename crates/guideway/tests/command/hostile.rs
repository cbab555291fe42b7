//! Hostile names, arguments, files and disks: errors, and nothing that steers a terminal.

use std::fs;
use std::path::Path;

use crate::support::{command, json, names_in, site, stderr, stdout};

/// The output of the command in a folder.
fn run_in(folder: &Path, args: &[&str]) -> std::process::Output {
    command().current_dir(folder).args(args).output().unwrap()
}

/// A folder with the example site.
fn folder_with_site() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::copy(site(), folder.path().join("site.lif.json")).unwrap();
    folder
}

fn assert_usage(output: &std::process::Output, said: &str) {
    assert_eq!(output.status.code(), Some(2), "{}", stderr(output));
    assert!(stderr(output).contains(said), "{}", stderr(output));
}

#[cfg(unix)]
#[test]
fn names_do_not_steer_the_terminal() {
    let folder = tempfile::tempdir().unwrap();
    let name = "a\u{1b}[2J\nerror: gone\u{202e}.lif.json";
    fs::copy(site(), folder.path().join(name)).unwrap();
    fs::write(folder.path().join("b\u{9b}2J\u{1b}.json"), "{").unwrap();
    let out = "o\u{1b}[31m.geojson";
    for args in [
        &["info", name][..],
        &["info", name, "--json"],
        &["check", name],
        &["check", name, "--format", "sarif"],
        &["check", "b\u{9b}2J\u{1b}.json", "--json"],
        &["check", name, "b\u{9b}2J\u{1b}.json"],
        &["convert", name, out],
        &["convert", name, "o\u{1b}.xyz"],
        &["convert", name, name],
        &[
            "render",
            name,
            "-o",
            "p\u{1b}.png",
            "--size",
            "16x16",
            "--title",
            "\u{1b}",
        ],
        &["render", "none\u{1b}.json", "-o", "no\u{1b}/a.png"],
        &["check", name, "--clearance", "\u{1b}"],
        &["demo", "-o", "d\u{1b}\u{202e}", "--paths", "100"],
        &["generate", "d1", "--paths", "4", "-o", "g\u{1b}.arrow"],
        &["man", "m\u{1b}"],
        &["bench", "none\u{1b}.json"],
    ] {
        let output = run_in(folder.path(), args);
        let text = stdout(&output) + &stderr(&output);
        let is_raw =
            |c: char| c.is_control() && c != '\n' || ('\u{202a}'..='\u{202e}').contains(&c);
        assert!(!text.contains(is_raw), "{args:?}: {text:?}");
        assert!(!text.contains("\nerror: gone"), "{args:?}: {text}");
    }
}

#[test]
fn absurd_arguments_are_refused() {
    let folder = folder_with_site();
    let render = ["render", "site.lif.json", "-o", "a.png"];
    for (more, said) in [
        (["--min-px", "1e22"], "65535"),
        (["--max-px", "1e22"], "65535"),
        (["--scale", "1e308"], "1e-9 to 1e9"),
        (["--center", "1e308,0"], "12.5,-3"),
        (["--width", "1e300"], "1e9"),
        (["--threads", "100000"], "1024"),
    ] {
        let output = run_in(folder.path(), &[&render[..], &more].concat());
        assert_usage(&output, said);
        assert!(stderr(&output).len() < 400, "{}", stderr(&output));
    }
    let mut all = command();
    all.arg("info")
        .arg(site())
        .env("RAYON_NUM_THREADS", "100000");
    assert_usage(&all.output().unwrap(), "limit of 1024 threads");
    assert_eq!(names_in(folder.path()), ["site.lif.json"]);
}

#[test]
fn placements_are_held_to_the_limits() {
    let folder = folder_with_site();
    for placement in ["scale=1e9", "scale=1e8,rotate=3", "scale=1e7,offset=1e9,0"] {
        let input = format!("site.lif.json@{placement}");
        for args in [
            &["convert", &input, "a.geojson"][..],
            &["convert", &input, "a.svg"],
            &["check", &input],
            &["render", &input, "-o", "a.png"],
        ] {
            let output = run_in(folder.path(), args);
            assert_usage(&output, "placement");
            assert!(
                stderr(&output).contains("--limit coordinate"),
                "{}",
                stderr(&output)
            );
        }
    }
    assert_usage(
        &run_in(folder.path(), &["info", "site.lif.json@scale=1e200"]),
        "1e-9 to 1e9",
    );
    assert_eq!(names_in(folder.path()), ["site.lif.json"]);
}

#[test]
fn dash_is_standard_output_and_no_file() {
    let folder = folder_with_site();
    let output = run_in(
        folder.path(),
        &["convert", "site.lif.json", "-", "--to", "lif2"],
    );
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert!(stdout(&output).starts_with('{') && stdout(&output).contains("nodes"));
    assert!(stderr(&output).contains("paths"));
    for args in [
        &["demo", "-o", "-"][..],
        &["man", "-"],
        &["reproduce", "--out", "-"],
    ] {
        assert_usage(&run_in(folder.path(), args), "standard output");
    }
    assert_eq!(names_in(folder.path()), ["site.lif.json"]);
}

#[test]
fn limits_and_formats_can_be_set() {
    let folder = folder_with_site();
    let info = |more: &[&str]| run_in(folder.path(), &[&["info", "site.lif.json"], more].concat());
    let output = info(&["--limit", "paths=3"]);
    assert_usage(&output, "`--limit paths=N`");
    assert_eq!(info(&["--limit", "paths=1_000_000"]).status.code(), Some(0));
    assert_usage(&info(&["--limit", "size=3"]), "output-bytes");
    assert_usage(&info(&["--formats", "dxf,svg"]), "--formats");
    assert_eq!(info(&["--formats", "dxf,lif"]).status.code(), Some(0));
    let output = info(&["--formats", "arrow", "--json"]);
    assert_eq!(json(&output, "error")["error"]["code"], "format-off");
    let convert = [
        "convert",
        "site.lif.json",
        "a.dxf",
        "--limit",
        "output-bytes=100",
    ];
    assert_usage(&run_in(folder.path(), &convert), "limit of 100 bytes");
    assert_eq!(names_in(folder.path()), ["site.lif.json"]);
}

#[cfg(unix)]
#[test]
fn output_that_is_the_input_under_another_name_is_refused() {
    let folder = folder_with_site();
    let before = fs::read(site()).unwrap();
    fs::hard_link(
        folder.path().join("site.lif.json"),
        folder.path().join("b.lif.json"),
    )
    .unwrap();
    let output = run_in(folder.path(), &["convert", "site.lif.json", "b.lif.json"]);
    assert_usage(&output, "would replace an input");
    assert_eq!(fs::read(folder.path().join("b.lif.json")).unwrap(), before);
}

#[cfg(unix)]
#[test]
fn full_disk_leaves_no_page_and_is_told_as_such() {
    // The shell limits the size of files to one block of 512 bytes, and ignores its signal.
    let folder = folder_with_site();
    let limited = |args: &str| {
        let guideway = env!("CARGO_BIN_EXE_guideway");
        let script = format!("trap '' XFSZ; ulimit -f 1; '{guideway}' {args}");
        let mut shell = std::process::Command::new("sh");
        shell
            .current_dir(folder.path())
            .args(["-c", &script])
            .output()
            .unwrap()
    };
    assert_eq!(limited("man pages").status.code(), Some(2));
    let pages = names_in(&folder.path().join("pages"));
    let size = |page: &String| {
        fs::metadata(folder.path().join("pages").join(page))
            .unwrap()
            .len()
    };
    assert!(pages.iter().all(|page| size(page) > 100), "{pages:?}");
    let output = limited("render site.lif.json -o a.png");
    assert_usage(&output, "too large");
    assert_eq!(names_in(folder.path()), ["pages", "site.lif.json"]);
}

#[cfg(target_os = "linux")]
#[test]
fn full_standard_output_is_told_as_such() {
    let full = || fs::File::options().write(true).open("/dev/full").unwrap();
    for args in [
        &["render", "-o", "-", "--size", "640x360"][..],
        &["convert", "-", "--to", "dxf"],
    ] {
        let mut all = command();
        all.arg(args[0]).arg(site()).args(&args[1..]).stdout(full());
        assert_usage(&all.output().unwrap(), "room");
    }
    for args in [&["--help"][..], &["--version"], &["info", "--help"]] {
        let mut all = command();
        assert_usage(
            &all.args(args).stdout(full()).output().unwrap(),
            "standard output",
        );
    }
}

#[cfg(target_os = "linux")]
#[test]
fn without_memory_the_command_ends_with_an_error() {
    let folder = folder_with_site();
    let guideway = env!("CARGO_BIN_EXE_guideway");
    let generated = ["generate", "d1", "--paths", "400000", "-o", "a.arrow"];
    assert_eq!(run_in(folder.path(), &generated).status.code(), Some(0));
    for kilobytes in [70_000, 100_000] {
        let script =
            format!("ulimit -v {kilobytes}; RAYON_NUM_THREADS=1 '{guideway}' info a.arrow");
        let mut shell = std::process::Command::new("sh");
        shell.current_dir(folder.path()).args(["-c", &script]);
        assert_usage(&shell.output().unwrap(), "error: out of memory");
        assert_eq!(names_in(folder.path()), ["a.arrow", "site.lif.json"]);
        let mut shell = std::process::Command::new("sh");
        shell
            .current_dir(folder.path())
            .args(["-c", &(script + " --json")]);
        let output = shell.output().unwrap();
        let report: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        assert_eq!(report["guideway"]["report"], "error");
        assert_eq!(report["error"]["code"], "out-of-memory");
        assert_eq!((output.status.code(), stderr(&output).len()), (Some(2), 0));
    }
}

#[cfg(target_os = "linux")]
#[test]
fn threads_that_cannot_start_are_an_error() {
    let folder = folder_with_site();
    let guideway = env!("CARGO_BIN_EXE_guideway");
    // A thousand stacks of 2 MiB do not fit into the memory that is left.
    for args in [
        "info site.lif.json",
        "convert site.lif.json a.arrow",
        "demo -o a.png",
        "bench d1 --paths 10 --methods cpu",
    ] {
        let script = format!("ulimit -v 600000; '{guideway}' {args}");
        let mut shell = std::process::Command::new("sh");
        shell.current_dir(folder.path()).args(["-c", &script]);
        // One arena of memory for all threads, or each would reserve one beside its stack.
        shell
            .env("RAYON_NUM_THREADS", "1000")
            .env("MALLOC_ARENA_MAX", "1");
        assert_usage(&shell.output().unwrap(), "cannot start the threads");
        assert_eq!(names_in(folder.path()), ["site.lif.json"], "{args}");
    }
}
