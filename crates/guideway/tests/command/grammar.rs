//! Arguments that every command understands alike: `-`, endings, default names, near names.

use std::fs::{self, File};
use std::path::Path;
use std::process::{Command, Output, Stdio};

use super::support::{command, json, names_in, run, site, stderr, stdout};

/// Runs a command whose standard input is a file.
fn run_with_input(input: &Path, args: &[&str]) -> Output {
    let mut command = command();
    command
        .args(args)
        .stdin(Stdio::from(File::open(input).unwrap()));
    command.output().unwrap()
}

fn in_folder(folder: &Path, args: &[&str]) -> Output {
    let mut command = command();
    command.args(args).current_dir(folder);
    command.output().unwrap()
}

#[test]
fn dash_reads_standard_input() {
    let folder = tempfile::tempdir().unwrap();
    let named = json(
        &run([Path::new("info"), &site(), Path::new("--json")]),
        "info",
    );
    let piped = json(&run_with_input(&site(), &["info", "-", "--json"]), "info");
    assert_eq!(named["paths"], piped["paths"]);
    assert_eq!(piped["file"], "-");
    let checked = run_with_input(&site(), &["check", "-"]);
    assert!(
        stdout(&checked).contains("326 paths"),
        "{}",
        stdout(&checked)
    );
    let lines = folder.path().join("site.geojson");
    fs::write(
        &lines,
        run_with_input(&site(), &["convert", "-", "-", "--to", "geojson"]).stdout,
    )
    .unwrap();
    let arrow = run_with_input(&lines, &["convert", "-", "-", "--to", "arrow"]);
    let table = folder.path().join("site.arrow");
    fs::write(&table, arrow.stdout).unwrap();
    let back = json(&run_with_input(&table, &["info", "-", "--json"]), "info");
    assert_eq!(named["paths"], back["paths"]);
    assert_eq!(named["stations"], back["stations"]);
}

#[test]
fn convert_takes_its_output_last_or_by_o() {
    let folder = tempfile::tempdir().unwrap();
    let path = site();
    let file = path.to_str().unwrap();
    let last = in_folder(folder.path(), &["convert", file, "last.geojson"]);
    let named = in_folder(folder.path(), &["convert", file, "-o", "named.geojson"]);
    assert!(last.status.success() && named.status.success());
    let bytes = |name: &str| fs::read(folder.path().join(name)).unwrap();
    assert_eq!(bytes("last.geojson"), bytes("named.geojson"));
    let missing = in_folder(folder.path(), &["convert", file]);
    assert_eq!(missing.status.code(), Some(2));
    assert!(stderr(&missing).contains("by -o"), "{}", stderr(&missing));
}

#[test]
fn dash_is_read_once_and_limits_hold() {
    let twice = run_with_input(&site(), &["info", "-", "-"]);
    assert!(stderr(&twice).contains("given twice"), "{}", stderr(&twice));
    let small = run_with_input(&site(), &["info", "-", "--limit", "file-bytes=10k"]);
    assert_eq!(small.status.code(), Some(2));
    assert!(
        stderr(&small).contains("bytes in the file"),
        "{}",
        stderr(&small)
    );
    let empty = run_with_input(Path::new("/dev/null"), &["check", "-"]);
    assert_eq!(empty.status.code(), Some(2));
    assert!(
        stderr(&empty).contains("standard input"),
        "{}",
        stderr(&empty)
    );
}

/// The standard output of a command, after a check that its report went elsewhere.
fn piped_out(out: Output, report: &str) -> Vec<u8> {
    assert!(out.status.success(), "{}", stderr(&out));
    assert!(stderr(&out).contains(report), "{}", stderr(&out));
    out.stdout
}

