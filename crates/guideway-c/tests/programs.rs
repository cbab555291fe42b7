//! The examples in C and C++, built against an installed library and run under AddressSanitizer.

#![cfg(target_os = "linux")]
#![expect(clippy::unwrap_used, reason = "helpers of tests may panic")]

use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::Arc;

use guideway::cpu::Cpu;
use guideway::scene::{
    Budget, Cancel, ColorBy, Frame, FrameSize, Method, Scene, SceneOptions, Style, View,
};
use xtask::dist::{Library, stage_library};

fn krate() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

fn site() -> PathBuf {
    krate().join("../guideway/examples/site.lif.json")
}

/// Builds an example with its documented command and sanitizers, and runs it in `folder`. `None` if
/// a tool is missing.
fn run(compiler: &str, source: &str, folder: &Path, args: &[&str]) -> Option<Output> {
    let missing = |tool: &&str| Command::new(tool).arg("--version").output().is_err();
    if let Some(tool) = ["pkg-config", compiler].iter().find(|tool| missing(tool)) {
        println!("SKIPPED: this system has no {tool}");
        return None;
    }
    let tests = std::env::current_exe().unwrap();
    let library = Library::in_folder(tests.parent().unwrap());
    let prefix = folder.join("prefix");
    stage_library(&krate().join("../.."), "1.2.3", &library, &prefix).unwrap();
    let flags = Command::new("pkg-config")
        .args(["--cflags", "--libs", "guideway >= 1.2"])
        .env("PKG_CONFIG_PATH", prefix.join("lib/pkgconfig"))
        .output()
        .unwrap();
    assert!(flags.status.success(), "{flags:?}");
    let flags = String::from_utf8(flags.stdout).unwrap();
    let program = folder.join("program");
    let built = Command::new(compiler)
        .args(["-Wall", "-Wextra", "-Werror", "-pedantic", "-g"])
        .args(["-fsanitize=address,undefined"])
        .arg(krate().join("examples").join(source))
        .args(flags.split_whitespace())
        .arg("-o")
        .arg(&program)
        .output()
        .unwrap();
    assert!(built.status.success(), "{built:?}");
    let ran = Command::new(&program)
        .args(args)
        .current_dir(folder)
        .env("LD_LIBRARY_PATH", prefix.join("lib"))
        .output();
    Some(ran.unwrap())
}

#[test]
fn example_in_c_draws_the_picture_that_rust_draws() {
    let folder = tempfile::tempdir().unwrap();
    let site = site();
    let args = [site.to_str().unwrap(), "site.ppm"];
    let Some(ran) = run("gcc", "site.c", folder.path(), &args) else {
        return;
    };
    let said = String::from_utf8_lossy(&ran.stdout);
    assert!(ran.status.success(), "{ran:?}");
    assert!(said.contains("\"nodes\":206,"), "{said}");
    assert!(said.contains("326 of 326 paths"), "{said}");

    let layout = Arc::new(guideway::open(&site).unwrap());
    let options = SceneOptions {
        color_by: Some(ColorBy {
            column: "maxSpeed".to_owned(),
        }),
        ..SceneOptions::default()
    };
    let scene = Arc::new(Scene::new(layout, &options).unwrap());
    let view = View::fit(FrameSize::new(640, 360).unwrap(), scene.bounds()).unwrap();
    let mut prepared = Cpu.prepare(scene, &Budget::default()).unwrap();
    let mut frame = Frame::new(view.size());
    let (style, cancel) = (Style::default(), Cancel::default());
    prepared.render(&view, &style, &cancel, &mut frame).unwrap();
    let colors = frame.pixels().iter().flat_map(|[r, g, b, _]| [*r, *g, *b]);
    let mut expected = b"P6 640 360 255\n".to_vec();
    expected.extend(colors);
    assert!(std::fs::read(folder.path().join("site.ppm")).unwrap() == expected);
}

#[test]
fn example_in_cpp_finds_a_route_and_passes_tables() {
    let folder = tempfile::tempdir().unwrap();
    let site = site();
    let args = [site.to_str().unwrap(), "dock-1", "dock-3"];
    let Some(ran) = run("g++", "tables.cpp", folder.path(), &args) else {
        return;
    };
    let said = String::from_utf8_lossy(&ran.stdout);
    assert!(ran.status.success(), "{ran:?}");
    assert!(said.contains("\"lengthM\":"), "{said}");
    assert!(said.contains("\nkind "), "{said}");
}
