//! `guideway render` and `guideway demo`.

use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::Stdio;

use crate::support::{command, has_keys, json, names_in, run, site, stderr, stdout};

/// Size and pixels of a PNG file.
fn read_png(path: &Path) -> (u32, u32, Vec<u8>) {
    let file = std::io::BufReader::new(File::open(path).unwrap());
    let mut reader = png::Decoder::new(file).read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut pixels).unwrap();
    (info.width, info.height, pixels)
}

fn render(picture: &Path, more: &[&str]) -> std::process::Output {
    let site = site();
    let mut all = command();
    all.arg("render")
        .arg(site)
        .arg("-o")
        .arg(picture)
        .args(more);
    all.output().unwrap()
}

fn ink(pixels: &[u8]) -> usize {
    let white = [255; 4];
    pixels
        .chunks_exact(4)
        .filter(|pixel| *pixel != white)
        .count()
}

#[test]
fn a_file_becomes_a_picture_of_the_size_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    let picture = folder.path().join("site.png");
    let output = render(&picture, &["--size", "640x360"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let said = stdout(&output);
    assert!(
        said.contains("640 x 360") && said.contains("took "),
        "{said}"
    );
    let (width, height, pixels) = read_png(&picture);
    assert_eq!((width, height), (640, 360));
    assert!(ink(&pixels) > 2000, "{}", ink(&pixels));
    assert_eq!(names_in(folder.path()), ["site.png"]);
}

#[test]
fn the_json_report_accounts_for_every_path() {
    let folder = tempfile::tempdir().unwrap();
    let picture = folder.path().join("site.png");
    let args = [
        "--json",
        "--size",
        "320x200",
        "--color-by",
        "maxSpeed",
        "--level",
        "hall",
    ];
    let report = json(&render(&picture, &args), "render");
    has_keys(
        &report,
        &[
            "file",
            "output",
            "format",
            "format_version",
            "size_px",
            "view.center_m",
            "view.px_per_m",
            "view.min_m",
            "view.max_m",
            "method.name",
            "method.device",
            "paths.total",
            "lines",
            "peak_bytes",
            "bands",
            "stages",
            "legend.column",
            "legend.is_continuous",
            "legend.entries",
            "findings.errors",
            "findings.warnings",
            "ms.read",
            "ms.scene",
            "ms.prepare",
            "ms.render",
            "ms.write",
            "ms.total",
        ],
    );
    let count = |key: &str| report["paths"][key].as_u64().unwrap();
    let parts = ["drawn", "outside", "hidden", "refused"].map(count);
    assert_eq!(parts.iter().sum::<u64>(), count("total"));
    assert!(count("hidden") > 0, "the mezzanine is hidden");
}

#[test]
fn every_option_of_the_look_changes_the_picture() {
    let folder = tempfile::tempdir().unwrap();
    let pixels = |more: &[&str]| {
        let picture = folder.path().join("a.png");
        let args: Vec<&str> = ["--size", "160x90"].iter().chain(more).copied().collect();
        let output = render(&picture, &args);
        assert_eq!(
            output.status.code(),
            Some(0),
            "{more:?}: {}",
            stderr(&output)
        );
        read_png(&picture).2
    };
    let plain = pixels(&[]);
    assert_eq!(
        plain,
        pixels(&["--fit", "--method", "auto", "--threads", "1"])
    );
    for more in [
        &["--center", "-3,4", "--scale", "2"][..],
        &["--center", "80,40"],
        &["--scale", "3"],
        &["--width", "3"],
        &["--min-px", "4"],
        &["--line-rule", "thesis"],
        &["--color", "ff0000"],
        &["--background", "#000000"],
        &["--color-by", "vehicle_type"],
        &["--shade", "density"],
        &["--shade", "density", "--tone", "linear"],
        &["--shade", "density", "--tone", "equalized"],
        &["--level", "Mezzanine"],
    ] {
        assert!(pixels(more) != plain, "{more:?}");
    }
}

#[test]
fn values_that_make_no_sense_are_refused_with_an_example() {
    let folder = tempfile::tempdir().unwrap();
    let picture = folder.path().join("a.png");
    for (args, said) in [
        (&["--size", "0x0"][..], "1920x1080"),
        (&["--size", "1e9x2"], "1920x1080"),
        (&["--scale", "NaN"], "such as"),
        (&["--scale", "-2"], "such as"),
        (&["--center", "1;2"], "12.5,-3"),
        (&["--fit", "--center", "1,2"], "--center 12.5,-3"),
        (&["--fit", "--scale", "2"], "--scale 40"),
        (&["--color", "red"], "ffcc00"),
        (&["--tone", "log"], "--shade density"),
        (&["--min-px", "5", "--max-px", "2"], "--min-px 1"),
        (&["--line-rule", "thesis", "--width", "1"], "--width 0.2"),
        (&["--level", "attic"], "hall (Hall), mezzanine (Mezzanine)"),
        (&["--color-by", "mood"], "maxSpeed"),
        (&["--method", "magic"], "cpu"),
        (&["--memory", "0"], "--memory"),
    ] {
        let output = render(&picture, args);
        assert_eq!(output.status.code(), Some(2), "{args:?}");
        let text = stderr(&output);
        assert!(
            text.starts_with("error: ") && text.contains(said),
            "{args:?}: {text}"
        );
        let args: Vec<&str> = args.iter().chain(&["--json"]).copied().collect();
        let output = render(&picture, &args);
        assert_eq!(output.status.code(), Some(2), "{args:?}");
        has_keys(
            &json(&output, "error"),
            &["error.code", "error.message", "error.remedy"],
        );
    }
    assert!(names_in(folder.path()).is_empty());
}

#[test]
fn inputs_that_cannot_be_read_leave_no_picture() {
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
fn outputs_that_cannot_be_written_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let copy = folder.path().join("site.lif.json");
    fs::copy(site(), &copy).unwrap();
    let before = fs::read(&copy).unwrap();
    let aim = |output: PathBuf| {
        command()
            .arg("render")
            .arg(&copy)
            .arg("-o")
            .arg(output)
            .output()
            .unwrap()
    };
    let roundabout = folder.path().join(".").join("site.lif.json");
    for output in [
        copy.clone(),
        roundabout,
        folder.path().to_owned(),
        folder.path().join("no/a.png"),
    ] {
        let result = aim(output.clone());
        assert_eq!(result.status.code(), Some(2), "{}", output.display());
        assert!(stderr(&result).contains("\nhint: "));
    }
    assert_eq!(fs::read(&copy).unwrap(), before);
    assert_eq!(names_in(folder.path()), ["site.lif.json"]);
}

#[cfg(unix)]
#[test]
fn a_full_disk_is_an_error() {
    if Path::new("/dev/full").exists() {
        let output = render(Path::new("/dev/full"), &["--size", "640x360"]);
        assert_eq!(output.status.code(), Some(2));
        assert!(stderr(&output).contains("room"), "{}", stderr(&output));
    }
}

#[cfg(unix)]
#[test]
fn a_picture_is_as_readable_as_any_new_file() {
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
fn names_need_not_be_utf8() {
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
fn a_picture_goes_to_standard_output_alone() {
    let output = render(Path::new("-"), &["--size", "64x64"]);
    assert_eq!(output.status.code(), Some(0));
    assert!(output.stdout.starts_with(b"\x89PNG"));
    assert!(stderr(&output).contains("paths drawn"));
    let both = render(Path::new("-"), &["--json"]);
    assert_eq!(both.status.code(), Some(2));
    assert_eq!(json(&both, "error")["error"]["code"], "usage");
}

#[test]
fn quiet_says_nothing_and_a_closed_pipe_is_no_error() {
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

#[test]
fn the_demo_needs_no_file() {
    let folder = tempfile::tempdir().unwrap();
    let output = command()
        .arg("demo")
        .current_dir(folder.path())
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let said = stdout(&output);
    for part in ["demo.png", "paths drawn", "took ", "guideway render"] {
        assert!(said.contains(part), "{part} in {said}");
    }
    assert!(ink(&read_png(&folder.path().join("demo.png")).2) > 10_000);

    let other = folder.path().join("other.png");
    let output = command()
        .args(["demo", "--json", "-o"])
        .arg(&other)
        .output()
        .unwrap();
    let keys = [
        "output",
        "paths.drawn",
        "paths.total",
        "method.name",
        "ms.total",
    ];
    has_keys(&json(&output, "demo"), &keys);
}

#[test]
fn real_layouts_are_drawn() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/layouts");
    if !folder.is_dir() {
        eprintln!("SKIPPED: no real layouts at {}", folder.display());
        return;
    }
    let pictures = tempfile::tempdir().unwrap();
    let picture = pictures.path().join("a.png");
    let mut drawn = 0;
    for kind in ["lif", "opentcs"] {
        for entry in fs::read_dir(folder.join(kind)).unwrap() {
            let input = entry.unwrap().path();
            let mut all = command();
            all.arg("render").arg(&input).arg("-o").arg(&picture);
            let output = all.args(["--size", "320x200", "--json"]).output().unwrap();
            assert_eq!(
                output.status.code(),
                Some(0),
                "{}: {}",
                input.display(),
                stdout(&output)
            );
            assert!(ink(&read_png(&picture).2) > 20, "{}", input.display());
            drawn += 1;
        }
    }
    assert!(drawn > 15, "{drawn} files");
}

#[test]
fn a_method_that_draws_pictures_only_whole_says_so_of_a_large_one() {
    let folder = tempfile::tempdir().unwrap();
    let picture = folder.path().join("a.png");
    let output = render(&picture, &["--size", "40000x40000", "--method", "oracle"]);
    assert_eq!(output.status.code(), Some(2));
    let said = stderr(&output);
    assert!(
        said.contains("40000 x 40000") && said.contains("--method cpu"),
        "{said}"
    );
    assert!(names_in(folder.path()).is_empty());
}
