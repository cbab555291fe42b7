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

mod convert;
mod journal;
mod read;

use std::fs;
use std::io::Result;
use std::path::Path;

pub use self::convert::convert;
pub use self::journal::{document, journal};
pub use self::read::read;
use Seeds::{Bad, Stored};

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
    /// The files of a folder of `fuzz/seeds`.
    Stored(&'static str),
}

macro_rules! targets {
    ($($name:ident: $law:ident from $($seeds:expr),*;)*) => {
        /// All fuzz targets.
        pub const TARGETS: &[Target] = &[$(Target {
            name: stringify!($name),
            law: $law,
            seeds: &[$($seeds),*],
        },)*];
    };
}

targets! {
    arrow: read from Stored("arrow");
    convert: convert from Bad("dxf"), Bad("geojson"), Bad("lif"), Bad("svg"), Stored("arrow");
    dxf: read from Bad("dxf");
    geojson: read from Bad("geojson");
    journal: journal from Stored("journal");
    lanelet2: read from Bad("lanelet2");
    lif: read from Bad("lif");
    opendrive: read from Bad("opendrive");
    opentcs: read from Bad("opentcs");
    rmf: read from Bad("rmf");
    svg: read from Bad("svg");
    vda5050: read from Bad("vda5050");
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
        match self {
            Bad(format) => {
                let archive = guideway_bad_files::inputs(format)?;
                let files = archive.iter();
                Ok(files
                    .map(|(name, bytes)| (format!("{format}-{name}"), bytes.to_vec()))
                    .collect())
            }
            Stored(folder) => {
                let seeds = Path::new(env!("CARGO_MANIFEST_DIR")).join("../seeds");
                let mut all = Vec::new();
                for entry in fs::read_dir(seeds.join(folder))? {
                    let entry = entry?;
                    let name = entry.file_name();
                    let bytes = fs::read(entry.path())?;
                    all.push((format!("{folder}-{}", name.display()), bytes));
                }
                all.sort();
                Ok(all)
            }
        }
    }
}
