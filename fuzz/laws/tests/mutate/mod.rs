//! [`Mutator`]: derives mutants from seeds, equal in every run; and the check of a law over them.

use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;

use guideway_laws::Target;
use rand_core::Rng;
use rand_pcg::Pcg64Mcg;

const MUTANTS: usize = 500;

/// Tokens that often expose defects of readers.
const ODD: [&[u8]; 16] = [
    b"",
    b"0",
    b"-1",
    b"1e999",
    b"-0.0",
    b"NaN",
    b"1e-320",
    b"4294967296",
    b"9223372036854775808",
    b"null",
    b"[]",
    b"{}",
    b"\"",
    b"\n",
    b"\0\0\0\0",
    b"\xFF\xFF\xFF\xFF",
];

/// The first bytes that break a law, if any.
pub(crate) fn counterexample(law: fn(&[u8]), seeds: &[Vec<u8>]) -> Option<Vec<u8>> {
    let mut mutator = Mutator::new(seeds);
    let mutants = (0..MUTANTS).map(|_| mutator.mutant());
    let mut all = seeds.iter().cloned().chain(mutants);
    all.find(|bytes| catch_unwind(AssertUnwindSafe(|| law(bytes))).is_err())
}

/// Checks the law of a target over its seeds and mutants of them.
pub(crate) fn assert_law_holds(target: &Target) {
    let (name, seeds) = (target.name, target.seeds().unwrap());
    let seeds: Vec<Vec<u8>> = seeds.into_iter().map(|(_, bytes)| bytes).collect();
    assert!(!seeds.is_empty(), "{name} has no seeds");
    if let Some(bytes) = counterexample(target.law, &seeds) {
        let file = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
        fs::write(&file, bytes).unwrap();
        panic!("{} breaks the law", file.display());
    }
}

/// Derives mutants from seeds by random changes with a fixed start value.
struct Mutator<'a> {
    seeds: &'a [Vec<u8>],
    random: Pcg64Mcg,
}

impl<'a> Mutator<'a> {
    fn new(seeds: &'a [Vec<u8>]) -> Self {
        Self {
            seeds,
            random: Pcg64Mcg::new(0x6775_6964_6577_6179),
        }
    }

    /// A seed after one to four changes.
    fn mutant(&mut self) -> Vec<u8> {
        let mut bytes = self.seed().to_vec();
        for _ in 0..=self.below(4) {
            self.change(&mut bytes);
        }
        bytes
    }

    fn change(&mut self, bytes: &mut Vec<u8>) {
        let (start, len) = self.range(bytes.len());
        let part = start..start + len;
        match self.below(6) {
            0 => drop(bytes.drain(part)),
            1 => {
                let again = bytes[part].to_vec();
                bytes.splice(start..start, again);
            }
            2 => {
                let odd = ODD[self.below(ODD.len())];
                bytes.splice(part, odd.iter().copied());
            }
            3 => {
                let other = self.seed();
                let (from, count) = self.range(other.len());
                bytes.splice(part, other[from..from + count].iter().copied());
            }
            4 => bytes.truncate(start),
            _ => {
                if let Some(byte) = bytes.get_mut(start) {
                    *byte ^= 1 << (self.random.next_u32() % 8);
                }
            }
        }
    }

    /// Start and length of a random range within `len` bytes, mostly a short one.
    fn range(&mut self, len: usize) -> (usize, usize) {
        let start = self.below(len + 1);
        let most = match self.below(4) {
            0 => len,
            _ => 16,
        };
        (start, self.below(most.min(len - start) + 1))
    }

    fn seed(&mut self) -> &'a [u8] {
        let index = self.below(self.seeds.len());
        &self.seeds[index]
    }

    fn below(&mut self, count: usize) -> usize {
        (self.random.next_u64() % count as u64) as usize
    }
}
