//! Runs every law over its seeds and 500 mutants of them, on any compiler and equal in every run.

#![allow(clippy::unwrap_used, reason = "a test may fail by a panic")]

mod mutate;

use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::thread;

use guideway_laws::{TARGETS, Target, journal};
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

#[test]
fn laws_hold_for_seeds_and_mutants() {
    let broken = thread::scope(|scope| {
        let run = |target: &'static Target| {
            move || {
                let seeds = seeds(target);
                assert!(!seeds.is_empty(), "{} has no seeds", target.name);
                let bytes = counterexample(target.law, &seeds)?;
                let file = Path::new(env!("CARGO_TARGET_TMPDIR")).join(target.name);
                fs::write(&file, bytes).unwrap();
                Some(format!(
                    "{}: {} breaks the law",
                    target.name,
                    file.display()
                ))
            }
        };
        let threads: Vec<_> = TARGETS.iter().map(|t| scope.spawn(run(t))).collect();
        let results = threads.into_iter().map(|thread| thread.join().unwrap());
        results.flatten().collect::<Vec<String>>()
    });
    assert!(broken.is_empty(), "{}", broken.join("\n"));
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
    let target = TARGETS.iter().find(|t| t.name == "journal").unwrap();
    for bytes in seeds(target) {
        journal(&bytes);
        let mut document = guideway_laws::document();
        assert_eq!(
            guideway_document::replay(&bytes, &mut document, |_| true).bytes,
            bytes.len()
        );
    }
}
