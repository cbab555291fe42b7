//! Runs every other law over its seeds and 500 mutants, on any compiler and equal in every run.

#![cfg(feature = "all")]
#![allow(clippy::unwrap_used, reason = "a test may fail by a panic")]

mod mutate;

use guideway_laws::{TARGETS, Target};
use mutate::assert_law_holds;

fn target(name: &str) -> &'static Target {
    let target = TARGETS.iter().find(|target| target.name == name);
    target.unwrap_or_else(|| panic!("no target {name}"))
}

/// A test per target, so that one of them can run by itself.
macro_rules! laws_hold_for_seeds_and_mutants {
    ($($name:ident),*) => {
        $(#[test]
        fn $name() {
            assert_law_holds(target(stringify!($name)));
        })*

        #[test]
        fn every_target_has_a_test() {
            // That of Arrow is built by itself for a sanitizer.
            let tested = ["arrow", $(stringify!($name)),*];
            assert!(TARGETS.iter().map(|target| target.name).eq(tested));
        }
    };
}

laws_hold_for_seeds_and_mutants! {
    convert, dxf, geojson, journal, lanelet2, lif, opendrive, opentcs, rmf, svg, vda5050
}

/// Replays every seed to its end, which fails for seeds of another version of the journal.
#[test]
fn seed_journals_match_the_current_version() {
    let seeds = target("journal").seeds().unwrap().into_iter();
    for (_, bytes) in seeds.filter(|(name, _)| !name.contains("kept-")) {
        guideway_laws::journal(&bytes);
        let mut document = guideway_laws::document();
        assert_eq!(
            guideway_document::replay(&bytes, &mut document, |_| true).bytes,
            bytes.len()
        );
    }
}
