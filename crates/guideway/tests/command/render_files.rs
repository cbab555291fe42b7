//! Tests of the files of `guideway render`: inputs, outputs, standard output.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Stdio;

#[cfg(target_os = "linux")]
use crate::support::read_png;
use crate::support::{command, json, names_in, render, run, site, stderr};

#[test]
fn unreadable_inputs_leave_no_picture() {
    let folder = tempfile::tempdir().unwrap();
    let picture = folder.path().join("a.png");
    let whole = fs::read(site()).unwrap();
    let inputs: [(&str, &[u8]); 4] = [
        ("empty.json", b""),
        ("truncated.json", &whole[..whole.len() / 2]),
        ("binary.json", &[0, 159, 146, 150, 7, 0, 0, 1]),
        ("other.json", b"{\"hello\": 1}"),
    ];
    for (name, bytes) in inputs {
        let inputs = tempfile::tempdir().unwrap();
        let input = inputs.path().join(name);
        fs::write(&input, bytes).unwrap();
        let output = command()
            .arg("render")
            .arg(&input)
            .arg("-o")
            .arg(&picture)
            .output()
            .unwrap();
        assert_eq!(output.status.code(), Some(2), "{name}");
        let text = stderr(&output);
        assert!(
            text.contains(name) && text.contains("\nhint: "),
            "{name}: {text}"
        );
    }
    for missing in ["none.json", "."] {
        let picture = picture.to_str().unwrap();
        assert_eq!(
            run(["render", missing, "-o", picture]).status.code(),
            Some(2)
        );
    }
    assert!(names_in(folder.path()).is_empty());
}

#[test]
fn rejects_unwritable_outputs() {
    let folder = tempfile::tempdir().unwrap();
    let copy = folder.path().join("site.lif.json");
    fs::copy(site(), &copy).unwrap();
    let before = fs::read(&copy).unwrap();
    let render_to = |output: PathBuf| {
        command()
            .arg("render")
            .arg(&copy)
            .arg("-o")
            .arg(output)
            .output()
            .unwrap()
    };
    let indirect = folder.path().join(".").join("site.lif.json");
    for output in [
        copy.clone(),
        indirect,
        folder.path().to_owned(),
        folder.path().join("no/a.png"),
    ] {
        let result = render_to(output.clone());
        assert_eq!(result.status.code(), Some(2), "{}", output.display());
        assert!(stderr(&result).contains("\nhint: "));
    }
    assert_eq!(fs::read(&copy).unwrap(), before);
    assert_eq!(names_in(folder.path()), ["site.lif.json"]);
}

#[cfg(unix)]
#[test]
fn full_disk_is_an_error() {
    if Path::new("/dev/full").exists() {
        let output = render(Path::new("/dev/full"), &["--size", "640x360"]);
        assert_eq!(output.status.code(), Some(2));
        assert!(stderr(&output).contains("room"), "{}", stderr(&output));
    }
}

#[cfg(unix)]
#[test]
fn picture_has_the_permissions_of_a_new_file() {
    use std::os::unix::fs::PermissionsExt;

    let folder = tempfile::tempdir().unwrap();
    let (picture, plain) = (folder.path().join("a.png"), folder.path().join("b"));
    render(&picture, &["--size", "16x16"]);
    fs::write(&plain, "").unwrap();
    let mode = |path| fs::metadata(path).unwrap().permissions().mode();
    assert_eq!(mode(&picture), mode(&plain));
}

#[cfg(target_os = "linux")]
#[test]
fn file_names_need_not_be_utf8() {
    use std::ffi::OsStr;
    use std::os::unix::ffi::OsStrExt;

    let folder = tempfile::tempdir().unwrap();
    let input = folder.path().join(OsStr::from_bytes(b"h\xe4lle.json"));
    let picture = folder.path().join(OsStr::from_bytes(b"h\xe4lle.png"));
    fs::copy(site(), &input).unwrap();
    let mut all = command();
    all.arg("render")
        .arg(&input)
        .arg("-o")
        .arg(&picture)
        .args(["--size", "64x64"]);
    assert_eq!(all.output().unwrap().status.code(), Some(0));
    assert_eq!(read_png(&picture).0, 64);
    assert_eq!(all.arg("--json").output().unwrap().status.code(), Some(0));
}

#[test]
fn standard_output_takes_the_picture_but_no_json() {
    let output = render(Path::new("-"), &["--size", "64x64"]);
    assert_eq!(output.status.code(), Some(0));
    assert!(output.stdout.starts_with(b"\x89PNG"));
    assert!(stderr(&output).contains("paths drawn"));
    let both = render(Path::new("-"), &["--json"]);
    assert_eq!(both.status.code(), Some(2));
    assert_eq!(json(&both, "error")["error"]["code"], "usage");
}

#[test]
fn quiet_prints_nothing_and_closed_pipe_is_no_error() {
    let folder = tempfile::tempdir().unwrap();
    let output = render(
        &folder.path().join("a.png"),
        &["--quiet", "--size", "64x64"],
    );
    assert_eq!(output.status.code(), Some(0));
    assert!(output.stdout.is_empty() && output.stderr.is_empty());

    let mut child = command()
        .args(["check"])
        .arg(site())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert!(output.stderr.is_empty(), "{}", stderr(&output));
}
