//! Tests of `guideway convert` and `guideway generate`.

use std::fs;
use std::path::Path;

use crate::support::{command, has_keys, json, names_in, read_png, site, stderr, stdout};

fn generate(output: &Path, args: &[&str]) -> std::process::Output {
    let mut all = command();
    all.arg("generate").args(args).arg("-o").arg(output);
    all.output().unwrap()
}

#[test]
fn a_layout_that_was_lif_has_as_many_control_points_as_before() {
    let folder = tempfile::tempdir().unwrap();
    let [first, lif, back] =
        ["d1.arrow", "d1.lif.json", "back.arrow"].map(|f| folder.path().join(f));
    assert!(generate(&first, &["d1", "--paths", "300"]).status.success());
    for (from, to) in [(&first, &lif), (&lif, &back)] {
        let output = command().arg("convert").arg(from).arg(to).output().unwrap();
        assert!(output.status.success(), "{}", stderr(&output));
    }
    let points = |file: &Path| {
        let output = command()
            .arg("info")
            .arg(file)
            .arg("--json")
            .output()
            .unwrap();
        json(&output, "info")["control_points"].as_u64().unwrap()
    };
    assert_eq!(points(&first), 300 * 11);
    assert_eq!(points(&back), points(&first));
}

#[test]
fn converted_layout_has_the_same_paths() {
    let folder = tempfile::tempdir().unwrap();
    let arrow = folder.path().join("site.arrow");
    let mut convert = command();
    convert.arg("convert").arg(site()).arg(&arrow);
    let output = convert.output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let said = stdout(&output);
    assert!(
        said.contains("took ") && !said.contains("cannot hold"),
        "{said}"
    );

    let report = json(&convert.arg("--json").output().unwrap(), "convert");
    let keys = [
        "file",
        "output",
        "format",
        "paths",
        "bytes",
        "not_stored",
        "ms.read",
        "ms.write",
    ];
    has_keys(&report, &keys);
    assert_eq!(report["not_stored"], serde_json::json!([]));
    let drawing = folder.path().join("site.dxf");
    let mut convert = command();
    convert.arg("convert").arg(site()).arg(&drawing);
    let report = json(&convert.arg("--json").output().unwrap(), "convert");
    has_keys(&report["not_stored"][0], &["place", "message"]);
    fs::remove_file(drawing).unwrap();

    let info = |file: &Path| {
        json(
            &command()
                .args(["info", "--json"])
                .arg(file)
                .output()
                .unwrap(),
            "info",
        )
    };
    let (before, after) = (info(&site()), info(&arrow));
    for key in ["paths", "segments", "nodes", "stations", "vehicle_types"] {
        assert_eq!(before[key], after[key], "{key}");
    }
    let length = |info: &serde_json::Value| info["length_m"].as_f64().unwrap();
    assert!((length(&before) - length(&after)).abs() < 0.01);
    assert_eq!(names_in(folder.path()), ["site.arrow"]);
}

#[test]
fn rejects_unknown_extensions_and_the_input_as_output() {
    let folder = tempfile::tempdir().unwrap();
    let arrow = folder.path().join("a.arrow");
    assert_eq!(
        generate(&arrow, &["d2", "--paths", "10"]).status.code(),
        Some(0)
    );
    let before = fs::read(&arrow).unwrap();
    for (output, said) in [
        ("a.dwg", ".arrow"),
        ("a", ".feather"),
        ("a.arrow", "replace"),
        ("no/b.arrow", "folder"),
    ] {
        let output = folder.path().join(output);
        let result = command()
            .arg("convert")
            .arg(&arrow)
            .arg(output)
            .output()
            .unwrap();
        assert_eq!(result.status.code(), Some(2));
        assert!(stderr(&result).contains(said), "{}", stderr(&result));
    }
    assert_eq!(fs::read(&arrow).unwrap(), before);
    assert_eq!(names_in(folder.path()), ["a.arrow"]);
}

#[test]
fn geojson_has_every_path() {
    let folder = tempfile::tempdir().unwrap();
    let target = folder.path().join("site.geojson");
    let convert = |target: &Path| {
        let mut convert = command();
        convert.arg("convert").arg(site()).arg(target);
        convert.output().unwrap()
    };
    let output = convert(&target);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let paths = |file: &Path| {
        let info = command().arg("info").arg(file).arg("--json").output();
        json(&info.unwrap(), "info")["paths"].clone()
    };
    assert_eq!(paths(&target), paths(&site()));

    let output = convert(&folder.path().join("site.dwg"));
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains(".geojson"), "{}", stderr(&output));
    assert_eq!(names_in(folder.path()), ["site.geojson"]);
}

