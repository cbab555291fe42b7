//! `cargo xtask windows`: builds the programs for Windows, packs them, and tests them under Wine.
//!
//! | module | input | output |
//! |---|---|---|
//! | `build` | the sources | `guideway.exe`, `guideway-window.exe`, which need Windows alone |
//! | `packages` | these programs | a zip and an installer |
//! | `wine` | Debian's packages | a Windows of its own below `target/` |
//! | `commands` | the command of either system | their differences: files, answers, exit codes |
//! | `screen` | a program | a virtual screen with its window, keys, and a picture |
//! | `installed` | the installer | faults of an installation, of its window and its removal |

mod build;
mod commands;
mod installed;
mod packages;
mod screen;
mod wine;

use anyhow::{Result, bail};

use crate::debian_rust::DebianRust;
use crate::prerequisites;
use crate::step::{build_with_workspace, heading};
use build::Profile;
use screen::Screen;
use wine::Wine;

/// Builds the programs; with `--test` also packs and tests them, with `--quick` less optimized.
pub(crate) fn run(args: &[String]) -> Result<()> {
    let has = |name: &str| args.iter().any(|arg| arg == name);
    if let Some(other) = args
        .iter()
        .find(|arg| *arg != "--test" && *arg != "--quick")
    {
        bail!("`{other}`: write `windows`, with `--test`, `--quick` or both");
    }
    let profile = match has("--quick") {
        true => Profile::Quick,
        false => Profile::Release,
    };
    if has("--test") {
        return test(profile);
    }
    let binaries = build::programs(profile)?;
    println!("\n{}", binaries.command.display());
    println!("{}", binaries.window.display());
    Ok(())
}

/// Builds the programs with little optimization and tests them, where Debian's compiler is.
pub(crate) fn check() -> Result<()> {
    match DebianRust::is_known() {
        true => test(Profile::Quick),
        false => {
            println!("SKIPPED: the compiler for Windows is a package of Debian, rustc-web");
            Ok(())
        }
    }
}

/// Builds a release for Windows, and packs it beside the other packages.
pub(crate) fn dist() -> Result<()> {
    let binaries = build::programs(Profile::Release)?;
    heading("packages for Windows");
    let packages = packages::pack(&binaries, Profile::Release)?;
    packages.list()
}

/// Packs the programs, compares them with those of this system, and installs and removes them.
fn test(profile: Profile) -> Result<()> {
    let binaries = build::programs(profile)?;
    heading("packages for Windows");
    let packages = packages::pack(&binaries, profile)?;
    heading("the command of this system");
    prerequisites::debian_packages()?;
    build_with_workspace()?;
    heading("Wine");
    let screen = Screen::start()?;
    let wine = Wine::ensure(&screen)?;
    heading("the command under Wine");
    let compared = commands::test(&wine, &packages.stage);
    heading("the installer and the window under Wine");
    installed::test(&wine, &screen, &packages)?;
    compared
}
