//! Checks the crate dependencies of ARCHITECTURE.md: one direction, no dependency between siblings.

use std::collections::BTreeMap;
use std::process::Command;

/// Allowed dependencies of each crate inside the workspace.
const ALLOWED: &[(&str, &[&str])] = &[
    ("guideway-spline", &[]),
    (SEQUENTIAL, &[]),
    ("guideway-layout", SPLINE),
    ("guideway-bad-files", &[]),
    ("guideway-growth", &[]),
    ("guideway-formats", MODEL),
    ("guideway-datasets", MODEL),
    ("guideway-scene", MODEL),
    ("guideway-envelope", MODEL),
    ("guideway-network", MODEL),
    ("guideway-cpu", SCENE),
    ("guideway-gpu", SCENE),
    ("guideway-tessellation", SCENE),
    ("guideway-document", SCENE),
    ("guideway-tiles", SCENE),
    (
        "guideway-png",
        &["guideway-spline", "guideway-formats", "guideway-scene"],
    ),
    (
        "guideway-grid",
        &[
            "guideway-spline",
            "guideway-layout",
            "guideway-scene",
            "guideway-gpu",
        ],
    ),
    (
        "guideway-tree",
        &[
            "guideway-spline",
            "guideway-layout",
            "guideway-scene",
            "guideway-gpu",
            "guideway-grid",
        ],
    ),
    (
        "guideway-viewer",
        &[
            "guideway-spline",
            "guideway-layout",
            "guideway-envelope",
            "guideway-network",
            "guideway-scene",
            "guideway-document",
            "guideway-compose",
        ],
    ),
    (
        "guideway-compose",
        &[
            "guideway-spline",
            "guideway-layout",
            "guideway-formats",
            "guideway-envelope",
            "guideway-scene",
            "guideway-cpu",
            "guideway-document",
            "guideway-png",
        ],
    ),
    (
        "guideway-laws",
        &[
            "guideway-bad-files",
            "guideway-spline",
            "guideway-layout",
            "guideway-formats",
            "guideway-scene",
            "guideway-document",
        ],
    ),
    (
        "guideway-bench",
        &[
            "guideway-spline",
            "guideway-layout",
            "guideway-datasets",
            "guideway-network",
            "guideway-scene",
        ],
    ),
    (
        "guideway-reproduce",
        &[
            "guideway-spline",
            "guideway-layout",
            "guideway-datasets",
            "guideway-scene",
            "guideway-bench",
        ],
    ),
    ("guideway-python", &["guideway"]),
    ("guideway-c", &["guideway"]),
    (
        "guideway-window",
        &["guideway", "guideway-bench", "guideway-viewer"],
    ),
    ("guideway-web", &["guideway"]),
];

const SPLINE: &[&str] = &["guideway-spline"];
const MODEL: &[&str] = &["guideway-spline", "guideway-layout"];
const SCENE: &[&str] = &["guideway-spline", "guideway-layout", "guideway-scene"];

/// External crates that only the listed crates may depend on.
const RESTRICTED: &[(&str, &str)] = &[
    ("arrow-ipc", "guideway-formats"),
    // Its casts are a quarter of a build.
    ("arrow-cast", "tests"),
    ("encoding_rs", "guideway-formats"),
    ("roxmltree", "guideway-formats"),
    ("saphyr-parser", "guideway-formats"),
    ("svgtypes", "guideway-formats"),
    (
        "serde_json",
        "guideway-formats guideway-envelope guideway guideway-c guideway-tests guideway-tiles \
         guideway-web guideway-window xtask",
    ),
    ("anstream", "guideway"),
    ("clap", "guideway"),
    ("indicatif", "guideway"),
    (
        "png",
        "guideway-png guideway-formats guideway-bench guideway-reproduce guideway-tests \
         guideway-tiles xtask",
    ),
    ("wgpu", "guideway-gpu guideway-grid guideway-tree"),
    ("glow", "guideway-tessellation"),
    ("khronos-egl", "guideway-tessellation"),
    ("winit", "guideway-viewer"),
    ("eframe", "guideway-viewer"),
    ("etcetera", "guideway-window"),
    ("rfd", "guideway-window"),
    ("zune-jpeg", "guideway-formats"),
    ("fontdb", "guideway-compose"),
    ("harfrust", "guideway-compose"),
    ("i_overlay", "guideway-compose"),
    ("skrifa", "guideway-compose"),
    ("rstar", "guideway-envelope guideway-network"),
    ("toml", "guideway guideway-network guideway-viewer"),
    ("earcut", "guideway-envelope"),
    ("roaring", "guideway-document"),
    ("pyo3", "guideway-python"),
    // Browsers have tables of encodings.
    ("wasm-bindgen", "guideway-formats guideway-web"),
    ("web-time", "guideway-layout"),
];