#[test]
fn truncated_input_is_not_converted() {
    let folder = tempfile::tempdir().unwrap();
    let whole = folder.path().join("a.arrow");
    assert_eq!(
        generate(&whole, &["d1", "--paths", "500"]).status.code(),
        Some(0)
    );
    let half = folder.path().join("half.arrow");
    let bytes = fs::read(&whole).unwrap();
    fs::write(&half, &bytes[..bytes.len() / 2]).unwrap();
    let output = command()
        .arg("convert")
        .arg(&half)
        .arg(folder.path().join("b.arrow"))
        .output();
    let output = output.unwrap();
    assert_eq!(output.status.code(), Some(2));
    assert!(
        stderr(&output).contains("half.arrow"),
        "{}",
        stderr(&output)
    );
    assert_eq!(names_in(folder.path()), ["a.arrow", "half.arrow"]);
}

#[test]
fn same_seed_generates_the_same_file() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str, args: &[&str]| {
        let path = folder.path().join(name);
        let output = generate(&path, args);
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        fs::read(&path).unwrap()
    };
    let first = file("a.arrow", &["d1", "--paths", "1_000"]);
    assert_eq!(
        first,
        file("b.feather", &["d1", "--paths", "1000", "--seed", "1"])
    );
    assert_ne!(
        first,
        file("c.arrow", &["d1", "--paths", "1000", "--seed", "2"])
    );
    assert_ne!(first, file("d.arrow", &["d2", "--paths", "1000"]));

    let path = folder.path().join("a.arrow");
    let report = json(
        &generate(&path, &["d1", "--paths", "20", "--json"]),
        "generate",
    );
    has_keys(
        &report,
        &[
            "dataset", "output", "paths", "segments", "seed", "bytes", "ms.total",
        ],
    );
    assert_eq!(
        (report["paths"].as_u64(), report["segments"].as_u64()),
        (Some(20), Some(160))
    );
}

#[test]
fn rejects_invalid_numbers_of_paths_with_an_example() {
    let folder = tempfile::tempdir().unwrap();
    for paths in ["0", "-5", "1.5", "1e9", "many"] {
        let output = generate(
            &folder.path().join("a.arrow"),
            &["d1", &format!("--paths={paths}")],
        );
        assert_eq!(output.status.code(), Some(2), "{paths}");
        assert!(stderr(&output).contains("1_000_000"), "{}", stderr(&output));
    }
    assert!(names_in(folder.path()).is_empty());
}

#[cfg(unix)]
#[test]
fn ctrl_c_stops_at_once_and_removes_the_unfinished_file() {
    use std::time::{Duration, Instant};

    let folder = tempfile::tempdir().unwrap();
    let old = folder.path().join("a.arrow");
    fs::write(&old, "as it was").unwrap();
    let mut child = command()
        .args(["generate", "d1", "--paths", "100000000", "-o"])
        .arg(&old)
        .spawn()
        .unwrap();
    // A temporary file shows that the command is writing.
    let started = Instant::now();
    while names_in(folder.path()).len() < 2 {
        assert!(
            started.elapsed() < Duration::from_secs(30),
            "nothing is being written"
        );
        std::thread::sleep(Duration::from_millis(10));
    }
    std::thread::sleep(Duration::from_millis(200));
    let id = child.id().to_string();
    let kill = std::process::Command::new("kill")
        .args(["-INT", &id])
        .status()
        .unwrap();
    assert!(kill.success());
    let stopped = Instant::now();
    assert_eq!(child.wait().unwrap().code(), Some(130));
    assert!(stopped.elapsed() < Duration::from_secs(10));
    assert_eq!(names_in(folder.path()), ["a.arrow"]);
    assert_eq!(fs::read_to_string(&old).unwrap(), "as it was");
}

