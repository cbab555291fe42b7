//! Tests of `guideway tiles`: the file that it writes, and the arguments that it refuses.

use std::fs;
use std::path::Path;

use crate::support::{command, has_keys, json, names_in, run, site, stderr};

fn tiles(folder: &Path, more: &[&str]) -> std::process::Output {
    let mut all = command();
    all.current_dir(folder).arg("tiles").arg(site());
    all.args(["-o", "site.pmtiles", "--json"]).args(more);
    all.output().expect("the command starts")
}

#[test]
fn writes_one_file_of_tiles_and_nothing_else() {
    let folder = tempfile::tempdir().unwrap();
    for (content, code) in [("raster", 2), ("vector", 1)] {
        let made = tiles(folder.path(), &["--zoom", "0-2", "--content", content]);
        let report = json(&made, "tiles");
        has_keys(&report, &["grid.side", "ms.tiles", "omitted_paths"]);
        assert_eq!(report["grid"]["kind"], "plane");
        let tiles = report["tiles"].as_u64().unwrap();
        assert!((4..=21).contains(&tiles), "{report:#}");
        assert_eq!(names_in(folder.path()), ["site.pmtiles"]);
        let bytes = fs::read(folder.path().join("site.pmtiles")).unwrap();
        assert_eq!((&bytes[..8], bytes[99]), (&b"PMTiles\x03"[..], code));
        assert_eq!(report["bytes"], bytes.len());
        let addressed = u64::from_le_bytes(bytes[72..80].try_into().unwrap());
        assert_eq!(addressed, tiles);
    }
}

#[test]
fn refuses_what_does_not_apply() {
    let folder = tempfile::tempdir().unwrap();
    for (more, word) in [
        (&["--legend", "--color-by", "maxSpeed"][..], "--legend"),
        (&["--content", "vector", "--path-color", "ff0000"], "raster"),
        (&["--columns", "maxSpeed"], "vector"),
        (&["--zoom", "5-3"], "0-10"),
        (&["--zoom", "0-40"], "28"),
        (&["--level", "roof"], "roof"),
        (&["--color-by", "nothing"], "nothing"),
    ] {
        let refused = tiles(folder.path(), more);
        assert_eq!(refused.status.code(), Some(2), "{more:?}");
        let error = json(&refused, "error").to_string();
        assert!(error.contains(word), "{more:?}: {error}");
    }
    let site = site();
    let named = run([
        "tiles".as_ref(),
        site.as_os_str(),
        "-o".as_ref(),
        "a.png".as_ref(),
    ]);
    assert!(stderr(&named).contains(".pmtiles"), "{}", stderr(&named));
    assert_eq!(names_in(folder.path()), Vec::<String>::new());
}

/// With a limit of bytes per file, which fails as a full disk does.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_keeps_finished_tiles_and_the_next_run_goes_on() {
    let full = tempfile::tempdir().unwrap();
    let free = tempfile::tempdir().unwrap();
    let args = ["--zoom", "0-5"];
    let mut limited = std::process::Command::new("sh");
    limited.current_dir(full.path());
    // Blocks of 512 bytes; the signal would end the command before it can say anything.
    limited.args(["-c", "trap '' XFSZ; ulimit -f 400; exec \"$@\"", "sh"]);
    limited
        .arg(command().get_program())
        .arg("tiles")
        .arg(site());
    limited.args(["-o", "site.pmtiles", "--json"]).args(args);
    let output = limited.output().expect("sh starts");
    assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
    let error = json(&output, "error");
    let text = error.to_string();
    assert!(
        text.contains("unfinished") && text.contains("space"),
        "{text}"
    );
    assert_eq!(names_in(full.path()), ["site.pmtiles.unfinished"]);

    let resumed = json(&tiles(full.path(), &args), "tiles");
    assert!(resumed["continued"].as_u64().unwrap() > 0, "{resumed:#}");
    let whole = json(&tiles(free.path(), &args), "tiles");
    assert_eq!(
        (&whole["continued"], &whole["tiles"]),
        (&0.into(), &resumed["tiles"])
    );
    let made = [full, free].map(|folder| {
        assert_eq!(names_in(folder.path()), ["site.pmtiles"]);
        fs::read(folder.path().join("site.pmtiles")).unwrap()
    });
    assert!(made[0] == made[1]);
}
