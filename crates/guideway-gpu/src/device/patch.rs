//! Changes of parts of buffers, many small ones at once.

use guideway_scene::RenderError;
use wgpu::BufferUsages;

use super::{Bindings, DeviceBuffer, Dispatch, Gpu, Kernel, Memory, Runner, Source};

/// Words of a run: a thread copies one.
const RUN_WORDS: usize = 64;
/// Words that are sent at a time, and runs.
const SENT_WORDS: usize = 1 << 20;
const SENT_RUNS: usize = 1 << 17;
const THREADS: u32 = 64;

const PATCH: Source = Source {
    name: "patch",
    wgsl: include_str!("patch.wgsl"),
    bindings: &["batch", "runs", "words", "target_words"],
};

/// New values for parts of one buffer, in words.
#[derive(Default)]
pub(crate) struct Patch {
    runs: Vec<Run>,
    words: Vec<u32>,
}

/// `Run` of `patch.wgsl`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
struct Run {
    target_word: u32,
    source: u32,
    words: u32,
}

impl Patch {
    /// Sets a value that begins at a word of the buffer.
    pub(crate) fn set<T: bytemuck::NoUninit>(&mut self, first_word: usize, value: &T) {
        let words = bytemuck::cast_slice(std::slice::from_ref(value));
        for (part, at) in words.chunks(RUN_WORDS).zip((0..).step_by(RUN_WORDS)) {
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
                    && (last.words + len) as usize <= RUN_WORDS =>
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

    /// Bytes that it sends.
    pub(crate) fn bytes(&self) -> u64 {
        (size_of_val(self.runs.as_slice()) + size_of_val(self.words.as_slice())) as u64
    }
}

/// What sends patches.
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
        let sent = BufferUsages::STORAGE | BufferUsages::COPY_DST;
        Ok(Self {
            kernel: kernel.map_err(|what| memory.trouble(what))?,
            batch: memory.zeros(what, 16, BufferUsages::UNIFORM | BufferUsages::COPY_DST)?,
            runs: memory.zeros(what, (SENT_RUNS * size_of::<Run>()) as u64, sent)?,
            words: memory.zeros(what, (SENT_WORDS * size_of::<u32>()) as u64, sent)?,
        })
    }

    /// Changes a buffer, from the next submit on.
    pub(crate) fn apply(
        &self,
        gpu: &Gpu,
        runner: &Runner,
        patch: &Patch,
        target: &DeviceBuffer,
    ) -> Result<(), String> {
        let what = "changes of the scene";
        let buffers = [&self.batch, &self.runs, &self.words, target];
        let bindings: Bindings = self.kernel.bind(gpu, &buffers)?;
        let mut runs = patch.runs.as_slice();
        while let Some(first) = runs.first() {
            let fits = |run: &&Run| {
                let words = (run.source + run.words - first.source) as usize;
                words <= SENT_WORDS
            };
            let count = runs.iter().take(SENT_RUNS).take_while(fits).count();
            let (sent, rest) = runs.split_at(count);
            let last = sent[count - 1];
            let words = first.source as usize..(last.source + last.words) as usize;
            let batch = [count as u32, first.source, 0, 0];
            runner.set(what, &self.batch, &batch)?;
            runner.set_all(what, &self.runs, sent)?;
            runner.set_all(what, &self.words, &patch.words[words])?;
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
    use crate::testing::reflection::{assert_binds_what_it_is_given, assert_laid_out, members};

    #[test]
    fn the_shader_is_what_it_is_taken_for() {
        assert_binds_what_it_is_given(&PATCH);
        assert_laid_out(&[&PATCH], "Run", &members!(Run: target_word, source, words));
    }

    #[test]
    fn neighbors_become_one_run_up_to_its_most() {
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
