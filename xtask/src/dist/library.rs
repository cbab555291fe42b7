//! The files of the C library below a folder: `include` and `lib`.

use std::env::consts::{DLL_PREFIX, DLL_SUFFIX};
use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};

/// The C library as cargo builds it.
#[derive(Clone, Debug)]
pub struct Library {
    /// For programs that load it when they start.
    pub shared: PathBuf,
    /// For programs that hold it; tests have none.
    pub archive: Option<PathBuf>,
}

impl Library {
    /// The library in a folder of cargo's.
    pub fn in_folder(folder: &Path) -> Self {
        let archive = folder.join("libguideway_c.a");
        Self {
            shared: folder.join(format!("{DLL_PREFIX}guideway_c{DLL_SUFFIX}")),
            archive: archive.exists().then_some(archive),
        }
    }
}

/// Writes the files of a C library of Linux below `prefix`, which may be moved later.
///
/// # Errors
/// When a file cannot be read or written.
pub fn stage_library(top: &Path, version: &str, library: &Library, prefix: &Path) -> Result<()> {
    let (include, lib) = (prefix.join("include"), prefix.join("lib"));
    let pkgconfig = lib.join("pkgconfig");
    for folder in [&include, &pkgconfig] {
        fs::create_dir_all(folder)?;
    }
    let copy = |from: &Path, to: PathBuf| {
        fs::copy(from, to).with_context(|| format!("{}: build it first", from.display()))
    };
    copy(
        &top.join("crates/guideway-c/include/guideway.h"),
        include.join("guideway.h"),
    )?;
    let named = format!("libguideway.so.{version}");
    copy(&library.shared, lib.join(&named))?;
    if let Some(archive) = &library.archive {
        copy(archive, lib.join("libguideway.a"))?;
    }
    // The first is the name that programs ask for, the second that of the linker.
    for link in ["libguideway.so.0", "libguideway.so"] {
        #[cfg(unix)]
        std::os::unix::fs::symlink(&named, lib.join(link))?;
        #[cfg(not(unix))]
        copy(&library.shared, lib.join(link))?;
    }
    let about = fs::read_to_string(top.join("packaging/guideway.pc"))?;
    let about = about.replace("@VERSION@", version);
    fs::write(pkgconfig.join("guideway.pc"), about)?;
    Ok(())
}
