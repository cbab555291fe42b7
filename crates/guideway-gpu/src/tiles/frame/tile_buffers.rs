//! Buffers of the tiles and pixels of one picture size.

use guideway_scene::{FrameSize, RenderError};
use wgpu::BufferUsages;

use crate::device::{DeviceBuffer, Gpu, Memory, READBACK_USAGE};
use crate::tiles::constants::TILE_PX;
use crate::tiles::layouts::FrameParams;
use crate::tiles::options::NAME;

const WORD_BYTES: u64 = size_of::<u32>() as u64;
/// Most bytes of pixels per readback: copying one part overlaps with reading another, and two small
/// buffers replace one of the size of the picture.
const READBACK_BYTES: u64 = 1 << 19;

/// Buffers of one picture size.
pub(crate) struct TileBuffers {
    pub(crate) size: FrameSize,
    pub(crate) columns: u32,
    /// Tile rows of the whole picture.
    pub(crate) rows: u32,
    /// Most tile rows that the buffers hold at once.
    pub(crate) band_rows: u32,
    pub(crate) frame: DeviceBuffer,
    pub(crate) tile_counts: DeviceBuffer,
    pub(crate) tile_lists: DeviceBuffer,
    pub(crate) list_cursors: DeviceBuffer,
    pub(crate) pixels: DeviceBuffer,
    /// Mappable buffers that pixels are read back through, in turn.
    pub(crate) readbacks: Vec<DeviceBuffer>,
}

impl TileBuffers {
    pub(crate) fn new(
        gpu: &Gpu,
        memory: &mut Memory,
        size: FrameSize,
    ) -> Result<Self, RenderError> {
        let columns = size.width().div_ceil(TILE_PX);
        let rows = size.height().div_ceil(TILE_PX);
        let row_bytes = u64::from(size.width()) * u64::from(TILE_PX) * WORD_BYTES;
        let fit = gpu.max_binding_bytes() / row_bytes.max(1);
        let fit = fit.min(u64::from(gpu.max_workgroups() / columns));
        if fit == 0 {
            return Err(RenderError::unsupported(
                NAME,
                format!("a picture {} pixels wide on this device", size.width()),
                "Request a narrower picture.",
            ));
        }
        let band_rows = rows.min(u32::try_from(fit).unwrap_or(u32::MAX));
        let tiles = u64::from(columns) * u64::from(band_rows);
        let uniform = BufferUsages::UNIFORM | BufferUsages::COPY_DST;
        let storage = BufferUsages::STORAGE;
        let fetched = storage | BufferUsages::COPY_SRC;
        let list = "the list of tiles";
        let band_bytes = row_bytes * u64::from(band_rows);
        let part_bytes = band_bytes.min(READBACK_BYTES);
        let mut readback = || memory.zeros("the picture", part_bytes, READBACK_USAGE);
        let mut readbacks = vec![readback()?];
        if part_bytes < band_bytes {
            readbacks.push(readback()?);
        }
        let cleared = storage | BufferUsages::COPY_DST;
        Ok(Self {
            size,
            columns,
            rows,
            band_rows,
            frame: memory.zeros("the view", size_of::<FrameParams>() as u64, uniform)?,
            tile_counts: memory.zeros(list, tiles * WORD_BYTES, cleared)?,
            tile_lists: memory.zeros(list, tiles * 2 * WORD_BYTES, fetched)?,
            list_cursors: memory.zeros(list, tiles * WORD_BYTES, fetched)?,
            pixels: pixels(memory, size, band_rows)?,
            readbacks,
        })
    }

    /// Returns `true` if the buffers hold the whole picture at once.
    pub(crate) fn is_whole(&self) -> bool {
        self.band_rows == self.rows
    }

    /// Creates a second pixel buffer.
    pub(crate) fn create_pixels(&self, memory: &mut Memory) -> Result<DeviceBuffer, RenderError> {
        pixels(memory, self.size, self.band_rows)
    }
}

fn pixels(memory: &mut Memory, size: FrameSize, rows: u32) -> Result<DeviceBuffer, RenderError> {
    let pixels = u64::from(size.width()) * u64::from(TILE_PX) * u64::from(rows);
    let usage = BufferUsages::STORAGE | BufferUsages::COPY_SRC;
    memory.zeros("the picture", pixels * WORD_BYTES, usage)
}
