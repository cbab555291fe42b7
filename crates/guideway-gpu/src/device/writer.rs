//! Writes parts back to back into a buffer: all threads copy them to the memory that the device
//! reads from.

use rayon::prelude::*;

use super::error::DeviceError;
use super::gpu::Gpu;

/// Bytes that one task copies: some 10 microseconds of work.
const COPY_BYTES: usize = 1 << 16;

impl Gpu {
    /// Writes parts back to back from an offset of a buffer on, before the next submission.
    pub(super) fn write_parts(
        &self,
        what: &str,
        buffer: &wgpu::Buffer,
        offset: u64,
        parts: &[&[u8]],
    ) -> Result<(), DeviceError> {
        let bytes: usize = parts.iter().map(|part| part.len()).sum();
        let Some(size) = wgpu::BufferSize::new(bytes as u64) else {
            return Ok(());
        };
        self.checked(what, || {
            let Some(mut view) = self.queue.write_buffer_with(buffer, offset, size) else {
                return;
            };
            let joined = Joined::new(parts);
            let (chunks, rest) = view.slice(..).into_chunks::<COPY_BYTES>();
            let rest_first = bytes - rest.len();
            let chunks: Vec<_> = chunks.into_iter().zip((0..).step_by(COPY_BYTES)).collect();
            if !chunks.is_empty() {
                let chunks = chunks.into_par_iter();
                chunks.for_each(|(chunk, first)| joined.copy(first, chunk.into()));
            }
            joined.copy(rest_first, rest);
        })
    }
}

/// Parts back to back.
struct Joined<'a> {
    parts: &'a [&'a [u8]],
    /// End of each part in bytes.
    ends: Vec<usize>,
}

impl<'a> Joined<'a> {
    fn new(parts: &'a [&'a [u8]]) -> Self {
        let mut end = 0;
        let ends = parts.iter().map(|part| {
            end += part.len();
            end
        });
        Self {
            ends: ends.collect(),
            parts,
        }
    }

    /// Fills memory with the bytes from `first` on.
    fn copy(&self, first: usize, mut to: wgpu::WriteOnly<'_, [u8]>) {
        let mut at = self.ends.partition_point(|end| *end <= first);
        let (mut first, mut filled) = (first, 0);
        while filled < to.len() {
            let part = self.parts[at];
            let left = self.ends[at] - first;
            let count = left.min(to.len() - filled);
            let from = part.len() - left;
            to.slice(filled..filled + count)
                .copy_from_slice(&part[from..from + count]);
            (first, filled, at) = (first + count, filled + count, at + 1);
        }
    }
}
