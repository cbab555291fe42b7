//! Tests of `guideway render` and `guideway demo`.

use std::fs;
use std::path::Path;

use crate::support::{command, has_keys, ink, json, names_in, read_png, render, stderr, stdout};

#[test]
fn renders_a_picture_of_the_requested_size() {
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
fn json_report_accounts_for_every_path() {
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
fn each_style_option_changes_the_picture() {
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
        &["--path-color", "ff0000"],
        &["--background", "#000000"],
        &["--color-by", "vehicle_type"],
        &["--color-by", "maxSpeed", "--palette", "viridis"],
        &["--color-by", "maxSpeed", "--range", "0..2"],
        &["--color-by", "maxSpeed", "--breaks", "0.9,1.3"],
        &["--background", "none"],
        &["--shade", "density"],
        &["--shade", "density", "--tone", "linear"],
        &["--shade", "density", "--tone", "equalized"],
        &["--level", "Mezzanine"],
    ] {
        assert!(pixels(more) != plain, "{more:?}");
    }
}

#[test]
fn rejects_invalid_values_with_an_example() {
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
        (&["--path-color", "red"], "ffcc00"),
        (&["--color", "ff0000"], "--path-color ff0000"),
        (&["--tone", "log"], "--shade density"),
        (&["--legend"], "--color-by maxSpeed"),
        (&["--color-by", "maxSpeed", "--range", "2..1"], "0..2"),
        (
            &["--color-by", "maxSpeed", "--palette", "rainbow"],
            "viridis",
        ),
        (&["--range", "0..2"], "--color-by"),
        (&["--breaks", "0.5,1"], "--color-by"),
        (&["--color-by", "maxSpeed", "--breaks", "1,0.5"], "0.3,0.6"),
        (
            &["--color-by", "maxSpeed", "--breaks", "1", "--range", "0..2"],
            "cannot be used with",
        ),
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
fn breaks_are_the_classes_of_the_legend() {
    let folder = tempfile::tempdir().unwrap();
    let picture = folder.path().join("site.png");
    let legend = |column: &str, breaks: &str| {
        let args = ["--json", "--size", "320x200", "--color-by", column];
        let args = [&args[..], &["--breaks", breaks]].concat();
        json(&render(&picture, &args), "render")["legend"].clone()
    };
    let speeds = legend("maxSpeed", "-1,0.9,1.3");
    assert_eq!(speeds["is_continuous"], false);
    let entries = speeds["entries"].as_array().unwrap();
    let labels: Vec<_> = entries.iter().map(|entry| &entry["label"]).collect();
    assert_eq!(
        labels[..4],
        ["below -1", "-1 to 0.9", "0.9 to 1.3", "1.3 and more"]
    );
    assert_eq!(entries[0]["paths"], 0, "classes without paths are listed");
    let paths = entries.iter().map(|entry| entry["paths"].as_u64().unwrap());
    assert_eq!(paths.sum::<u64>(), 326);
    // A column without numbers has none of them, as it has no range.
    assert_eq!(legend("direction", "1")["entries"][0]["label"], "one-way");
}

#[test]
fn demo_leaves_pictures_and_commands_that_give_more() {
    let folder = tempfile::tempdir().unwrap();
    let in_folder = |args: &[&str]| {
        let mut all = command();
        all.args(args).current_dir(folder.path()).output().unwrap()
    };
    let output = in_folder(&["demo", "--paths", "20k"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let demo = folder.path().join("guideway-demo");
    assert_eq!(
        names_in(&demo),
        [
            "crowd.png",
            "faulty.lif.json",
            "findings.png",
            "findings.txt",
            "site.lif.json",
            "site.png"
        ]
    );
    for picture in ["crowd.png", "findings.png", "site.png"] {
        assert!(ink(&read_png(&demo.join(picture)).2) > 10_000, "{picture}");
    }
    let findings = fs::read_to_string(demo.join("findings.txt")).unwrap();
    for kind in [
        "implausible",
        "node-gap",
        "unknown-node",
        "bad-knots",
        "one-way-part",
    ] {
        assert!(findings.contains(kind), "{kind} in {findings}");
    }
    let said = stdout(&output);
    let next: Vec<&str> = said
        .lines()
        .filter_map(|line| line.trim().strip_prefix("guideway "))
        .collect();
    assert_eq!(next.len(), 3, "{said}");
    for line in next {
        let args: Vec<&str> = line.split(' ').collect();
        let output = in_folder(&args);
        assert!(
            output.status.code() < Some(2),
            "{line}: {}",
            stderr(&output)
        );
    }
    let made = names_in(folder.path());
    assert_eq!(
        made,
        ["docks.png", "faults.svg", "guideway-demo", "route.pdf"]
    );
    let output = in_folder(&["demo", "--json", "--paths", "100", "-o", "other"]);
    let keys = [
        "output",
        "files",
        "paths.drawn",
        "paths.total",
        "method.name",
        "ms.total",
    ];
    has_keys(&json(&output, "demo"), &keys);
}

#[test]
fn renders_real_layouts() {
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
fn method_without_strips_rejects_a_large_picture() {
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

#[test]
fn plain_is_one_style_whatever_is_drawn() {
    let folder = tempfile::tempdir().unwrap();
    let bytes = |name: &str, more: &[&str]| {
        let picture = folder.path().join(name);
        let args: Vec<&str> = ["--size", "320x180"].iter().chain(more).copied().collect();
        let output = render(&picture, &args);
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        fs::read(&picture).unwrap()
    };
    let given = ["--width", "0.1", "--min-px", "1.5", "--max-px", "12"];
    for name in ["a.png", "a.svg"] {
        assert!(bytes(name, &given) == bytes(name, &["--plain"]), "{name}");
        assert!(bytes(name, &[]) != bytes(name, &["--plain"]), "{name}");
    }
    let output = render(&folder.path().join("c.png"), &["--plain", "--grid"]);
    assert_eq!(output.status.code(), Some(2));
}

#[test]
fn each_decoration_changes_png_and_svg() {
    let folder = tempfile::tempdir().unwrap();
    let view = ["--size", "640x360", "--center", "40,8", "--scale", "20"];
    let files = |more: &[&str]| {
        ["a.png", "a.svg"].map(|name| {
            let picture = folder.path().join(name);
            let output = render(&picture, &[&view, more].concat());
            assert_eq!(
                output.status.code(),
                Some(0),
                "{more:?}: {}",
                stderr(&output)
            );
            fs::read(&picture).unwrap()
        })
    };
    let plain = files(&[]);
    for more in [
        &["--nodes"][..],
        &["--stations"],
        &["--arrows"],
        &["--labels"],
        &["--grid"],
        &["--scale-bar"],
        &["--title", "Halle Süd"],
        &["--site"],
    ] {
        let decorated = files(more);
        for (plain, decorated) in plain.iter().zip(&decorated) {
            assert!(plain != decorated, "{more:?}");
        }
    }
    let [_, svg] = files(&["--site", "--title", "Größe Αθήνα Склад"]);
    let svg = String::from_utf8(svg).unwrap();
    for part in [
        "Größe Αθήνα Склад</text>",
        "dock-1</text>",
        "5 m</text>",
        "\"grid\"",
    ] {
        assert!(svg.contains(part), "{part}");
    }
}
