//! Device buffers of a picture, in bands of rows that fit one binding and the budget.

use std::ops::Range;

use guideway_gpu::device::{Bindings, DeviceBuffer, DeviceError, Gpu, Memory, READBACK_USAGE};
use guideway_scene::{FrameSize, RenderError};
use wgpu::BufferUsages;

/// Bytes of a color.
pub const PIXEL_BYTES: u64 = size_of::<u32>() as u64;

/// The result that the buffers receive.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Purpose {
    /// The color per pixel.
    Picture,
    /// The counted work per pixel.
    Work,
}

/// Size of a picture, and what its buffers hold per pixel.
#[derive(Clone, Copy, Debug)]
pub struct PictureLayout {
    /// Size of the picture.
    pub size: FrameSize,
    /// The result to read back.
    pub purpose: Purpose,
    /// Bytes of the uniform buffer of the view.
    pub view_bytes: u64,
    /// Bytes per pixel of its color and of its state between passes.
    pub state_bytes: u64,
    /// Bytes per pixel of its counters.
    pub work_bytes: u64,
}

impl PictureLayout {
    fn fetched_bytes(&self) -> u64 {
        match self.purpose {
            Purpose::Picture => PIXEL_BYTES,
            Purpose::Work => self.work_bytes,
        }
    }
}

/// Buffers for one size of picture.
pub struct PictureBuffers {
    /// Sizes per pixel.
    pub layout: PictureLayout,
    /// Rows per band; the last may have fewer.
    band_rows: u32,
    /// The uniform of the view.
    pub view: DeviceBuffer,
    pixels: DeviceBuffer,
    work: DeviceBuffer,
    /// Receives the result.
    pub fetched: DeviceBuffer,
    /// One per chunk.
    pub bindings: Vec<Bindings>,
}

impl PictureBuffers {
    /// Allocates the buffers, with the most rows per band that fit, and binds the view, the pixels
    /// and the counters.
    ///
    /// # Errors
    /// When one row exceeds a binding of the device, or the budget.
    pub fn new(
        gpu: &Gpu,
        memory: &mut Memory,
        method: &'static str,
        layout: PictureLayout,
        bind: impl FnOnce(&[&DeviceBuffer; 3]) -> Result<Vec<Bindings>, DeviceError>,
    ) -> Result<Self, RenderError> {
        let uniform = BufferUsages::UNIFORM | BufferUsages::COPY_DST;
        let storage = BufferUsages::STORAGE | BufferUsages::COPY_SRC;
        let view = memory.zeros("the view", layout.view_bytes, uniform)?;
        let (state_bytes, work_bytes) = (layout.state_bytes, layout.work_bytes);
        let fetched_bytes = layout.fetched_bytes();
        let pixel_bytes = state_bytes + work_bytes + fetched_bytes;
        let width = u64::from(layout.size.width());
        let largest = state_bytes.max(work_bytes);
        let fit_binding = gpu.max_binding_bytes() / (width * largest);
        // A buffer cannot be empty.
        let fit_budget = memory.spare_bytes().saturating_sub(2 * PIXEL_BYTES);
        let fit_budget = fit_budget / (width * pixel_bytes);
        if fit_binding == 0 {
            return Err(RenderError::unsupported(
                method,
                format!(
                    "rows of {width} pixels: a shader of this device can bind at most {} bytes",
                    gpu.max_binding_bytes()
                ),
                "Render a narrower picture.",
            ));
        }
        // When the budget holds no row, the allocation of one row fails and names the needed bytes.
        let height = u64::from(layout.size.height());
        let rows = fit_binding.min(fit_budget.max(1)).min(height);
        let count = width * rows;
        let pixels = memory.zeros("the pixels", count * state_bytes, storage)?;
        let work = (count * work_bytes).max(2 * PIXEL_BYTES);
        let work = memory.zeros("the counted work", work, storage)?;
        let fetched = count * fetched_bytes;
        let fetched = memory.zeros("the picture read back", fetched, READBACK_USAGE)?;
        let bindings = bind(&[&view, &pixels, &work]);
        Ok(Self {
            bindings: bindings.map_err(|error| memory.device_error(&error))?,
            layout,
            band_rows: rows as u32,
            view,
            pixels,
            work,
            fetched,
        })
    }

    /// The rows of each band, from the top.
    pub fn bands(&self) -> impl ExactSizeIterator<Item = Range<u32>> + use<> {
        let (rows, height) = (self.band_rows, self.layout.size.height());
        (0..height.div_ceil(rows)).map(move |band| {
            let first = band * rows;
            first..height.min(first + rows)
        })
    }

    /// The buffer to read back after each band, and its bytes per row.
    pub fn result(&self) -> (&DeviceBuffer, u64) {
        let row_bytes = u64::from(self.layout.size.width()) * self.layout.fetched_bytes();
        match self.layout.purpose {
            Purpose::Picture => (&self.pixels, row_bytes),
            Purpose::Work => (&self.work, row_bytes),
        }
    }
}
