//! Patches of buffers: sends many small changes in one submission, and a kernel scatters them.

use std::borrow::Cow;

use guideway_scene::RenderError;
use wgpu::BufferUsages;

use super::error::DeviceError;
use super::gpu::Gpu;
use super::kernel::{Kernel, Source};
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
        let words = bytemuck::cast_slice(std::slice::from_ref(value));
        for (part, at) in words
            .chunks(MAX_RUN_WORDS)
            .zip((0..).step_by(MAX_RUN_WORDS))
        {
            self.set_words(first_word + at, part);
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

    /// Applies a patch to a buffer, before the next submission.
    pub(crate) fn apply(
        &self,
        gpu: &Gpu,
        runner: &Runner,
        patch: &Patch,
        target: &DeviceBuffer,
    ) -> Result<(), DeviceError> {
        let what = "changes of the scene";
        let buffers = [&self.batch, &self.runs, &self.words, target];
        let bindings = self.kernel.bind(gpu, &buffers)?;
        let mut runs = patch.runs.as_slice();
        while let Some(first) = runs.first() {
            let fits = |run: &&Run| {
                let words = (run.source + run.words - first.source) as usize;
                words <= BATCH_WORDS
            };
            let count = runs.iter().take(BATCH_RUNS).take_while(fits).count();
            let (sent, rest) = runs.split_at(count);
            let last = sent[count - 1];
            let words = first.source as usize..(last.source + last.words) as usize;
            let batch = [count as u32, first.source, 0, 0];
            runner.write(what, &self.batch, &batch)?;
            runner.write_at(what, &self.runs, 0, sent)?;
            runner.write_at(what, &self.words, 0, &patch.words[words])?;
            let dispatch = Dispatch {
                kernel: &self.kernel,
                bindings: &bindings,
                workgroups: (count as u32).div_ceil(THREADS),
            };
            runner.start(what, &[dispatch])?;
            runs = rest;
        }
        Ok(())
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
}
