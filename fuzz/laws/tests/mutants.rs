//! Runs every law over its seeds and 500 mutants of them, on any compiler and equal in every run.

#![allow(clippy::unwrap_used, reason = "a test may fail by a panic")]

mod mutate;

use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;

use guideway_laws::{TARGETS, Target};
use mutate::Mutator;

const MUTANTS: usize = 500;

fn seeds(target: &Target) -> Vec<Vec<u8>> {
    let seeds = target.seeds().unwrap();
    seeds.into_iter().map(|(_, bytes)| bytes).collect()
}

/// The first bytes that break a law, if any.
fn counterexample(law: fn(&[u8]), seeds: &[Vec<u8>]) -> Option<Vec<u8>> {
    let mut mutator = Mutator::new(seeds);
    let mutants = (0..MUTANTS).map(|_| mutator.mutant());
    let mut all = seeds.iter().cloned().chain(mutants);
    all.find(|bytes| catch_unwind(AssertUnwindSafe(|| law(bytes))).is_err())
}

fn target(name: &str) -> &'static Target {
    let target = TARGETS.iter().find(|target| target.name == name);
    target.unwrap_or_else(|| panic!("no target {name}"))
}

fn assert_law_holds(name: &str) {
    let target = target(name);
    let seeds = seeds(target);
    assert!(!seeds.is_empty(), "{name} has no seeds");
    if let Some(bytes) = counterexample(target.law, &seeds) {
        let file = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
        fs::write(&file, bytes).unwrap();
        panic!("{} breaks the law", file.display());
    }
}

/// A test per target, so that one of them can run by itself.
macro_rules! laws_hold_for_seeds_and_mutants {
    ($($name:ident),*) => {
        $(#[test]
        fn $name() {
            assert_law_holds(stringify!($name));
        })*

        #[test]
        fn every_target_has_a_test() {
            let tested = [$(stringify!($name)),*];
            assert!(TARGETS.iter().map(|target| target.name).eq(tested));
        }
    };
}

laws_hold_for_seeds_and_mutants! {
    arrow, convert, dxf, geojson, journal, lanelet2, lif, opendrive, opentcs, rmf, svg, vda5050
}

#[test]
fn finds_a_counterexample() {
    let seeds = [b"[1, 2, 3]".to_vec(), b"{\"x\": 4}".to_vec()];
    let law = |bytes: &[u8]| assert!(!bytes.starts_with(b"[") || bytes.contains(&b'2'));
    assert!(counterexample(law, &seeds).is_some());
    assert!(counterexample(|_| {}, &seeds).is_none());
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
