//! Patches of buffers: sends many small changes in one submission, and a kernel scatters them.

use std::borrow::Cow;

use guideway_scene::RenderError;
use wgpu::BufferUsages;

use super::error::DeviceError;
use super::gpu::Gpu;
use super::kernel::{Bindings, Kernel, Source};
use super::memory::{DeviceBuffer, Memory};
use super::runner::{Dispatch, Runner};

/// Most words per run: one thread copies a run.
const MAX_RUN_WORDS: usize = 64;
/// Most words and runs per submission.
const BATCH_WORDS: usize = 1 << 20;
const BATCH_RUNS: usize = 1 << 17;
const THREADS: u32 = 64;

const PATCH: Source = Source {
    name: "patch",
    wgsl: Cow::Borrowed(include_str!("patch.wgsl")),
    bindings: &["batch", "runs", "words", "target_words"],
};

/// New values for parts of one buffer, in 32-bit words.
#[derive(Default)]
pub(crate) struct Patch {
    runs: Vec<Run>,
    words: Vec<u32>,
}

/// A run of adjacent words. WGSL: `Run` of `patch.wgsl`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
struct Run {
    target_word: u32,
    source: u32,
    words: u32,
}

impl Patch {
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

/// Sends patches: the scatter kernel and its staging buffers.
pub(crate) struct Patcher {
    kernel: Kernel,
    batch: DeviceBuffer,
    runs: DeviceBuffer,
    words: DeviceBuffer,
}

impl Patcher {
    pub(crate) fn new(gpu: &Gpu, memory: &mut Memory) -> Result<Self, RenderError> {
        let kernel = Kernel::new(gpu, &PATCH, &[("THREADS", f64::from(THREADS))]);
        let what = "changes of the scene";
        let staging = BufferUsages::STORAGE | BufferUsages::COPY_DST;
        Ok(Self {
            kernel: kernel.map_err(|error| memory.device_error(&error))?,
            batch: memory.zeros(what, 16, BufferUsages::UNIFORM | BufferUsages::COPY_DST)?,
            runs: memory.zeros(what, (BATCH_RUNS * size_of::<Run>()) as u64, staging)?,
            words: memory.zeros(what, (BATCH_WORDS * size_of::<u32>()) as u64, staging)?,
        })
    }

    /// Applies patches to a buffer, before the next submission, in as few batches as possible.
    pub(crate) fn apply(
        &self,
        gpu: &Gpu,
        runner: &Runner,
        patches: &[&Patch],
        target: &DeviceBuffer,
    ) -> Result<(), DeviceError> {
        let buffers = [&self.batch, &self.runs, &self.words, target];
        let bindings = self.kernel.bind(gpu, &buffers)?;
        let mut batch = Batch::default();
        for patch in patches {
            let mut runs = patch.runs.as_slice();
            while !runs.is_empty() {
                runs = batch.add(runs, &patch.words);
                if !runs.is_empty() {
                    self.send(runner, &bindings, std::mem::take(&mut batch))?;
                }
            }
        }
        self.send(runner, &bindings, batch)
    }

    fn send(&self, runner: &Runner, bindings: &Bindings, batch: Batch) -> Result<(), DeviceError> {
        let what = "changes of the scene";
        if batch.runs.is_empty() {
            return Ok(());
        }
        let count = batch.runs.len() as u32;
        runner.write(what, &self.batch, &[count, 0, 0, 0])?;
        runner.write_at(what, &self.runs, 0, &batch.runs)?;
        runner.write_at(what, &self.words, 0, &batch.words)?;
        let dispatch = Dispatch {
            kernel: &self.kernel,
            bindings,
            workgroups: count.div_ceil(THREADS),
        };
        runner.start(what, &[dispatch])
    }
}

/// Runs of one submission, and their words.
#[derive(Default)]
struct Batch {
    runs: Vec<Run>,
    words: Vec<u32>,
}

impl Batch {
    /// Adds as many runs of a patch with these words as there is room for. Returns the others.
    fn add<'a>(&mut self, runs: &'a [Run], words: &[u32]) -> &'a [Run] {
        let Some(first) = runs.first() else {
            return runs;
        };
        let end = |run: &Run| (run.source + run.words) as usize;
        let start = first.source as usize;
        let fits = |run: &&Run| end(run) - start <= BATCH_WORDS - self.words.len();
        let room = BATCH_RUNS - self.runs.len();
        let count = runs.iter().take(room).take_while(fits).count();
        let (added, others) = runs.split_at(count);
        let Some(last) = added.last() else {
            return runs;
        };
        let moved = added.iter().map(|run| Run {
            source: run.source - first.source + self.words.len() as u32,
            ..*run
        });
        self.runs.extend(moved);
        self.words.extend_from_slice(&words[start..end(last)]);
        others
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::reflection::{assert_bindings, assert_layout, members};

    #[test]
    fn shader_matches_the_rust_layout() {
        assert_bindings(&PATCH);
        assert_layout(&[&PATCH], "Run", &members!(Run: target_word, source, words));
    }

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
        let patch = |words: std::ops::Range<usize>| {
            let mut patch = Patch::default();
            words.for_each(|word| patch.set(word, &(word as u32)));
            patch
        };
        let (small, large) = (patch(3..5), patch(0..BATCH_WORDS));
        let mut batch = Batch::default();
        assert!(batch.add(&small.runs, &small.words).is_empty());
        let others = batch.add(&large.runs, &large.words);
        // Two words of the last run have no room.
        assert_eq!(others.len(), 1);
        let second = Run {
            target_word: 0,
            source: 2,
            words: 64,
        };
        assert_eq!(batch.runs[1], second);
        let mut next = Batch::default();
        assert!(next.add(others, &large.words).is_empty());
        assert_eq!((next.runs[0].source, next.words.len()), (0, 64));
    }
}
