//! Project chores: `cargo xtask test` installs what it needs and runs every check.

mod beside;
mod conformance;
mod debian_rust;
mod lock_files;
mod macos;
mod pack;
mod prerequisites;
mod published;
mod semver;
mod step;
mod web;
mod windows;
mod workflows;

use std::env::consts::{DLL_PREFIX, DLL_SUFFIX};
use std::path::Path;
use std::process::ExitCode;
use std::sync::LazyLock;

use anyhow::{Context, Result, anyhow, bail};
use xtask::module_graph::workspace_circles;
use xtask::style::check_repository;

use beside::Beside;
use prerequisites::{CARGO_DENY, CARGO_FUZZ, CBINDGEN, MDBOOK};
use step::{STARTED, build_with_workspace, cargo, elapsed_s, heading};

const HELP: &str = "\
cargo xtask test        everything: format, lints, all tests, docs, licenses (what CI runs)
cargo xtask quick       format, lints and tests, without installing anything
cargo xtask checks      all but format, lints and tests, which `test` runs beside the tests
cargo xtask style [WORD]
                        module circles and breaches of the style rules (in files named WORD)
cargo xtask fuzz [MINUTES [TARGET...]]
                        each fuzz target for that time (default: 1)
cargo xtask sanitize    reading of Arrow files, whose decoder has code in C, under AddressSanitizer
cargo xtask conformance [--quick] [FORMAT...]
                        what is read and written, compared with other implementations; a table
cargo xtask dist [--windows]
                        packages in target/dist/packages: .deb and .tar.xz of the programs and of
                        the C library, checksums, SBOM; .zip and installer for Windows beside them
cargo xtask header      writes the header of the C interface
cargo xtask macos       the compiler checks the programs for macOS, and runs nothing
cargo xtask semver      the interfaces of the crates, compared with those of the last tag
cargo xtask soak [MINUTES [SEED [FILE]]]
                        the window under random input for that time (default: 1); writes a record
cargo xtask web [--test | --check]
                        the page for browsers, which `guideway share` writes; its tests in
                        Chromium; whether it is older than its sources
cargo xtask windows [--test] [--quick]
                        the programs for Windows, by MinGW-w64; their tests under Wine; both with
                        little optimization
";

fn main() -> ExitCode {
    LazyLock::force(&STARTED);
    let args: Vec<String> = std::env::args().skip(1).collect();
    let task = args.first().map_or("", String::as_str);
    let outcome = match (task, &args.get(1..).unwrap_or_default()) {
        ("test", []) => test(),
        ("quick", []) => quick(),
        ("checks", []) => checks(),
        ("conformance", rest) => conformance::run(rest),
        ("fuzz", rest) => fuzz(rest),
        ("sanitize", []) => match SANITIZED_HOST {
            Some(host) => sanitize(host),
            None => Err(anyhow!(NO_SANITIZER)),
        },
        ("soak", rest) => soak(rest),
        ("dist", []) => pack::run(),
        ("dist", [arg]) if arg == "--windows" => windows::dist(),
        ("header", []) => header(),
        ("macos", []) => macos::check(),
        ("semver", []) => semver::check(),
        ("web", rest) => web::run(rest),
        ("windows", rest) => windows::run(rest),
        ("style", []) => style(""),
        ("style", [word]) => style(word),
        _ => {
            print!("{HELP}");
            return ExitCode::from(2);
        }
    };
    match outcome {
        Ok(()) => {
            println!("\nall checks passed in {:.0} s", elapsed_s());
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("\nxtask {task}: {error:#}");
            ExitCode::FAILURE
        }
    }
}

fn test() -> Result<()> {
    heading("prerequisites");
    prerequisites::rust_components()?;
    // Packages take the network, while tools are built.
    let (tools, python) = std::thread::scope(|scope| {
        let tools = scope.spawn(|| CARGO_DENY.ensure().and_then(|_| MDBOOK.ensure()));
        let python = prerequisites::debian_packages().and_then(|()| prerequisites::python());
        (tools.join(), python)
    });
    tools.map_err(|_| anyhow!("the installation of tools panicked"))??;
    step::set_env("GUIDEWAY_PYTHON", python?);
    step::set_env("GUIDEWAY_REQUIRE_DEVICES", "1");
    lints()?;
    heading("building the tests");
    cargo(&["test", "--workspace", "--no-run"]).run()?;
    build_with_workspace()?;
    // Tests wait for devices and windows, and one core is free while another ends a long test.
    let checks = Beside::start("checks")?;
    let tested = tests();
    let checked = checks.finish();
    tested.and(checked)
}

