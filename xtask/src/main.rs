//! Project chores. `cargo xtask test` installs what it needs and runs every check there is.

mod prerequisites;
mod step;

use std::process::ExitCode;
use std::time::Instant;

use anyhow::{Result, bail};

use step::{cargo, heading};

const HELP: &str = "\
cargo xtask test        everything: format, lints, all tests, docs, licences (what CI runs)
cargo xtask quick       format, lints and tests, without installing anything
";

fn main() -> ExitCode {
    let started = Instant::now();
    let task = std::env::args().nth(1).unwrap_or_default();
    let outcome = match task.as_str() {
        "test" => test(),
        "quick" => quick(),
        _ => {
            print!("{HELP}");
            return ExitCode::from(2);
        }
    };
    match outcome {
        Ok(()) => {
            println!(
                "\nall checks passed in {:.0} s",
                started.elapsed().as_secs_f64()
            );
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
    let python = prerequisites::python_with_pyarrow()?;
    step::set_env("GUIDEWAY_PYTHON", &python);
    prerequisites::software_devices()?;
    step::set_env("GUIDEWAY_REQUIRE_DEVICES", "1");
    quick()?;
    heading("documentation");
    cargo(&["doc", "--workspace", "--no-deps", "--quiet"])
        .env("RUSTDOCFLAGS", "-D warnings")
        .run()?;
    heading("licences, sources and bans");
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
    Ok(())
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
