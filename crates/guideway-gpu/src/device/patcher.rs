//! Sends changes of buffers: a kernel takes them to their places.
//!
//! ```text
//!   patches    | runs, words |   one run per range of adjacent words, from many tasks
//!   bits       | element, set or cleared |            4 bytes per element
//!   values     | element | index of its value |       8 bytes per element, or 4 of one value
//! ```

use std::borrow::Cow;

use bytemuck::{Pod, Zeroable};
use guideway_scene::RenderError;
use wgpu::BufferUsages;

use super::error::DeviceError;
use super::gpu::Gpu;
use super::kernel::{Kernel, Source};
use super::memory::{DeviceBuffer, Memory};
use super::patch::{BATCH_RUNS, Batch, Patch};
use super::runner::{Dispatch, Runner};

/// Words per run among the entries.
const RUN_WORDS: usize = 3;
/// Most words of entries per submission.
const MAX_ENTRY_WORDS: usize = RUN_WORDS * BATCH_RUNS;
/// Least size of a staging buffer, in words.
const MIN_WORDS: usize = 1 << 12;
const THREADS: u32 = 64;
const WHAT: &str = "changes of the scene";
/// The highest bit of an entry of [`Patcher::set_bits`]: set the bit, else clear it.
pub(crate) const SET_BIT: u32 = 1 << 31;

const PATCH: Source = Source {
    name: "patch",
    wgsl: Cow::Borrowed(include_str!("patch.wgsl")),
    bindings: &["batch", "entries", "words", "target_words"],
};

/// Parameters of a submission. WGSL: `Batch` of `patch.wgsl`.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct BatchParams {
    entries: u32,
    kind: u32,
    element_words: u32,
    bit: u32,
}

/// Kinds of entries, as in `patch.wgsl`.
#[derive(Clone, Copy)]
enum Kind {
    Runs = 0,
    Bits = 1,
    Values = 2,
    Alike = 3,
    Fill = 4,
}

/// The device, and the buffer to change.
pub(crate) struct PatchTarget<'a> {
    pub(crate) gpu: &'a Gpu,
    pub(crate) memory: &'a mut Memory,
    pub(crate) runner: &'a Runner,
    pub(crate) buffer: &'a DeviceBuffer,
}

/// Compiles the kernel of all patchers.
pub(crate) fn patch_kernel(gpu: &Gpu) -> Result<Kernel, DeviceError> {
    Kernel::new(gpu, &PATCH, &[("THREADS", f64::from(THREADS))])
}

/// The scatter kernel and its staging buffers.
pub(crate) struct Patcher {
    kernel: Kernel,
    batch: DeviceBuffer,
    entries: DeviceBuffer,
    words: DeviceBuffer,
}

impl Patcher {
    pub(crate) fn new(kernel: Kernel, memory: &mut Memory) -> Result<Self, RenderError> {
        let bytes = size_of::<BatchParams>() as u64;
        Ok(Self {
            kernel,
            batch: memory.zeros(WHAT, bytes, BufferUsages::UNIFORM | BufferUsages::COPY_DST)?,
            entries: staging(memory, MIN_WORDS)?,
            words: staging(memory, MIN_WORDS)?,
        })
    }

    /// Applies patches to a buffer, before the next submission, in as few batches as possible.
    pub(crate) fn apply(
        &mut self,
        mut target: PatchTarget<'_>,
        patches: &[&Patch],
    ) -> Result<(), RenderError> {
        for batch in Batch::of_all(patches) {
            let [count, words] = batch.len();
            self.reserve(&mut target, RUN_WORDS * count, words)?;
            let runs = batch.runs();
            let runs: Vec<&[u32]> = runs.iter().map(|runs| bytemuck::cast_slice(runs)).collect();
            let words: Vec<&[u32]> = batch.words().collect();
            let params = BatchParams {
                entries: count as u32,
                kind: Kind::Runs as u32,
                element_words: 0,
                bit: 0,
            };
            self.send(&target, params, &runs, &words)?;
        }
        Ok(())
    }

    /// Sets or clears a bit in the first word of elements of `element_words` words, before the next
    /// submission. An entry is the index of an element, with [`SET_BIT`] if its bit is set.
    pub(crate) fn set_bits(
        &mut self,
        mut target: PatchTarget<'_>,
        element_words: usize,
        bit: u32,
        entries: &[Vec<u32>],
    ) -> Result<(), RenderError> {
        for lists in entry_batches(entries, MAX_ENTRY_WORDS) {
            let count = lists.iter().map(|list| list.len()).sum();
            self.reserve(&mut target, count, 1)?;
            let params = BatchParams {
                entries: count as u32,
                kind: Kind::Bits as u32,
                element_words: element_words as u32,
                bit,
            };
            self.send(&target, params, &lists, &[])?;
        }
        Ok(())
    }

