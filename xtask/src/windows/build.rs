//! Cross-compiles command and window by MinGW-w64, with a standard library built for it.

use anyhow::{Result, bail};
use xtask::dist::{Binaries, COMMAND, PROFILE, UNWINDING_PROFILE, WINDOW, WINDOWS, ZSTD_FLAGS};

use crate::debian_rust::DebianRust;
use crate::prerequisites::apt_install;
use crate::step::{command, heading};

/// The folder of everything for Windows.
pub(super) const FOLDER: &str = "target/windows";

/// Libraries of MinGW-w64, which a computer with Windows has not.
const FOREIGN: [&str; 3] = ["libgcc", "libwinpthread", "libstdc++"];

/// A profile of cargo's.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Profile {
    /// For users.
    Release,
    /// For tests: the same pictures, in a third of the time to build.
    Quick,
}

/// Arguments of cargo, its profile, and the crates of the standard library.
type Build = (&'static [&'static str], &'static str, &'static str);

/// Both programs at once. The pictures of these tests are small: to optimize what draws them takes
/// longer than it saves.
const QUICK: [&str; 10] = [
    "build",
    "--package=guideway",
    "--package=guideway-window",
    "--features=guideway/gpu,guideway/gl",
    "--profile=quick",
    "--config=profile.quick.package.guideway-compose.opt-level=0",
    "--config=profile.quick.package.guideway-cpu.opt-level=0",
    "--config=profile.quick.package.guideway-envelope.opt-level=0",
    "--config=profile.quick.package.guideway-layout.opt-level=0",
    "--config=profile.quick.package.guideway-scene.opt-level=0",
];

impl Profile {
    /// The builds of the command and of the window.
    fn builds(self) -> [Build; 2] {
        let quick: Build = (&QUICK, "quick", "-Zbuild-std=std,panic_unwind");
        match self {
            Self::Release => [
                (&COMMAND, PROFILE, "-Zbuild-std=std,panic_abort"),
                (&WINDOW, UNWINDING_PROFILE, "-Zbuild-std=std,panic_unwind"),
            ],
            Self::Quick => [quick, quick],
        }
    }
}

/// Builds command and window, and checks that they need no library of MinGW-w64.
pub(super) fn programs(profile: Profile) -> Result<Binaries> {
    heading("tools for Windows");
    let rust = DebianRust::ensure()?;
    let tool = |name: &str| format!("x86_64-w64-mingw32-{name}");
    if !command(tool("gcc")).args(["--version"]).succeeds() {
        apt_install(&["gcc-mingw-w64-x86-64"])?;
    }
    heading("programs for Windows");
    let cargo = std::env::current_dir()?.join(FOLDER).join("cargo");
    let build = |(task, profile, std): Build| {
        let (task, rest) = task.split_at(1);
        rust.cargo(task)
            .args(["--locked", "--target", WINDOWS, std])
            .args(rest)
            .env("CARGO_TARGET_DIR", &cargo)
            .env("CARGO_TARGET_X86_64_PC_WINDOWS_GNU_LINKER", tool("gcc"))
            .env("CC_x86_64_pc_windows_gnu", tool("gcc"))
            .env("AR_x86_64_pc_windows_gnu", tool("ar"))
            .env("CFLAGS_x86_64_pc_windows_gnu", ZSTD_FLAGS)
            .env("RUSTFLAGS", rust.remapped_paths()?)
            .run()?;
        let folder = cargo.join(WINDOWS).join(profile);
        anyhow::Ok(Binaries::with_suffix(&folder, ".exe"))
    };
    let [command_build, window_build] = profile.builds();
    let binaries = Binaries {
        command: build(command_build)?.command,
        window: build(window_build)?.window,
    };
    for program in [&binaries.command, &binaries.window] {
        let headers = command(tool("objdump")).args(["-p".as_ref(), program.as_os_str()]);
        let headers = headers.capture()?.stdout;
        let foreign = foreign_libraries(&headers)?;
        if !foreign.is_empty() {
            bail!("{} needs {}", program.display(), foreign.join(", "));
        }
    }
    Ok(binaries)
}

/// The libraries of MinGW-w64 that a program loads, by what `objdump -p` prints of it.
fn foreign_libraries(headers: &str) -> Result<Vec<&str>> {
    let named = headers.lines().map(str::trim);
    let named: Vec<&str> = named
        .filter_map(|line| line.strip_prefix("DLL Name: "))
        .collect();
    if named.is_empty() {
        bail!("the program names no library: it is none of Windows");
    }
    let is_foreign = |name: &&str| FOREIGN.iter().any(|start| name.starts_with(start));
    Ok(named.into_iter().filter(is_foreign).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_library_of_the_compiler_is_found() {
        let printed = "\tDLL Name: KERNEL32.dll\n\tvma:  Hint\n\tDLL Name: libgcc_s_seh-1.dll\n";
        assert_eq!(foreign_libraries(printed).unwrap(), ["libgcc_s_seh-1.dll"]);
        let own = foreign_libraries("\tDLL Name: ntdll.dll\n").unwrap();
        assert!(own.is_empty(), "{own:?}");
        assert!(foreign_libraries("file format elf64-x86-64").is_err());
    }
}