/// Stands for rayon, and like it serves any crate.
const SEQUENTIAL: &str = "guideway-sequential";

type Dependencies = BTreeMap<String, Vec<String>>;

fn violations(dependencies: &Dependencies) -> Vec<String> {
    let mut found = Vec::new();
    for (krate, names) in dependencies {
        let allowed = ALLOWED
            .iter()
            .find(|(name, _)| name == krate)
            .map(|(_, allowed)| *allowed);
        for name in names {
            let inside = name.starts_with("guideway") && name != SEQUENTIAL;
            if inside && allowed.is_some_and(|allowed| !allowed.contains(&name.as_str())) {
                found.push(format!("{krate} -> {name}: this dependency is not allowed"));
            }
            let users = RESTRICTED
                .iter()
                .find(|(restricted, _)| restricted == name)
                .map(|(_, users)| *users);
            if users.is_some_and(|users| !users.split(' ').any(|user| user == krate)) {
                found.push(format!(
                    "{krate} -> {name}: only {} may depend on it",
                    users.unwrap_or("")
                ));
            }
        }
        if allowed.is_none() && !["guideway", "guideway-tests", "xtask"].contains(&krate.as_str()) {
            found.push(format!(
                "{krate}: list the allowed dependencies of the new crate in this test"
            ));
        }
    }
    found
}

fn workspace_dependencies() -> Dependencies {
    let output = Command::new(env!("CARGO"))
        .args([
            "metadata",
            "--no-deps",
            "--format-version",
            "1",
            "--offline",
        ])
        .output()
        .expect("cargo runs");
    let metadata: serde_json::Value = serde_json::from_slice(&output.stdout).expect("valid JSON");
    let packages = metadata["packages"].as_array().expect("a list of packages");
    let name = |v: &serde_json::Value| v["name"].as_str().expect("a name").to_owned();
    let is_dev = |d: &serde_json::Value| d["kind"] == "dev";
    let all = packages.iter().map(|package| {
        let dependencies = package["dependencies"].as_array().expect("a list");
        (
            name(package),
            dependencies
                .iter()
                .filter(|d| !is_dev(d))
                .map(name)
                .collect(),
        )
    });
    all.collect()
}

#[test]
fn crate_dependencies_are_allowed() {
    let dependencies = workspace_dependencies();
    assert!(
        dependencies.len() >= 9,
        "the workspace has members: {dependencies:?}"
    );
    let found = violations(&dependencies);
    assert!(found.is_empty(), "{}", found.join("\n"));
}

#[test]
fn finds_forbidden_dependencies() {
    let one =
        |krate: &str, name: &str| Dependencies::from([(krate.to_owned(), vec![name.to_owned()])]);
    assert_eq!(
        violations(&one("guideway-spline", "guideway-layout")).len(),
        1,
        "backwards"
    );
    assert_eq!(
        violations(&one("guideway-scene", "guideway-formats")).len(),
        1,
        "siblings"
    );
    assert_eq!(
        violations(&one("guideway-cpu", "wgpu")).len(),
        1,
        "restricted"
    );
    assert_eq!(
        violations(&one("guideway-new", "serde")).len(),
        1,
        "unknown crate"
    );
    assert!(violations(&one("guideway", "guideway-cpu")).is_empty());
}

#[test]
fn default_features_off_exclude_arrow_and_gpu_libraries() {
    let output = Command::new(env!("CARGO"))
        .args([
            "tree",
            "--package",
            "guideway",
            "--no-default-features",
            "--edges",
            "normal",
            "--prefix",
            "none",
            "--offline",
        ])
        .output()
        .expect("cargo runs");
    let tree = String::from_utf8_lossy(&output.stdout);
    assert!(tree.contains("guideway-cpu"), "{tree}");
    for heavy in ["arrow-", "wgpu ", "ash ", "glow ", "khronos-egl "] {
        assert!(
            !tree.lines().any(|line| line.starts_with(heavy)),
            "{heavy} is a dependency"
        );
    }
}
