//! The tiles and pixels of one size of picture.

use guideway_scene::{FrameSize, RenderError};
use wgpu::BufferUsages;

use super::NAME;
use super::params::{FrameParams, TILE_PX};
use crate::device::{DeviceBuffer, FETCHED, Gpu, Memory};

const WORD_BYTES: u64 = size_of::<u32>() as u64;
/// Most bytes of pixels that are fetched at once.
const PART_BYTES: u64 = 1 << 19;

/// Buffers for one size of picture.
pub(super) struct Canvas {
    pub(super) size: FrameSize,
    pub(super) columns: u32,
    /// Rows of tiles of the whole picture.
    pub(super) rows: u32,
    /// Most rows of tiles that there is room for at once.
    pub(super) band_rows: u32,
    pub(super) frame: DeviceBuffer,
    pub(super) counts: DeviceBuffer,
    pub(super) lists: DeviceBuffer,
    pub(super) filled: DeviceBuffer,
    pub(super) pixels: DeviceBuffer,
    /// What pixels are fetched through, in turn.
    pub(super) fetched: Vec<DeviceBuffer>,
}

impl Canvas {
    pub(super) fn new(
        gpu: &Gpu,
        memory: &mut Memory,
        size: FrameSize,
    ) -> Result<Self, RenderError> {
        let (columns, rows) = (
            size.width().div_ceil(TILE_PX),
            size.height().div_ceil(TILE_PX),
        );
        let row_bytes = u64::from(size.width()) * u64::from(TILE_PX) * WORD_BYTES;
        let fit = gpu.binding_bytes() / row_bytes.max(1);
        let fit = fit.min(u64::from(gpu.most_workgroups() / columns));
        if fit == 0 {
            return Err(RenderError::Unsupported {
                method: NAME,
                what: format!("a picture {} pixels wide on this device", size.width()),
                remedy: "Ask for a narrower picture.".to_owned(),
            });
        }
        let band_rows = rows.min(u32::try_from(fit).unwrap_or(u32::MAX));
        let tiles = u64::from(columns) * u64::from(band_rows);
        let uniform = BufferUsages::UNIFORM | BufferUsages::COPY_DST;
        let storage = BufferUsages::STORAGE;
        let list = "the list of tiles";
        let band_bytes = row_bytes * u64::from(band_rows);
        let part_bytes = band_bytes.min(PART_BYTES);
        let mut part = || memory.zeros("the picture", part_bytes, FETCHED);
        let mut fetched = vec![part()?];
        if part_bytes < band_bytes {
            fetched.push(part()?);
        }
        Ok(Self {
            size,
            columns,
            rows,
            band_rows,
            frame: memory.zeros("the view", size_of::<FrameParams>() as u64, uniform)?,
            counts: memory.zeros(list, tiles * WORD_BYTES, storage | BufferUsages::COPY_DST)?,
            lists: memory.zeros(
                list,
                tiles * 2 * WORD_BYTES,
                storage | BufferUsages::COPY_SRC,
            )?,
            filled: memory.zeros(list, tiles * WORD_BYTES, storage | BufferUsages::COPY_SRC)?,
            pixels: pixels(memory, size, band_rows)?,
            fetched,
        })
    }

    /// Whether all of the picture is held at once.
    pub(super) fn is_whole(&self) -> bool {
        self.band_rows == self.rows
    }

    /// Another buffer for the pixels.
    pub(super) fn more_pixels(&self, memory: &mut Memory) -> Result<DeviceBuffer, RenderError> {
        pixels(memory, self.size, self.band_rows)
    }
}

fn pixels(memory: &mut Memory, size: FrameSize, rows: u32) -> Result<DeviceBuffer, RenderError> {
    let pixels = u64::from(size.width()) * u64::from(TILE_PX) * u64::from(rows);
    let usage = BufferUsages::STORAGE | BufferUsages::COPY_SRC;
    memory.zeros("the picture", pixels * WORD_BYTES, usage)
}
