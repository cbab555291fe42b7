//! Draws a picture: lets the pixels of each band walk over one chunk after the other, in dispatches
//! of limited length, until none has to go on.
//!
//! Input: parameters of a view, chunks, buffers. Output: the bytes of each band, and times.

use std::ops::Range;
use std::time::Instant;

use guideway_gpu::device::{DeviceBuffer, Dispatch, Gpu, Kernel, Memory, Runner};
use guideway_grid::per_pixel::{PIXEL_BYTES, PictureBuffers, TILE_PX};
use guideway_scene::{Cancel, RenderError, elapsed_ms};

use crate::chunk::BuiltChunk;
use crate::params::{Kernels, ViewParams};

/// Bytes of the progress of a pixel.
pub(super) const PROGRESS_BYTES: u64 = size_of::<[u32; 4]>() as u64;
/// Fewest loop iterations per thread and dispatch.
const MIN_LIMIT: u64 = 2048;
/// Chosen: a dispatch has this many times the pixels that it could let walk up to the limit,
/// because few pixels walk that far.
const TYPICAL_SHARE: u64 = 16;

/// The inputs that all dispatches of a picture share.
pub(super) struct Drawing<'a> {
    pub(super) gpu: &'a Gpu,
    pub(super) kernels: &'a Kernels,
    pub(super) memory: &'a Memory,
    pub(super) runner: &'a Runner,
    pub(super) chunks: &'a [BuiltChunk],
    /// Paths have several colors.
    pub(super) is_ranked: bool,
    /// Reads back whether walks have to go on.
    pub(super) unfinished: &'a DeviceBuffer,
    pub(super) params: &'a ViewParams,
    pub(super) buffers: &'a PictureBuffers,
    pub(super) cancel: &'a Cancel,
}

impl Drawing<'_> {
    /// Draws a frame and passes the result of each band to `take`. Returns the milliseconds of
    /// drawing and of reading back.
    ///
    /// # Errors
    /// When the device fails, or the caller cancels.
    pub(super) fn draw(
        &self,
        mut take: impl FnMut(Range<u32>, &[u8]),
    ) -> Result<(f64, f64), RenderError> {
        let (mut drawing_ms, mut fetching_ms) = (0.0, 0.0);
        let kernel = self
            .kernels
            .pixels(self.is_ranked, self.buffers.layout.purpose);
        for rows in self.buffers.bands() {
            for number in kernel.iter().flat_map(|_| 0..self.chunks.len()) {
                let mut params = self.chunk_params(number, &rows);
                while let Some(kernel) = kernel {
                    let (elapsed_ms, goes_on) = self.walk(number, kernel, &params)?;
                    drawing_ms += elapsed_ms;
                    if !goes_on {
                        break;
                    }
                    params.is_start = 0;
                }
            }
            self.cancel.check()?;
            let start = Instant::now();
            let (result, row_bytes) = self.buffers.result();
            let bytes = u64::from(rows.end - rows.start) * row_bytes;
            let through = &self.buffers.fetched;
            let take_rows = |bytes: &[u8]| take(rows, bytes);
            let fetched = self
                .runner
                .fetch("the picture", result, through, bytes, take_rows);
            fetched.map_err(|error| self.memory.device_error(&error))?;
            fetching_ms += elapsed_ms(start);
        }
        Ok((drawing_ms, fetching_ms))
    }

    /// The parameters of all tiles of a band, for the first walk over a chunk.
    fn chunk_params(&self, number: usize, rows: &Range<u32>) -> ViewParams {
        let height = rows.end - rows.start;
        let tiles = self.params.width_px.div_ceil(TILE_PX) * height.div_ceil(TILE_PX);
        let pixels = u64::from(tiles * TILE_PX * TILE_PX);
        let most = u64::from(self.gpu.loops_per_thread() / 2).max(MIN_LIMIT);
        let limit = self.gpu.tests_per_submit() / pixels;
        ViewParams {
            first_row: rows.start,
            rows: height,
            end_tile: tiles,
            leaves: self.chunks[number].0.leaves,
            limit: limit.clamp(MIN_LIMIT, most) as u32,
            is_first_chunk: u32::from(number == 0),
            is_last_chunk: u32::from(number + 1 == self.chunks.len()),
            is_start: 1,
            ..*self.params
        }
    }

    /// Lets all pixels of a band walk over a chunk, up to the limit of a dispatch. Returns the
    /// milliseconds, and `true` if some have to go on.
    fn walk(
        &self,
        number: usize,
        kernel: &Kernel,
        all: &ViewParams,
    ) -> Result<(f64, bool), RenderError> {
        let ok = |error| self.memory.device_error(&error);
        let what = "the picture";
        let counters = &self.chunks[number].0.counters;
        let per_tile = u64::from(all.limit * TILE_PX * TILE_PX);
        let at_once = TYPICAL_SHARE * self.gpu.tests_per_submit() / per_tile;
        let at_once = at_once.clamp(1, self.gpu.max_workgroups().into()) as u32;
        let mut drawing_ms = 0.0;
        for first_tile in (0..all.end_tile).step_by(at_once as usize) {
            self.cancel.check()?;
            let end_tile = all.end_tile.min(first_tile.saturating_add(at_once));
            let params = ViewParams {
                first_tile,
                end_tile,
                ..*all
            };
            self.runner
                .write(what, &self.buffers.view, &params)
                .map_err(ok)?;
            let dispatch = Dispatch {
                kernel,
                bindings: &self.buffers.bindings[number],
                workgroups: end_tile - first_tile,
            };
            // The first dispatch clears the word that tells whether walks have to go on.
            let cleared = [(counters, PIXEL_BYTES)];
            let cleared = if first_tile == 0 { &cleared[..] } else { &[] };
            let stages = self
                .runner
                .run_stages(what, cleared, &[(what, &[dispatch])]);
            let stages = stages.map_err(ok)?;
            drawing_ms += stages.iter().map(|stage| stage.elapsed_ms).sum::<f64>();
        }
        let mut goes_on = false;
        let read = |word: &[u8]| goes_on = word.iter().any(|&byte| byte != 0);
        let fetched = self
            .runner
            .fetch(what, counters, self.unfinished, PIXEL_BYTES, read);
        fetched.map_err(ok)?;
        Ok((drawing_ms, goes_on))
    }
}
