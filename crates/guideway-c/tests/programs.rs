//! The examples in C and C++, built against an installed library and run under AddressSanitizer and
//! under Valgrind.

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

/// A watch over the memory of a program.
#[derive(Clone, Copy, Debug)]
enum Watch {
    /// By instructions of the compiler, in the program alone.
    Sanitizers,
    /// By executing program and library step by step.
    Valgrind,
}

impl Watch {
    const ALL: [Self; 2] = [Self::Sanitizers, Self::Valgrind];

    /// The first tool that this system lacks.
    fn missing(self, compiler: &'static str) -> Option<&'static str> {
        let own = match self {
            Self::Sanitizers => None,
            Self::Valgrind => Some("valgrind"),
        };
        let is_missing = |tool: &&str| Command::new(tool).arg("--version").output().is_err();
        ["pkg-config", compiler]
            .into_iter()
            .chain(own)
            .find(is_missing)
    }

    fn flags(self) -> &'static [&'static str] {
        match self {
            Self::Sanitizers => &["-fsanitize=address,undefined"],
            Self::Valgrind => &[],
        }
    }

    /// The command that runs a program; it fails where the memory is misused.
    fn start(self, program: &Path) -> Command {
        match self {
            Self::Sanitizers => Command::new(program),
            Self::Valgrind => {
                let mut command = Command::new("valgrind");
                command.args(["--quiet", "--error-exitcode=99", "--leak-check=full"]);
                // Threads that wait for work at the end have memory that is "possibly" lost.
                command.args([
                    "--show-leak-kinds=definite",
                    "--errors-for-leak-kinds=definite",
                ]);
                command.arg(program);
                command
            }
        }
    }
}

/// Builds a source with the documented command under a watch, and runs it in `folder`. `None` if a
/// tool is missing.
fn run(
    watch: Watch,
    compiler: &'static str,
    source: &Path,
    folder: &Path,
    args: &[&str],
) -> Option<Output> {
    if let Some(tool) = watch.missing(compiler) {
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
        .args(watch.flags())
        .arg(source)
        .args(flags.split_whitespace())
        .arg("-o")
        .arg(&program)
        .output()
        .unwrap();
    assert!(built.status.success(), "{built:?}");
    let ran = watch
        .start(&program)
        .args(args)
        .current_dir(folder)
        .env("LD_LIBRARY_PATH", prefix.join("lib"))
        .output();
    Some(ran.unwrap())
}

/// Runs an example under each watch, in a folder of its own, and passes folder and output on.
fn run_watched(
    compiler: &'static str,
    example: &str,
    args: &[&str],
    assert_right: impl Fn(&Path, &Output),
) {
    let source = krate().join("examples").join(example);
    for watch in Watch::ALL {
        let folder = tempfile::tempdir().unwrap();
        if let Some(ran) = run(watch, compiler, &source, folder.path(), args) {
            assert!(ran.status.success(), "{watch:?}: {ran:?}");
            assert_right(folder.path(), &ran);
        }
    }
}

#[test]
fn misused_memory_is_noticed() {
    let misuse = "#include <stdio.h>\n#include <stdlib.h>\n\
        int main(int count, char **words) { char *text = malloc(4); (void)words; \
        text[3 + count] = 'x'; puts(text + 3 + count); free(text); return 0; }\n";
    for watch in Watch::ALL {
        let folder = tempfile::tempdir().unwrap();
        let source = folder.path().join("misuse.c");
        std::fs::write(&source, misuse).unwrap();
        if let Some(ran) = run(watch, "gcc", &source, folder.path(), &[]) {
            assert!(!ran.status.success(), "{watch:?}: {ran:?}");
        }
    }
}

#[test]
fn example_in_c_draws_the_picture_that_rust_draws() {
    let site = site();
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
    let args = [site.to_str().unwrap(), "site.ppm"];
    run_watched("gcc", "site.c", &args, |folder, ran| {
        let said = String::from_utf8_lossy(&ran.stdout);
        assert!(said.contains("\"nodes\":206,"), "{said}");
        assert!(said.contains("326 of 326 paths"), "{said}");
        assert!(std::fs::read(folder.join("site.ppm")).unwrap() == expected);
    });
}

#[test]
fn example_in_cpp_finds_a_route_and_passes_tables() {
    let site = site();
    let args = [site.to_str().unwrap(), "dock-1", "dock-3"];
    run_watched("g++", "tables.cpp", &args, |_, ran| {
        let said = String::from_utf8_lossy(&ran.stdout);
        assert!(said.contains("\"lengthM\":"), "{said}");
        assert!(said.contains("\nkind "), "{said}");
    });
}
