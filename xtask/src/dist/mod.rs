//! The parts of `cargo xtask dist`: release builds to packages that install, with checksums and a
//! bill of materials.
//!
//! | module | purpose |
//! |---|---|
//! | `build` | the programs, and how cargo builds them without paths of this machine |
//! | `dependencies` | the crates in them, from `cargo metadata` |
//! | `library` | the files of the C library, below a folder |
//! | `licenses` | the license texts of these crates |
//! | `sbom` | the crates as a CycloneDX bill of materials |
//! | `tree` | the files of an installation, below a folder |
//! | `package` | a `.deb` and a `.tar.xz` of that tree, and the checksums |
//! | `windows` | the folder, the zip and the installer for Windows |

mod build;
mod dependencies;
mod library;
mod licenses;
mod package;
mod sbom;
mod tree;
mod windows;

pub use build::{
    Binaries, COMMAND, PROFILE, STATIC_COMMAND, UNWINDING_PROFILE, WINDOW, ZSTD_FLAGS,
    remapped_paths,
};
pub use dependencies::{Dependency, dependencies};
pub use library::{Library, stage_library};
pub use licenses::notices;
pub use package::{Compression, Package, archive, checksums, deb};
pub use sbom::sbom;
pub use tree::{stage, stage_command, stage_notices};
pub use windows::{WINDOWS, installer, stage_windows, zip};
