//! The tiles and pixels of one size of picture.

use guideway_render::{FrameSize, RenderError};
use wgpu::BufferUsages;

use super::NAME;
use super::params::{FrameParams, TILE_PX};
use crate::device::{DeviceBuffer, FETCHED, Gpu, Memory};

const WORD_BYTES: u64 = size_of::<u32>() as u64;

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
    pub(super) starts: DeviceBuffer,
    pub(super) filled: DeviceBuffer,
    pub(super) pixels: DeviceBuffer,
    pub(super) fetched: DeviceBuffer,
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
        let row_pixels = u64::from(size.width()) * u64::from(TILE_PX);
        let fit = gpu.binding_bytes() / (row_pixels * WORD_BYTES).max(1);
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
        let pixels_bytes = row_pixels * u64::from(band_rows) * WORD_BYTES;
        let uniform = BufferUsages::UNIFORM | BufferUsages::COPY_DST;
        let storage = BufferUsages::STORAGE;
        let list = "the list of tiles";
        Ok(Self {
            size,
            columns,
            rows,
            band_rows,
            frame: memory.zeros("the view", size_of::<FrameParams>() as u64, uniform)?,
            counts: memory.zeros(list, tiles * WORD_BYTES, storage | BufferUsages::COPY_DST)?,
            starts: memory.zeros(list, (tiles + 1) * WORD_BYTES, storage)?,
            filled: memory.zeros(list, tiles * WORD_BYTES, storage)?,
            pixels: memory.zeros(
                "the picture",
                pixels_bytes,
                storage | BufferUsages::COPY_SRC,
            )?,
            fetched: memory.zeros("the picture", pixels_bytes, FETCHED)?,
        })
    }
}
