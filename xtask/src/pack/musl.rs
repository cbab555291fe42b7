//! Builds the command as one file that needs no library: by musl, and without the methods on
//! graphics devices, whose drivers are libraries.

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};
use xtask::dist::{PROFILE, STATIC_COMMAND};

use super::build::{for_size, without_unwinding};
use crate::debian_rust::DebianRust;
use crate::prerequisites::apt_install;
use crate::step::command;

const TARGET: &str = "x86_64-unknown-linux-musl";

/// Rust walks up a stack by a library of the C compiler, which asks glibc for the tables of a place
/// in the program. The command has no such tables.
const NO_TABLES: &str = "\
int _dl_find_object(void *place, void *found) {
    (void)place;
    (void)found;
    return -1;
}
";

/// Builds it with the tools of Debian's `musl-tools`, which are installed where they are missing.
///
/// # Errors
/// When the file would need a library.
pub(super) fn static_command(top: &Path) -> Result<PathBuf> {
    if !command("musl-gcc").args(["--version"]).succeeds() {
        apt_install(&["musl-tools"])?;
    }
    let libraries = top.join("target/dist/musl");
    write_unwinder(&libraries)?;
    let mut flags = vec![
        format!("-Lnative={}", libraries.display()),
        "-Clinker=musl-gcc".to_owned(),
        // musl-gcc brings the start of a program, and Debian's compiler has none.
        "-Clink-self-contained=no".to_owned(),
        "-Crelocation-model=static".to_owned(),
        // musl-gcc names a loader in every program, and this linker keeps it.
        "-Clink-arg=-Wl,--no-dynamic-linker".to_owned(),
    ];
    flags.extend(without_unwinding(top));
    let rust = DebianRust::ensure()?;
    let built = for_size(top, &rust, &STATIC_COMMAND, TARGET, PROFILE, &flags)?.command;
    let headers = command("readelf").args(["--program-headers".as_ref(), built.as_os_str()]);
    if needs_libraries(&headers.capture()?.stdout)? {
        bail!("{} needs a library", built.display());
    }
    Ok(built)
}

/// The license of musl, which is a part of the file.
pub(super) fn license() -> Result<String> {
    let file = "/usr/share/doc/musl-dev/copyright";
    fs::read_to_string(file).with_context(|| format!("cannot read {file}"))
}

/// Writes `libunwind.a`, the library of the C compiler with [`NO_TABLES`].
fn write_unwinder(folder: &Path) -> Result<()> {
    fs::create_dir_all(folder)?;
    let gcc = |args: &[&str]| command("musl-gcc").args(args).current_dir(folder);
    let original = gcc(&["-print-file-name=libgcc_eh.a"]).capture()?.stdout;
    let original = original.trim();
    fs::copy(original, folder.join("libunwind.a"))
        .with_context(|| format!("cannot copy {original}"))?;
    fs::write(folder.join("no_tables.c"), NO_TABLES)?;
    gcc(&["-O2", "-c", "no_tables.c"]).run()?;
    let archive = command("ar").args(["r", "libunwind.a", "no_tables.o"]);
    archive.current_dir(folder).run()
}

/// Tells if a program loads others, by what `readelf --program-headers` prints of it.
fn needs_libraries(headers: &str) -> Result<bool> {
    let mut kinds = headers
        .lines()
        .filter_map(|line| line.split_whitespace().next());
    if !kinds.clone().any(|kind| kind == "LOAD") {
        bail!("no part of the program is loaded: it is none of Linux");
    }
    Ok(kinds.any(|kind| ["INTERP", "DYNAMIC"].contains(&kind)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_program_that_names_a_loader_needs_libraries() {
        let fixed = "  Type  Offset\n  LOAD  0x0\n  GNU_STACK  0x0\n";
        assert!(!needs_libraries(fixed).unwrap());
        let dynamic = format!("{fixed}  INTERP  0x238\n  DYNAMIC  0x2d8\n");
        assert!(needs_libraries(&dynamic).unwrap());
        assert!(needs_libraries("readelf: Error: Not an ELF file\n").is_err());
    }
}
