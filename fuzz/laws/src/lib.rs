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

use std::path::{Path, PathBuf};

pub use self::convert::convert;
pub use self::journal::{document, journal};
pub use self::read::read;

/// A fuzz target.
#[derive(Clone, Copy, Debug)]
pub struct Target {
    /// Name of the target, its binary and its dictionary.
    pub name: &'static str,
    /// Panics if the bytes break the law.
    pub law: fn(&[u8]),
    /// Folders of seeds, relative to the root of the repository.
    pub seeds: &'static [&'static str],
}

macro_rules! targets {
    ($($name:ident: $law:ident from $($seeds:literal)*;)*) => {
        /// All fuzz targets.
        pub const TARGETS: &[Target] = &[$(Target {
            name: stringify!($name),
            law: $law,
            seeds: &[$($seeds),*],
        },)*];
    };
}

targets! {
    arrow: read from "fuzz/seeds/arrow";
    convert: convert from
        "fuzz/seeds/arrow"
        "crates/guideway-formats/tests/bad/dxf"
        "crates/guideway-formats/tests/bad/geojson"
        "crates/guideway-formats/tests/bad/lif"
        "crates/guideway-formats/tests/bad/svg";
    dxf: read from "crates/guideway-formats/tests/bad/dxf";
    geojson: read from "crates/guideway-formats/tests/bad/geojson";
    journal: journal from "fuzz/seeds/journal";
    lanelet2: read from "crates/guideway-formats/tests/bad/lanelet2";
    lif: read from "crates/guideway-formats/tests/bad/lif";
    opendrive: read from "crates/guideway-formats/tests/bad/opendrive";
    opentcs: read from "crates/guideway-formats/tests/bad/opentcs";
    rmf: read from "crates/guideway-formats/tests/bad/rmf";
    svg: read from "crates/guideway-formats/tests/bad/svg";
    vda5050: read from "crates/guideway-formats/tests/bad/vda5050";
}

impl Target {
    /// Paths of the folders of seeds.
    pub fn seed_folders(&self) -> impl Iterator<Item = PathBuf> {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
        self.seeds.iter().map(move |folder| root.join(folder))
    }
}