/// Every check of the built workspace but its tests.
fn checks() -> Result<()> {
    heading("Python package");
    python_package(&prerequisites::python()?)?;
    heading("conformance, a few files per format");
    conformance::run(&["--quick".to_owned()])?;
    heading("workflows of the forge");
    workflows::lint()?;
    heading("packages of the crates");
    published::check()?;
    heading("interfaces, compared with those of the last version");
    semver::check_if_known()?;
    heading("licenses, sources and bans");
    let deny = CARGO_DENY.ensure()?;
    step::command(&deny)
        .args(["check", "bans", "licenses", "sources"])
        .run()?;
    heading("advisories and yanked versions of every lock file");
    lock_files::check(&deny)?;
    heading("documentation");
    cargo(&["doc", "--workspace", "--no-deps", "--quiet"])
        .env("RUSTDOCFLAGS", "-D warnings")
        .run()?;
    let mdbook = MDBOOK.ensure()?;
    step::command(&mdbook).args(["build", "docs"]).run()?;
    // The page that docs/web.md embeds.
    build_with_workspace()?;
    step::command(std::env::current_exe()?.with_file_name("guideway"))
        .args(["share", "crates/guideway/examples/site.lif.json", "--quiet"])
        .args(["-o", "target/book/site.html", "--color-by", "maxSpeed"])
        .run()?;
    heading("each format by itself, and the library with one");
    single_formats()?;
    heading("Arrow files under AddressSanitizer");
    match SANITIZED_HOST {
        Some(host) => sanitize(host)?,
        None => println!("SKIPPED: {NO_SANITIZER}"),
    }
    windows::check()
}

/// Executes the notebook of the Python package, whose file has no outputs.
const EXECUTE_NOTEBOOK: &str = "\
import nbclient, nbformat
notebook = nbformat.read('python/examples/first_layout.ipynb', as_version=4)
nbformat.validate(notebook)
assert not any(cell.get('outputs') for cell in notebook.cells), 'clear the outputs'
nbclient.execute(notebook, cwd='python/examples')
shown = [output.get('data', {}) for cell in notebook.cells for output in cell.get('outputs', [])]
assert sum('image/png' in data for data in shown) == 3, 'the site, a picture and the widget of it'
assert sum('application/vnd.jupyter.widget-view+json' in data for data in shown) == 1, 'the widget'
";

/// Tests the Python package: its own files beside the extension module that the workspace built.
fn python_package(python: &Path) -> Result<()> {
    build_with_workspace()?;
    let built = std::env::current_exe()?;
    let built = built.parent().context("xtask has no folder")?;
    let packages = built.join("python");
    let package = packages.join("guideway");
    std::fs::create_dir_all(&package)?;
    for file in std::fs::read_dir("python/guideway")? {
        let file = file?;
        std::fs::copy(file.path(), package.join(file.file_name()))?;
    }
    let module = format!("{DLL_PREFIX}_guideway{DLL_SUFFIX}");
    let suffix = if cfg!(windows) { "pyd" } else { "abi3.so" };
    let target = package.join(format!("_guideway.{suffix}"));
    std::fs::copy(built.join(module), target)?;
    let run = |args: &[&str]| {
        let here = step::command(python).args(args);
        let here = here.env("PYTHONPATH", &packages);
        here.env("MYPYPATH", &packages).run()
    };
    run(&[
        "-m",
        "pytest",
        "-q",
        "-p",
        "no:cacheprovider",
        "python/tests",
    ])?;
    // Engines with two workers; a file that is no layout is a finding.
    let site = "crates/guideway/examples/site.lif.json";
    run(&["python/examples/ray_tiles.py", site, "0", "4", "2"])?;
    run(&["python/examples/dask_check.py", "2", site, "README.md"])?;
    // As a reader of it would; its file has no pictures, which each reader makes.
    run(&["-c", EXECUTE_NOTEBOOK])?;
    // The stubs: consistent, true to the module, and enough for the tests.
    run(&["-m", "mypy.stubtest", "guideway"])?;
    run(&[
        "-m",
        "mypy",
        "--strict",
        "--ignore-missing-imports",
        "python/tests",
    ])?;
    step::command(python)
        .args(["-m", "pyright", "--pythonpath"])
        .args([python])
        .args(["python/tests"])
        .env("PYTHONPATH", &packages)
        .run()
}