#[test]
fn dash_is_standard_output_of_every_command() {
    let folder = tempfile::tempdir().unwrap();
    let site = site();
    let name = site.to_str().unwrap();
    let made = piped_out(
        run(["generate", "d1", "--paths", "200", "-o", "-"]),
        "200 paths",
    );
    let table = folder.path().join("d1.arrow");
    fs::write(&table, made).unwrap();
    let read = json(&run_with_input(&table, &["info", "-", "--json"]), "info");
    assert_eq!(read["paths"], 200);

    // Without --to, the format is that of the input.
    let lif = piped_out(run(["convert", name, "-"]), "326 paths");
    assert_eq!(lif, fs::read(&site).unwrap());
    let steps = folder.path().join("steps.json");
    fs::write(&steps, r#"{"steps": []}"#).unwrap();
    let script = ["edit", name, "--script", "-", "-o", "-"];
    assert_eq!(piped_out(run_with_input(&steps, &script), "kB"), lif);
    let lines = r#"{"type": "LineString", "coordinates": [[0, 0], [9, 0], [9, 9]]}"#;
    let plan = folder.path().join("plan.geojson");
    fs::write(&plan, lines).unwrap();
    let network = ["network", plan.to_str().unwrap(), "-o", "-", "--to", "lif"];
    let network = piped_out(run(network), "took");
    assert!(network.starts_with(b"{") && network.windows(7).any(|text| text == b"\"nodes\""));
    let route = [
        "route",
        name,
        "dock-1",
        "charger-1",
        "--vehicle-type",
        "tugger-3000",
    ];
    let route = [&route[..], &["-o", "-", "--to", "geojson"]].concat();
    let route: serde_json::Value = serde_json::from_slice(&piped_out(run(route), " m, ")).unwrap();
    assert_eq!(route["type"], "FeatureCollection");

    let png = b"\x89PNG";
    let picture = piped_out(run(["render", name, "-o", "-", "--size", "64x64"]), "took");
    assert!(picture.starts_with(png));
    let changes = ["diff", name, name, "-o", "-", "--to", "svg"];
    assert!(piped_out(run(changes), "no difference").starts_with(b"<svg"));
    let findings = ["check", name, "--picture", "-"];
    assert!(piped_out(run(findings), "326 paths").starts_with(png));

    for (args, said) in [
        (&["convert", name, "-", "--json"][..], "cannot hold both"),
        (
            &[
                "route",
                name,
                "dock-1",
                "charger-1",
                "-o",
                "-",
                "--format",
                "json",
            ],
            "cannot hold both",
        ),
        (
            &["check", name, "--picture", "-", "--format", "sarif"],
            "cannot hold both",
        ),
        (&["edit", "-", "--script", "-", "--dry-run"], "given twice"),
    ] {
        let out = run_with_input(&steps, args);
        assert_eq!(out.status.code(), Some(2), "{args:?}");
        let all = stdout(&out) + &stderr(&out);
        assert!(all.contains(said), "{args:?}: {all}");
    }
}

#[cfg(unix)]
#[test]
fn pipes_of_the_shell_are_files() {
    let mut shell = Command::new("bash");
    let line = r#""$0" info <(cat "$1") && cat "$1" | "$0" check /dev/stdin"#;
    let out = shell
        .args(["-c", line, env!("CARGO_BIN_EXE_guideway")])
        .arg(site())
        .output();
    let out = out.unwrap();
    assert!(out.status.success(), "{}", stderr(&out));
    assert!(stdout(&out).contains("326 paths"), "{}", stdout(&out));
}

#[test]
fn pictures_have_the_ending_of_what_they_are() {
    let folder = tempfile::tempdir().unwrap();
    let site = site();
    let site = site.to_str().unwrap();
    for name in ["a.jpg", "plan"] {
        for args in [
            vec!["render", site, "-o", name],
            vec!["diff", site, site, "-o", name],
            vec!["check", site, "--picture", name],
        ] {
            let out = in_folder(folder.path(), &args);
            assert_eq!(out.status.code(), Some(2), "{args:?}");
            assert!(stderr(&out).contains("PNG, SVG or PDF"), "{}", stderr(&out));
        }
    }
    assert!(names_in(folder.path()).is_empty(), "nothing was written");
}

#[test]
fn render_without_a_name_never_replaces_a_file() {
    let folder = tempfile::tempdir().unwrap();
    let site = site();
    let args = ["render", site.to_str().unwrap(), "--size", "64x64"];
    let first = in_folder(folder.path(), &args);
    assert!(first.status.success(), "{}", stderr(&first));
    assert_eq!(names_in(folder.path()), ["site.png"]);
    let again = in_folder(folder.path(), &args);
    assert_eq!(again.status.code(), Some(2));
    assert!(
        stderr(&again).contains("`-o site.png` replaces it"),
        "{}",
        stderr(&again)
    );
}

#[test]
fn json_of_lif_is_lif_and_a_contradiction_is_said() {
    let folder = tempfile::tempdir().unwrap();
    let site = site();
    let site = site.to_str().unwrap();
    let out = in_folder(folder.path(), &["convert", site, "copy.json"]);
    assert!(out.status.success(), "{}", stderr(&out));
    let copy = fs::read(folder.path().join("copy.json")).unwrap();
    assert_eq!(copy, fs::read(site).unwrap());
    let out = in_folder(
        folder.path(),
        &["convert", site, "out.lif.json", "--to", "arrow"],
    );
    let said = stderr(&out);
    assert!(
        said.contains("holds Arrow") && said.contains("LIF 1.0"),
        "{said}"
    );
    let out = in_folder(
        folder.path(),
        &["convert", site, "out.lif.json", "--to", "lif2"],
    );
    assert!(!stderr(&out).contains("note"), "{}", stderr(&out));
    let out = in_folder(folder.path(), &["convert", site, "out.txt"]);
    assert_eq!(out.status.code(), Some(2));
}

#[test]
fn a_file_alone_is_summarized_without_a_display() {
    let mut command = command();
    command.env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY");
    let out = command.arg(site()).arg("--json").output().unwrap();
    assert_eq!(json(&out, "info")["paths"], 326);
}

#[test]
fn near_names_are_suggested() {
    let site = site();
    for (option, near) in [
        (["--color-by", "maxspeed"], "did you mean `maxSpeed`?"),
        (["--level", "Hal"], "did you mean `hall (Hall)`?"),
    ] {
        let args = [
            "render",
            site.to_str().unwrap(),
            "-o",
            "/dev/null",
            option[0],
            option[1],
        ];
        let out = run(args);
        assert_eq!(out.status.code(), Some(2));
        assert!(stderr(&out).contains(near), "{}", stderr(&out));
    }
}

#[test]
fn an_empty_view_says_where_the_paths_are() {
    let folder = tempfile::tempdir().unwrap();
    let site = site();
    let place = ["--center", "-500,-3", "--scale", "40", "--size", "64x64"];
    let mut args = vec!["render", site.to_str().unwrap(), "-o", "a.png"];
    args.extend(place);
    let out = in_folder(folder.path(), &args);
    let said = stdout(&out);
    assert!(
        said.contains("no path is in this view; they lie from (2.0, 2.0)"),
        "{said}"
    );
}

#[test]
fn every_command_has_json() {
    let script = json(&run(["completions", "bash", "--json"]), "completions");
    assert!(script["script"].as_str().unwrap().contains("_guideway"));
    let page = json(&run(["man", "--json"]), "man");
    assert!(page["page"].as_str().unwrap().starts_with(".ie"), "{page}");
    let missing = run(["view", "nope.lif.json"]);
    assert!(stderr(&missing).contains("nope.lif.json: the file does not exist"));
    let missing = run(["reproduce", "--from", "nope.json"]);
    assert!(stderr(&missing).contains("nope.json: the file does not exist"));
}

#[test]
fn pictures_say_where_they_are() {
    let folder = tempfile::tempdir().unwrap();
    let site = site();
    let mut args = vec![
        "render",
        site.to_str().unwrap(),
        "-o",
        "a.png",
        "--world-file",
    ];
    args.extend(["--center", "50,20", "--scale", "4", "--size", "200x100"]);
    args.extend(["--title", "Halle \u{4e00}"]);
    let out = in_folder(folder.path(), &args);
    assert!(out.status.success(), "{}", stderr(&out));
    assert_eq!(names_in(folder.path()), ["a.pgw", "a.png"]);
    let world = fs::read_to_string(folder.path().join("a.pgw")).unwrap();
    assert_eq!(world, "0.25\n0\n0\n-0.25\n25.125\n32.375\n");
    let file = std::io::BufReader::new(File::open(folder.path().join("a.png")).unwrap());
    let reader = png::Decoder::new(file).read_info().unwrap();
    let texts = &reader.info().utf8_text;
    let text = |keyword: &str| {
        let chunk = texts.iter().find(|chunk| chunk.keyword == keyword);
        chunk.unwrap().get_text().unwrap()
    };
    assert_eq!(text("guideway:bounds_m"), "25 7.5 75 32.5");
    assert_eq!(text("guideway:px_per_m"), "4");
    assert_eq!(text("Title"), "Halle \u{4e00}");
    for output in ["-", "a.svg"] {
        let out = in_folder(
            folder.path(),
            &[
                "render",
                site.to_str().unwrap(),
                "-o",
                output,
                "--world-file",
            ],
        );
        assert!(
            stderr(&out).contains("--world-file places a PNG"),
            "{}",
            stderr(&out)
        );
    }
}
