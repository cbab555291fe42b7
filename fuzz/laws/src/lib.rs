//! Laws: functions that panic if any bytes make Guideway misbehave. They are the bodies of the fuzz
//! targets in the parent folder.
//!
//! | law | input | holds |
//! |---|---|---|
//! | [`read`] | a file of any format | readers return a drawable layout or an error with a remedy |
//! | [`convert`] | a file of any format | written files read back with the same bounds |
//! | [`journal`] | a journal of edits | the document stays valid and every edit can be undone |
//!
//! A test runs the laws over all seeds and over the same mutants in every run.

#[cfg(feature = "all")]
mod convert;
#[cfg(feature = "all")]
mod journal;
mod read;

use std::io::Result;
use std::path::{Path, PathBuf};

#[cfg(feature = "all")]
pub use self::convert::convert;
#[cfg(feature = "all")]
pub use self::journal::{document, journal};
pub use self::read::read;
use Seeds::{Bad, Stored};
use guideway_bad_files::Archive;

/// A fuzz target.
#[derive(Clone, Copy, Debug)]
pub struct Target {
    /// Name of the target, its binary and its dictionary.
    pub name: &'static str,
    /// Panics if the bytes break the law.
    pub law: fn(&[u8]),
    /// Sources of its seeds.
    pub seeds: &'static [Seeds],
}

/// A source of seeds.
#[derive(Clone, Copy, Debug)]
pub enum Seeds {
    /// The bad files of a format.
    Bad(&'static str),
    /// The files of an archive of `fuzz/seeds`.
    Stored(&'static str),
}

macro_rules! targets {
    ($($name:ident: $law:ident from $($seeds:expr),*;)*) => {
        /// All fuzz targets.
        #[cfg(feature = "all")]
        pub const TARGETS: &[Target] = &[ARROW, $(Target {
            name: stringify!($name),
            law: $law,
            seeds: &[$($seeds),*],
        },)*];
    };
}

/// The target of Arrow, whose decoders have code in C.
pub const ARROW: Target = Target {
    name: "arrow",
    law: read,
    seeds: &[Bad("arrow"), Stored("arrow")],
};

targets! {
    convert: convert from Bad("dxf"), Bad("geojson"), Bad("lif"), Bad("svg"), Stored("arrow");
    dxf: read from Bad("dxf"), Stored("dxf");
    geojson: read from Bad("geojson"), Stored("geojson");
    journal: journal from Stored("journal");
    lanelet2: read from Bad("lanelet2"), Stored("lanelet2");
    lif: read from Bad("lif"), Stored("lif");
    opendrive: read from Bad("opendrive"), Stored("opendrive");
    opentcs: read from Bad("opentcs"), Stored("opentcs");
    rmf: read from Bad("rmf"), Stored("rmf");
    svg: read from Bad("svg"), Stored("svg");
    vda5050: read from Bad("vda5050"), Stored("vda5050");
}

impl Target {
    /// Names and bytes of all seeds, in the same order in every run.
    ///
    /// # Errors
    /// When an archive of bad files or a folder of seeds cannot be read.
    pub fn seeds(&self) -> Result<Vec<(String, Vec<u8>)>> {
        let mut all = Vec::new();
        for seeds in self.seeds {
            all.extend(seeds.read()?);
        }
        Ok(all)
    }
}

impl Seeds {
    /// Names and bytes, sorted by name.
    fn read(self) -> Result<Vec<(String, Vec<u8>)>> {
        let (source, archive) = match self {
            Bad(format) => (format, guideway_bad_files::inputs(format)?),
            Stored(target) => (target, Archive::read(&archive_path(target))?),
        };
        let files = archive.iter();
        Ok(files
            .map(|(name, bytes)| (format!("{source}-{name}"), bytes.to_vec()))
            .collect())
    }
}

/// The archive of the seeds of a target.
pub fn archive_path(target: &str) -> PathBuf {
    let seeds = Path::new(env!("CARGO_MANIFEST_DIR")).join("../seeds");
    seeds.join(format!("{target}.txt"))
}
