//! Project chores. `cargo xtask test` installs what it needs and runs every check there is.

mod prerequisites;
mod step;

use std::process::ExitCode;
use std::sync::LazyLock;

use anyhow::{Result, bail};

use step::{STARTED, cargo, elapsed_s, heading};

const HELP: &str = "\
cargo xtask test        everything: format, lints, all tests, docs, licenses (what CI runs)
cargo xtask quick       format, lints and tests, without installing anything
cargo xtask fuzz [MINUTES [TARGET...]]
                        each fuzz target for so long (1 unless said)
cargo xtask soak [MINUTES [SEED [FILE]]]
                        the viewer under hands that do anything for so long (1 unless said); writes a record
";

fn main() -> ExitCode {
    LazyLock::force(&STARTED);
    let args: Vec<String> = std::env::args().skip(1).collect();
    let task = args.first().map_or("", String::as_str);
    let outcome = match (task, &args.get(1..).unwrap_or_default()) {
        ("test", []) => test(),
        ("quick", []) => quick(),
        ("fuzz", rest) => fuzz(rest),
        ("soak", rest) => soak(rest),
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
    heading("what is needed");
    prerequisites::rust_components()?;
    let deny = prerequisites::cargo_deny()?;
    let python = prerequisites::python()?;
    step::set_env("GUIDEWAY_PYTHON", &python);
    prerequisites::software_devices()?;
    step::set_env("GUIDEWAY_REQUIRE_DEVICES", "1");
    quick()?;
    heading("documentation");
    cargo(&["doc", "--workspace", "--no-deps", "--quiet"])
        .env("RUSTDOCFLAGS", "-D warnings")
        .run()?;
    heading("licenses, sources and bans");
    step::command(&deny)
        .args(["check", "bans", "licenses", "sources"])
        .run()?;
    heading("advisories");
    let advisories = step::command(&deny)
        .args(["check", "advisories"])
        .capture()?;
    if !advisories.succeeded {
        // Without a network there is no advisory database to ask: that must be seen, and is no fault.
        if advisories
            .stderr
            .contains("failed to fetch advisory database")
        {
            println!("NOT CHECKED: the advisory database cannot be reached from this machine");
        } else {
            bail!("cargo deny found an advisory:\n{}", advisories.stderr);
        }
    }
    heading("fuzzing");
    // Twenty seconds each.
    fuzz(&["0.33".to_owned()])
}

fn fuzz(args: &[String]) -> Result<()> {
    prerequisites::cargo_fuzz()?;
    // As it is built for the tests: by itself, what it depends on has other features and is built once more.
    cargo(&["build", "--quiet", "--workspace", "--example", "fuzz"]).run()?;
    let built = std::env::current_exe()?.with_file_name("examples");
    step::command(built.join("fuzz")).args(args).run()
}

/// What is asked goes to the test that does it by its environment.
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

fn quick() -> Result<()> {
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
    .run()?;
    heading("tests");
    cargo(&["test", "--workspace", "--no-fail-fast"]).run()
}
