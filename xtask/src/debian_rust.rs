//! The compiler for other systems: Debian's `rustc-web`, unpacked under `target/` and not
//! installed. It comes with the sources of the standard library, which cargo builds for each.

use std::path::{Path, PathBuf};

use anyhow::{Result, bail};

use crate::prerequisites::apt;
use crate::step::{Step, command};

/// The folder of the unpacked packages.
const FOLDER: &str = "target/debian-rust";
/// Packages whose names have no version; those that they need have one.
const PACKAGES: [&str; 3] = ["rustc-web", "rust-web-src", "libstd-rust-web-dev"];
/// Beginnings of the names of packages that they need.
const NEEDED: [&str; 2] = ["libllvm", "libstd-rust-web-"];

/// The unpacked compiler.
pub(crate) struct DebianRust(PathBuf);

impl DebianRust {
    /// Returns `true` if this system has the packages.
    pub(crate) fn is_known() -> bool {
        let is_listed = || command("apt-cache").args(["show", PACKAGES[0]]).succeeds();
        is_listed() || (apt(&["update", "-q"]).is_ok() && is_listed())
    }

    /// Fetches and unpacks the packages where that was not done before.
    pub(crate) fn ensure() -> Result<Self> {
        let rust = Self(std::env::current_dir()?.join(FOLDER));
        if rust.step(rust.rustc()).args(["--version"]).succeeds() {
            return Ok(rust);
        }
        let packages = rust.0.with_extension("packages");
        std::fs::create_dir_all(&packages)?;
        apt(&["update", "-q"])?;
        let mut names: Vec<String> = PACKAGES.map(str::to_owned).to_vec();
        let mut known = 0;
        // Each round adds the packages that those of the last one need.
        while known < names.len() {
            known = names.len();
            let depends = command("apt-cache").args(["depends"]).args(&names);
            let depends = depends.capture()?.stdout;
            let needed = depends
                .lines()
                .filter_map(|line| line.trim().strip_prefix("Depends: "));
            let needed = needed.filter(|name| NEEDED.iter().any(|start| name.starts_with(start)));
            names.extend(needed.map(str::to_owned));
            names.sort();
            names.dedup();
        }
        let download = command("apt-get").args(["download"]).args(&names);
        download.current_dir(&packages).run()?;
        // The folder gets its name when it is whole.
        let unpacked = rust.0.with_extension("unpacked");
        for package in std::fs::read_dir(&packages)? {
            let package = package?.path();
            command("dpkg")
                .args(["-x".as_ref(), package.as_os_str(), unpacked.as_os_str()])
                .run()?;
        }
        if rust.0.exists() {
            std::fs::remove_dir_all(&rust.0)?;
        }
        std::fs::rename(unpacked, &rust.0)?;
        std::fs::remove_dir_all(&packages)?;
        Ok(rust)
    }

    /// A step of cargo's that builds with this compiler.
    pub(crate) fn cargo(&self, args: &[&str]) -> Step {
        self.step(env!("CARGO").into())
            .args(args)
            .env("RUSTC", self.rustc())
            // A stable compiler builds its standard library, but takes the option only so.
            .env("RUSTC_BOOTSTRAP", "1")
    }

    /// Flags by which messages of panics name files without the folders of this machine.
    pub(crate) fn remapped_paths(&self) -> Result<String> {
        let remapped = xtask::dist::remapped_paths(&std::env::current_dir()?)?;
        Ok(format!(
            "{remapped} --remap-path-prefix={}=/rust",
            self.0.display()
        ))
    }

    fn rustc(&self) -> PathBuf {
        self.0.join("usr/bin/rustc")
    }

    fn step(&self, program: PathBuf) -> Step {
        command(program).env("LD_LIBRARY_PATH", self.0.join("usr/lib/x86_64-linux-gnu"))
    }
}

/// The linker of rustup's own compiler: Debian's package has none.
///
/// # Errors
/// When rustup did not install Rust.
pub(crate) fn linker() -> Result<PathBuf> {
    let sysroot = command("rustc").args(["--print", "sysroot"]).capture()?;
    let linker =
        Path::new(sysroot.stdout.trim()).join("lib/rustlib/x86_64-unknown-linux-gnu/bin/rust-lld");
    match linker.exists() {
        true => Ok(linker),
        false => bail!("no {}: install Rust with rustup", linker.display()),
    }
}

/// The folder in which a C compiler finds it by the name `ld.lld`.
///
/// # Errors
/// See [`linker`].
pub(crate) fn lld_folder() -> Result<PathBuf> {
    Ok(linker()?.with_file_name("gcc-ld"))
}