#[test]
fn a_view_of_a_sorted_file_reads_a_part_and_draws_the_same_picture() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str| folder.path().join(name);
    let [first, sorted] = ["d2.arrow", "sorted.arrow"].map(file);
    let generated = generate(&first, &["d2", "--paths", "70000", "--seed", "3"]);
    assert!(generated.status.success(), "{}", stderr(&generated));
    let mut convert = command();
    convert
        .arg("convert")
        .args([&first, &sorted])
        .arg("--hilbert");
    let converted = convert.output().unwrap();
    assert!(converted.status.success(), "{}", stderr(&converted));

    let render = |input: &Path, output: &Path, args: &[&str]| {
        let mut all = command();
        all.arg("render").arg(input).arg("-o").arg(output);
        let is_exact = !args.contains(&"--method");
        let method = if is_exact {
            &["--method", "oracle"][..]
        } else {
            &[]
        };
        all.args(["--size", "90x60"]).args(method).args(args);
        json(&all.arg("--json").output().unwrap(), "render")
    };
    let whole = render(&first, &file("all.png"), &["--method", "cpu"]);
    let view = &whole["view"];
    let number = |key: &str, axis: usize| view[key][axis].as_f64().unwrap();
    let side = number("max_m", 1) - number("min_m", 1);
    let center = [0, 1].map(|axis| (number("center_m", axis) + 0.2 * side).to_string());
    let center = center.join(",");
    let scale = (20.0 * view["px_per_m"].as_f64().unwrap()).to_string();
    let view = ["--center", center.as_str(), "--scale", scale.as_str()];
    for (style, is_read_in_part) in [
        (&[][..], true),
        (&["--shade", "density"], true),
        (&["--grid"], true),
        (&["--arrows"], false),
        (&["--color-by", "max_speed"], false),
    ] {
        let args = [&view[..], style].concat();
        let pictures = ["a.png", "b.png"].map(file);
        let reports = [
            render(&first, &pictures[0], &args),
            render(&sorted, &pictures[1], &args),
        ];
        let [a, b] = pictures.map(|picture| read_png(&picture).2);
        match style {
            // Arrows give way to those of paths of lower numbers.
            ["--arrows"] => {}
            _ => assert!(a == b, "{style:?}"),
        }
        let drawn = |report: &serde_json::Value| report["paths"]["drawn"].as_u64().unwrap();
        assert!(drawn(&reports[0]) > 100, "{}", reports[0]);
        assert_eq!(drawn(&reports[0]), drawn(&reports[1]), "{style:?}");
        let read = &reports[1]["read"];
        assert_eq!(read.is_object(), is_read_in_part, "{style:?}: {read}");
        if is_read_in_part {
            let bytes = |key: &str| read[key].as_u64().unwrap();
            assert_eq!(bytes("of_bytes"), fs::metadata(&sorted).unwrap().len());
            assert!(2 * bytes("bytes") < bytes("of_bytes"), "{read}");
        }
    }
}

#[test]
fn cpu_draws_a_part_of_a_sorted_file_with_the_bits_of_all_of_it() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str| folder.path().join(name);
    let [first, sorted, unsorted] = ["d1.arrow", "sorted.arrow", "unsorted.arrow"].map(file);
    let generated = generate(&first, &["d1", "--paths", "70000", "--seed", "3"]);
    assert!(generated.status.success(), "{}", stderr(&generated));
    let convert = command()
        .arg("convert")
        .args([&first, &sorted])
        .arg("--hilbert")
        .output();
    let converted = convert.unwrap();
    assert!(converted.status.success(), "{}", stderr(&converted));
    // A reader that knows no extents reads all of it.
    let mut bytes = fs::read(&sorted).unwrap();
    let key = b"guideway.extents";
    let at = bytes.windows(key.len()).rposition(|at| at == key).unwrap();
    bytes[at + key.len() - 1] = b'z';
    fs::write(&unsorted, bytes).unwrap();

    let render = |input: &Path, output: &Path, args: &[&str]| {
        let mut all = command();
        all.arg("render").arg(input).arg("-o").arg(output);
        all.args(["--size", "320x200", "--method", "cpu"])
            .args(args);
        json(&all.arg("--json").output().unwrap(), "render")
    };
    let whole = render(&sorted, &file("all.png"), &[]);
    let view = &whole["view"];
    let number = |key: &str, axis: usize| view[key][axis].as_f64().unwrap();
    for (along, factor) in [(0.1, 4.0), (0.25, 10.0), (0.4, 40.0)] {
        let side = number("max_m", 0) - number("min_m", 0);
        let center = [
            number("center_m", 0) + along * side,
            number("center_m", 1) + along * (number("max_m", 1) - number("min_m", 1)) / 2.0,
        ];
        let center = center.map(|at| at.to_string()).join(",");
        let scale = (factor * view["px_per_m"].as_f64().unwrap()).to_string();
        let args = ["--center", &center, "--scale", &scale];
        let pictures = ["a.png", "b.png"].map(file);
        let reports = [
            render(&sorted, &pictures[0], &args),
            render(&unsorted, &pictures[1], &args),
        ];
        let is_part = reports.each_ref().map(|report| report["read"].is_object());
        assert_eq!(is_part, [true, false], "{args:?}");
        let [part, all] = pictures.map(|picture| read_png(&picture).2);
        assert!(part == all, "{args:?}");
        let drawn = reports[0]["paths"]["drawn"].as_u64().unwrap();
        assert!(drawn > 20, "{drawn}");
    }
}
