//! [`ValueTable`]: numbers the different values of a tile, by a hash table that keeps its memory.

use std::hash::{BuildHasher, RandomState};
use std::ops::Range;

/// Slots at first.
const SLOTS: usize = 1 << 10;
/// Odd, with about as many bits set as not: 2^64 divided by the golden ratio (Knuth, The Art of
/// Computer Programming, 6.4).
const FACTOR: u64 = 0x9e37_79b9_7f4a_7c15;

/// A value that was looked up.
struct Entry {
    hash: u64,
    number: u32,
    /// Its place in the bytes of all values.
    at: Range<usize>,
}

/// Numbers of values, in the order in which they come first.
pub(super) struct ValueTable {
    /// Index of an entry plus one, by its hash; 0 is free. A power of two.
    slots: Vec<u32>,
    entries: Vec<Entry>,
    count: u32,
    /// Secret, so that no file has values of one hash on purpose.
    seed: u64,
}

impl Default for ValueTable {
    fn default() -> Self {
        Self {
            slots: vec![0; SLOTS],
            entries: Vec::new(),
            count: 0,
            seed: RandomState::new().hash_one(FACTOR),
        }
    }
}

impl ValueTable {
    /// Removes all values.
    pub(super) fn clear(&mut self) {
        if 4 * self.entries.len() < self.slots.len() {
            for entry in &self.entries {
                let mut slot = self.slot(entry.hash);
                while self.slots[slot] != 0 {
                    self.slots[slot] = 0;
                    slot = (slot + 1) % self.slots.len();
                }
            }
        } else {
            self.slots.fill(0);
        }
        self.entries.clear();
        self.count = 0;
    }

    /// The next number, for a value that is not looked up.
    pub(super) fn skip(&mut self) -> u32 {
        self.count += 1;
        self.count - 1
    }

    /// The number of a value. `all` has the bytes of all values; a new one is appended behind its
    /// `head`.
    pub(super) fn number(
        &mut self,
        value: &[u8],
        all: &mut Vec<u8>,
        head: impl FnOnce(&mut Vec<u8>),
    ) -> u32 {
        let hash = self.hash(value);
        let mut slot = self.slot(hash);
        while let Some(index) = self.slots[slot].checked_sub(1) {
            let entry = &self.entries[index as usize];
            if entry.hash == hash && all[entry.at.clone()] == *value {
                return entry.number;
            }
            slot = (slot + 1) % self.slots.len();
        }
        head(all);
        let start = all.len();
        all.extend_from_slice(value);
        let number = self.skip();
        self.entries.push(Entry {
            hash,
            number,
            at: start..all.len(),
        });
        self.slots[slot] = self.entries.len() as u32;
        if 2 * self.entries.len() > self.slots.len() {
            self.grow();
        }
        number
    }

    fn slot(&self, hash: u64) -> usize {
        (hash >> (u64::BITS - self.slots.len().ilog2())) as usize
    }

    fn grow(&mut self) {
        self.slots = vec![0; 2 * self.slots.len()];
        for index in 0..self.entries.len() {
            let mut slot = self.slot(self.entries[index].hash);
            while self.slots[slot] != 0 {
                slot = (slot + 1) % self.slots.len();
            }
            self.slots[slot] = index as u32 + 1;
        }
    }

    /// Hash of some bytes: words are folded into the seed by the halves of a product of 128 bits.
    fn hash(&self, bytes: &[u8]) -> u64 {
        let fold = |hash: u64, word: u64| {
            let product = u128::from(hash ^ word) * u128::from(FACTOR);
            (product as u64) ^ (product >> u64::BITS) as u64
        };
        let (words, rest) = bytes.as_chunks::<8>();
        let words = words.iter().map(|word| u64::from_le_bytes(*word));
        let hash = words.fold(self.seed ^ bytes.len() as u64, fold);
        let mut last = [0; 8];
        last[..rest.len()].copy_from_slice(rest);
        fold(fold(hash, u64::from_le_bytes(last)), self.seed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_values_have_one_number_after_growth_and_reuse() {
        let mut table = ValueTable::default();
        for round in 0..3_usize {
            table.clear();
            let mut all = Vec::new();
            let values = [5000, 20, 3000][round];
            for pass in 0..2 {
                for value in 0..values {
                    let text = format!("value {value} of {round}");
                    let number = table.number(text.as_bytes(), &mut all, |all| all.push(b'|'));
                    assert_eq!(number, value as u32, "pass {pass}");
                }
            }
            assert_eq!(table.skip(), values as u32);
            let texts = String::from_utf8(all).expect("texts");
            assert_eq!(texts.split('|').count(), values + 1);
        }
    }
}
