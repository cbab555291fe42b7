//! Patches: many small changes of one buffer, and their batches.

use std::ops::Range;

use rayon::prelude::*;

/// Most words per run: one thread copies a run.
const MAX_RUN_WORDS: usize = 64;
/// Most words and runs per submission.
pub(super) const BATCH_WORDS: usize = 1 << 21;
pub(super) const BATCH_RUNS: usize = 1 << 18;

/// New values for parts of one buffer, in 32-bit words.
#[derive(Default)]
pub(crate) struct Patch {
    runs: Vec<Run>,
    words: Vec<u32>,
}

/// A run of adjacent words. WGSL: three words of `entries` in `patch.wgsl`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub(super) struct Run {
    target_word: u32,
    source: u32,
    words: u32,
}

impl Patch {
    /// A patch with room for `runs` runs of `words` words in all.
    pub(crate) fn with_capacity(runs: usize, words: usize) -> Self {
        Self {
            runs: Vec::with_capacity(runs),
            words: Vec::with_capacity(words),
        }
    }

    /// Drops all values, and keeps the memory.
    pub(crate) fn clear(&mut self) {
        self.runs.clear();
        self.words.clear();
    }

    /// Sets the value at a word index of the buffer.
    pub(crate) fn set<T: bytemuck::NoUninit>(&mut self, first_word: usize, value: &T) {
        self.set_all(first_word, std::slice::from_ref(value));
    }

    /// Sets adjacent values from a word index of the buffer on.
    pub(crate) fn set_all<T: bytemuck::NoUninit>(&mut self, first_word: usize, values: &[T]) {
        let words = bytemuck::cast_slice(values);
        for (part, at) in words
            .chunks(MAX_RUN_WORDS)
            .zip((0..).step_by(MAX_RUN_WORDS))
        {
            self.set_words(first_word + at, part);
        }
    }

    /// Bytes of memory held.
    pub(crate) fn capacity_bytes(&self) -> usize {
        self.runs.capacity() * size_of::<Run>() + self.words.capacity() * size_of::<u32>()
    }

    /// As [`Self::set_all`], of computed words.
    pub(crate) fn set_each(&mut self, first_word: usize, words: impl Iterator<Item = u32>) {
        let mut part = [0; MAX_RUN_WORDS];
        let (mut len, mut target) = (0, first_word);
        for word in words {
            part[len] = word;
            len += 1;
            if len == MAX_RUN_WORDS {
                self.set_words(target, &part);
                (len, target) = (0, target + len);
            }
        }
        if len > 0 {
            self.set_words(target, &part[..len]);
        }
    }

    fn set_words(&mut self, target: usize, words: &[u32]) {
        let source = self.words.len() as u32;
        self.words.extend_from_slice(words);
        let len = words.len() as u32;
        match self.runs.last_mut() {
            Some(last)
                if last.target_word as usize + last.words as usize == target
                    && (last.words + len) as usize <= MAX_RUN_WORDS =>
            {
                last.words += len;
            }
            _ => self.runs.push(Run {
                target_word: target as u32,
                source,
                words: len,
            }),
        }
    }

    /// Bytes that the patch sends.
    pub(crate) fn bytes(&self) -> u64 {
        (size_of_val(self.runs.as_slice()) + size_of_val(self.words.as_slice())) as u64
    }
}

/// Some runs of a patch, and their words.
struct Piece<'a> {
    patch: &'a Patch,
    runs: Range<usize>,
    words: Range<usize>,
}

/// Runs of one submission, and their words.
#[derive(Default)]
pub(super) struct Batch<'a> {
    pieces: Vec<Piece<'a>>,
    runs: usize,
    words: usize,
}

impl<'a> Batch<'a> {
    /// Batches of patches, as few as possible.
    pub(super) fn of_all(patches: &[&'a Patch]) -> Vec<Self> {
        let mut batches = vec![Self::default()];
        for patch in patches {
            let mut first = 0;
            while first < patch.runs.len() {
                if let Some(batch) = batches.last_mut() {
                    first = batch.add(patch, first);
                }
                if first < patch.runs.len() {
                    batches.push(Self::default());
                }
            }
        }
        batches.retain(|batch| batch.runs > 0);
        batches
    }

    /// Adds as many runs of a patch, from `first` on, as there is room for. Returns the first of
    /// the others.
    fn add(&mut self, patch: &'a Patch, first: usize) -> usize {
        let source = |run: usize| patch.runs.get(run).map(|run| run.source as usize);
        let start = source(first).unwrap_or(patch.words.len());
        let room = start + BATCH_WORDS - self.words;
        let runs = &patch.runs[first..patch.runs.len().min(first + BATCH_RUNS - self.runs)];
        let fits = |run: &Run| (run.source + run.words) as usize <= room;
        let end = first + runs.partition_point(fits);
        let words = start..source(end).unwrap_or(patch.words.len());
        self.runs += end - first;
        self.words += words.len();
        self.pieces.push(Piece {
            patch,
            runs: first..end,
            words,
        });
        end
    }

    /// Number of runs and of words.
    pub(super) fn len(&self) -> [usize; 2] {
        [self.runs, self.words]
    }

    /// The runs of each piece, with their places among all words. All threads share the work.
    pub(super) fn runs(&self) -> Vec<Vec<Run>> {
        let mut first = 0;
        let places = self.pieces.iter().map(|piece| {
            first += piece.words.len();
            first - piece.words.len()
        });
        let pieces: Vec<_> = self.pieces.iter().zip(places).collect();
        let placed = pieces.into_par_iter().map(|(piece, place)| {
            let runs = piece.patch.runs[piece.runs.clone()].iter();
            let placed = runs.map(|run| Run {
                source: run.source - piece.words.start as u32 + place as u32,
                ..*run
            });
            placed.collect()
        });
        placed.collect()
    }

    /// The words of each piece.
    pub(super) fn words(&self) -> impl Iterator<Item = &'a [u32]> {
        let pieces = self.pieces.iter();
        pieces.map(|piece| &piece.patch.words[piece.words.clone()])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn merges_adjacent_words_up_to_the_run_limit() {
        let mut patch = Patch::default();
        for word in (0..100).chain(200..201) {
            patch.set(word, &7_u32);
        }
        let runs: Vec<_> = patch
            .runs
            .iter()
            .map(|r| (r.target_word, r.words))
            .collect();
        assert_eq!(runs, [(0, 64), (64, 36), (200, 1)]);
    }

    #[test]
    fn patches_share_a_batch_until_it_is_full() {
        let patch = |words: Range<usize>| {
            let mut patch = Patch::default();
            words.for_each(|word| patch.set(word, &(word as u32)));
            patch
        };
        let (small, large) = (patch(3..5), patch(0..BATCH_WORDS));
        let none = Patch::default();
        let batches = Batch::of_all(&[&small, &none, &large]);
        // Two words of the last run have no room.
        let lengths: Vec<_> = batches.iter().map(Batch::len).collect();
        assert_eq!(lengths, [[1 << 15, BATCH_WORDS - 62], [1, 64]]);
        let runs = batches[0].runs().concat();
        let second = Run {
            target_word: 0,
            source: 2,
            words: 64,
        };
        assert_eq!(runs[1], second);
        assert_eq!(batches[1].runs().concat()[0].source, 0);
        let words = batches.iter().flat_map(|batch| batch.words().flatten());
        let expected = [3, 4].into_iter().chain(0..BATCH_WORDS as u32);
        assert!(words.copied().eq(expected));
        assert!(Batch::of_all(&[]).is_empty());
    }
}
