//! Tests of `network` and `route`, and of what `check` says about networks.

use std::path::{Path, PathBuf};

use crate::support::{command, has_keys, json, site, stderr, stdout};

fn guideway(args: &[&str]) -> std::process::Output {
    command().args(args).output().unwrap()
}

/// A drawing of a main line, a branch, a crossing line, a gap of 3 mm and a text.
const PLAN: &str = "0 SECTION 2 HEADER 9 $INSUNITS 70 6 0 ENDSEC 0 SECTION 2 ENTITIES \
    0 LINE 8 MAIN 10 0 20 0 11 10 21 0 0 LINE 8 BRANCH 10 5 20 0 11 5 21 4 \
    0 LINE 8 CROSS 10 2 20 -2 11 2 21 2 0 LINE 8 NEXT 10 10.003 20 0 11 15 21 0 \
    0 TEXT 8 STATION 10 15 20 0 40 0.3 1 PICK-07 0 ENDSEC 0 EOF";

fn plan(folder: &Path) -> PathBuf {
    let file = folder.join("plan.dxf");
    std::fs::write(
        &file,
        PLAN.split_whitespace().collect::<Vec<_>>().join("\n"),
    )
    .unwrap();
    file
}

fn text(path: &Path) -> &str {
    path.to_str().unwrap()
}

#[test]
fn drawing_becomes_a_network_with_a_route() {
    let folder = tempfile::tempdir().unwrap();
    let plan = plan(folder.path());
    let (out, map) = (
        folder.path().join("net.lif.json"),
        folder.path().join("plan.toml"),
    );
    let weld = ["--weld", "0.05", "--split", "--stations", "text:STATION"];
    let base = ["network", text(&plan), "-o", text(&out)];
    let made = guideway(&[&base[..], &weld, &["--json", "--save-map", text(&map)]].concat());
    assert_eq!(made.status.code(), Some(0), "{}", stderr(&made));
    let report = json(&made, "network");
    has_keys(
        &report,
        &["counts.gaps", "left_notes.count", "findings", "ms.build"],
    );
    for (name, count) in [
        ("edges", 7),
        ("nodes", 8),
        ("stations", 1),
        ("junctions", 1),
        ("crossings", 1),
    ] {
        assert_eq!(report["counts"][name], count, "{name}");
    }
    // The saved options give the same network.
    let again = guideway(&[&base[..], &["--map", text(&map)]].concat());
    let said = stdout(&again);
    assert!(
        said.contains("7 edges between 8 nodes, 1 station"),
        "{said}{}",
        stderr(&again)
    );
    assert!(
        said.contains("two-way") && said.contains("joined: 1 gap"),
        "{said}"
    );
    // Writing to LIF makes an edge per direction.
    let checked = json(&guideway(&["check", "--json", text(&out)]), "check");
    assert_eq!(
        (&checked["errors"], &checked["warnings"]),
        (&0.into(), &0.into()),
        "{checked:#}"
    );
    let order = folder.path().join("order.vda5050.json");
    let found = guideway(&[
        "route",
        text(&out),
        "N1",
        "PICK-07",
        "--json",
        "-o",
        text(&order),
    ]);
    let route = json(&found, "route");
    assert_eq!(route["length_m"].as_f64().unwrap().round(), 15.0);
    assert_eq!(route["paths"].as_array().unwrap().len(), 4);
    let info = json(&guideway(&["info", "--json", text(&order)]), "info");
    assert_eq!(info["paths"], 4);
}

#[test]
fn network_mistakes_have_a_reason_and_a_remedy() {
    let folder = tempfile::tempdir().unwrap();
    let plan = plan(folder.path());
    let out = folder.path().join("net.lif.json");
    let map = folder.path().join("plan.toml");
    std::fs::write(&map, "weld = 0.05\nspilt = true\n").unwrap();
    let base = ["network", text(&plan), "-o", text(&out)];
    for (more, said) in [
        (&["--map", text(&map)][..], "line 2"),
        (&["--stations", "texts"], "text:LAYER"),
        (&["--weld", "-1"], "a number from 0"),
    ] {
        let failed = guideway(&[&base[..], more].concat());
        assert_eq!(failed.status.code(), Some(2));
        assert!(stderr(&failed).contains(said), "{}", stderr(&failed));
        assert!(!out.exists());
    }
}

#[test]
fn route_of_the_site_and_its_errors() {
    let site = site();
    let site = text(&site);
    let failed = guideway(&["route", site, "nowhere", "lift"]);
    assert!(
        stderr(&failed).contains("no vehicle type is given"),
        "{}",
        stderr(&failed)
    );
    let typed = ["--vehicle-type", "tugger-3000"];
    let failed = guideway(&[&["route", site, "nowhere", "lift"], &typed[..]].concat());
    assert!(
        stderr(&failed).contains("\"nowhere\" is no station"),
        "{}",
        stderr(&failed)
    );
}