/// Checks the formats crate with each of its formats alone, and the facade with LIF alone.
fn single_formats() -> Result<()> {
    let manifest = std::fs::read_to_string("crates/guideway-formats/Cargo.toml")?;
    let all = manifest.split_once("\nall = [").map(|(_, rest)| rest);
    let all = all.and_then(|rest| rest.split_once(']'));
    let all = all.context("guideway-formats has no feature `all`")?.0;
    let alone = |package, feature| {
        let lib = ["check", "--quiet", "--lib", "--no-default-features"];
        let package = ["--package", package, "--features", feature];
        cargo(&lib).args(package).run()
    };
    for format in all.split('"').skip(1).step_by(2) {
        alone("guideway-formats", format)?;
    }
    alone("guideway", "lif")?;
    // One format is enough to open, check and draw.
    let example = ["check", "--quiet", "--example", "draw_lif"];
    let features = [
        "--package",
        "guideway",
        "--no-default-features",
        "--features",
        "lif",
    ];
    cargo(&example).args(features).run()
}

/// Writes the header of the C interface.
fn header() -> Result<()> {
    let cbindgen = CBINDGEN.ensure()?;
    step::command(&cbindgen)
        .args(["--quiet", "crates/guideway-c", "--output"])
        .args(["crates/guideway-c/include/guideway.h"])
        .run()
}

fn fuzz(args: &[String]) -> Result<()> {
    CARGO_FUZZ.ensure()?;
    build_with_workspace()?;
    let built = std::env::current_exe()?.with_file_name("examples");
    step::command(built.join("fuzz")).args(args).run()
}

const NO_SANITIZER: &str = "the sanitizer is set up for Linux on x86-64 only";
/// This host, if the sanitizer is set up for it.
const SANITIZED_HOST: Option<&str> = if cfg!(all(
    target_os = "linux",
    target_arch = "x86_64",
    target_env = "gnu"
)) {
    Some("x86_64-unknown-linux-gnu")
} else {
    None
};

/// Runs the law of reading over the seeds and mutants of Arrow files under AddressSanitizer, in a
/// target folder of its own. It watches the C code of zstd too. The other formats are safe Rust,
/// and left out of this build.
fn sanitize(host: &str) -> Result<()> {
    cargo(&["test", "--package", "guideway-laws", "--test", "arrow"])
        .args(["--no-default-features"])
        .args(["--target", host, "--target-dir", "target/sanitize"])
        // The build takes longer than the test, and shadow memory slows both down alike.
        .env("CARGO_PROFILE_DEV_OPT_LEVEL", "0")
        .env("CARGO_PROFILE_DEV_DEBUG", "false")
        // A stable compiler has the sanitizer, but takes its option only so.
        .env("RUSTC_BOOTSTRAP", "1")
        .env("RUSTFLAGS", "-Zsanitizer=address")
        .env(&format!("CFLAGS_{host}"), "-fsanitize=address")
        .run()
}

/// Runs the soak test of the window, which takes its arguments from the environment.
fn soak(args: &[String]) -> Result<()> {
    let names = [
        "GUIDEWAY_SOAK_MINUTES",
        "GUIDEWAY_SOAK_SEED",
        "GUIDEWAY_SOAK_RECORD",
    ];
    if args.len() > names.len() {
        bail!("write minutes, a seed and a file, such as `60 7 target/soak.txt`");
    }
    for (name, value) in names.into_iter().zip(args) {
        step::set_env(name, value);
    }
    let test = "tests::soak::long_soak_loses_nothing";
    let run = ["--ignored", "--exact", test, "--nocapture"];
    cargo(&["test", "-p", "guideway-viewer", "--lib", "--"])
        .args(run)
        .run()
}

/// Prints the breaches of the repository in the current folder, on which `xtask/tests` fails.
fn style(word: &str) -> Result<()> {
    let top = std::env::current_dir()?;
    let circles = workspace_circles(&top)?;
    let circles = circles
        .iter()
        .map(|(root, circle)| format!("circle in {}: {circle}", root.display()));
    let violations = check_repository(&top)?;
    let violations = violations
        .iter()
        .filter(|violation| violation.file.contains(word))
        .map(ToString::to_string);
    let circles = circles.filter(|circle| circle.contains(word));
    let found: Vec<String> = violations.chain(circles).collect();
    for line in &found {
        println!("{line}");
    }
    if !found.is_empty() {
        bail!("{} breaches", found.len());
    }
    Ok(())
}

fn quick() -> Result<()> {
    lints()?;
    tests()
}

fn lints() -> Result<()> {
    heading("format");
    cargo(&["fmt", "--all", "--check"]).run()?;
    heading("lints");
    cargo(&[
        "clippy",
        "--workspace",
        "--all-targets",
        "--quiet",
        "--",
        "-D",
        "warnings",
    ])
    .run()
}

fn tests() -> Result<()> {
    heading("tests");
    cargo(&["test", "--workspace", "--no-fail-fast"]).run()
}