    /// Sets elements to one of some values each, before the next submission. `picks` has the index
    /// of the value of each element; without any, all elements get the first value.
    pub(crate) fn set_values<T: Pod>(
        &mut self,
        mut target: PatchTarget<'_>,
        elements: &[Vec<u32>],
        picks: &[Vec<u32>],
        values: &[T],
    ) -> Result<(), RenderError> {
        let words: &[u32] = bytemuck::cast_slice(values);
        let (kind, lists_per_batch) = match picks.is_empty() {
            true => (Kind::Alike, 1),
            false => (Kind::Values, 2),
        };
        let most = MAX_ENTRY_WORDS / lists_per_batch;
        let element_batches = entry_batches(elements, most);
        let mut pick_batches = entry_batches(picks, most).into_iter();
        // The first batch brings the values, which stay in their buffer for the others.
        let mut unsent = words;
        for mut lists in element_batches {
            let count: usize = lists.iter().map(|list| list.len()).sum();
            lists.extend(pick_batches.next().unwrap_or_default());
            self.reserve(&mut target, lists_per_batch * count, words.len())?;
            let params = BatchParams {
                entries: count as u32,
                kind: kind as u32,
                element_words: (size_of::<T>() / size_of::<u32>()) as u32,
                bit: 0,
            };
            self.send(&target, params, &lists, &[std::mem::take(&mut unsent)])?;
        }
        Ok(())
    }

    /// Sets the first `count` elements of a buffer to one value, before the next submission.
    pub(crate) fn fill<T: Pod>(
        &mut self,
        target: &PatchTarget<'_>,
        count: usize,
        value: &T,
    ) -> Result<(), RenderError> {
        let value: &[u32] = bytemuck::cast_slice(std::slice::from_ref(value));
        let params = BatchParams {
            entries: count as u32,
            kind: Kind::Fill as u32,
            element_words: value.len() as u32,
            bit: 0,
        };
        self.send(target, params, &[], &[value])
    }

    /// Grows the staging buffers to hold numbers of words.
    fn reserve(
        &mut self,
        target: &mut PatchTarget<'_>,
        entries: usize,
        words: usize,
    ) -> Result<(), RenderError> {
        for (buffer, needed) in [(&mut self.entries, entries), (&mut self.words, words)] {
            if buffer.bytes() < (needed * size_of::<u32>()) as u64 {
                *buffer = staging(target.memory, needed.next_power_of_two())?;
            }
        }
        Ok(())
    }

    fn send(
        &self,
        target: &PatchTarget<'_>,
        params: BatchParams,
        entries: &[&[u32]],
        words: &[&[u32]],
    ) -> Result<(), RenderError> {
        let sent = self.try_send(target, params, entries, words);
        sent.map_err(|error| target.memory.device_error(&error))
    }

    fn try_send(
        &self,
        target: &PatchTarget<'_>,
        params: BatchParams,
        entries: &[&[u32]],
        words: &[&[u32]],
    ) -> Result<(), DeviceError> {
        let runner = target.runner;
        let buffers = [&self.batch, &self.entries, &self.words, target.buffer];
        let bindings = self.kernel.bind(target.gpu, &buffers)?;
        runner.write(WHAT, &self.batch, &params)?;
        runner.write_parts(WHAT, &self.entries, entries)?;
        runner.write_parts(WHAT, &self.words, words)?;
        let dispatch = Dispatch {
            kernel: &self.kernel,
            bindings: &bindings,
            workgroups: params.entries.div_ceil(THREADS),
        };
        runner.start(WHAT, &[dispatch])
    }
}

fn staging(memory: &mut Memory, words: usize) -> Result<DeviceBuffer, RenderError> {
    let usage = BufferUsages::STORAGE | BufferUsages::COPY_DST;
    memory.zeros(WHAT, (words * size_of::<u32>()) as u64, usage)
}

/// Splits lists of entries into batches of at most `most` entries.
fn entry_batches(lists: &[Vec<u32>], most: usize) -> Vec<Vec<&[u32]>> {
    let mut batches = Vec::new();
    let (mut batch, mut room) = (Vec::new(), most);
    for list in lists {
        let mut rest = list.as_slice();
        while !rest.is_empty() {
            let (part, others) = rest.split_at(rest.len().min(room));
            batch.push(part);
            (rest, room) = (others, room - part.len());
            if room == 0 {
                batches.push(std::mem::take(&mut batch));
                room = most;
            }
        }
    }
    if !batch.is_empty() {
        batches.push(batch);
    }
    batches
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::reflection::{assert_bindings, assert_layout, members};

    #[test]
    fn shader_matches_the_rust_layout() {
        assert_bindings(&PATCH);
        let members = members!(BatchParams: entries, kind, element_words, bit);
        assert_layout(&[&PATCH], "Batch", &members);
        let kinds = [
            ("RUNS", Kind::Runs),
            ("BITS", Kind::Bits),
            ("VALUES", Kind::Values),
            ("ALIKE", Kind::Alike),
            ("FILL", Kind::Fill),
        ];
        for (name, kind) in kinds {
            let expected = format!("const {name}: u32 = {}u;", kind as u32);
            assert!(PATCH.wgsl.contains(&expected), "{expected}");
        }
        assert!(
            PATCH
                .wgsl
                .contains(&format!("const SET: u32 = {SET_BIT:#x}u;"))
        );
    }

    #[test]
    fn batches_hold_all_entries_in_order() {
        let lists = [
            (0..5).collect(),
            vec![],
            (5..7).collect(),
            (7..20).collect(),
        ];
        let batches = entry_batches(&lists, 6);
        let lengths: Vec<usize> = batches.iter().map(|b| b.concat().len()).collect();
        assert_eq!(lengths, [6, 6, 6, 2]);
        assert!(batches.concat().concat().into_iter().eq(0..20));
        assert!(entry_batches(&[], 6).is_empty());
    }
}
