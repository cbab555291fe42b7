//! Device buffers of a picture, in bands of rows that fit one binding and the budget.

use std::ops::Range;

use guideway_gpu::device::{Bindings, DeviceBuffer, Gpu, Kernel, Memory, READBACK_USAGE};
use guideway_scene::{FrameSize, RenderError};
use wgpu::BufferUsages;

use crate::chunk::Chunk;
use crate::kernels::Kernels;
use crate::params::ViewParams;
use crate::variant::NAME;

/// Bytes of a pixel: its state between passes, or its color.
pub(super) const PIXEL_BYTES: u64 = size_of::<u32>() as u64;
/// Bytes of the counters of a pixel: distance tests and cell look-ups.
const WORK_BYTES: u64 = size_of::<[u32; 2]>() as u64;

/// The result that the buffers receive.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Purpose {
    /// The color per pixel.
    Picture,
    /// The distance tests and cell look-ups per pixel.
    Work,
}

impl Purpose {
    /// The shader that computes the result.
    pub(super) fn kernel(self, kernels: &Kernels) -> &Kernel {
        match self {
            Self::Picture => &kernels.pixels,
            Self::Work => &kernels.pixels_with_counts,
        }
    }
}

/// Buffers for one size of picture.
pub(super) struct PictureBuffers {
    pub(super) size: FrameSize,
    /// Rows per band; the last may have fewer.
    band_rows: u32,
    pub(super) view: DeviceBuffer,
    pixels: DeviceBuffer,
    work: DeviceBuffer,
    pub(super) fetched: DeviceBuffer,
    /// One per chunk.
    pub(super) bindings: Vec<Bindings>,
    pub(super) purpose: Purpose,
}

impl PictureBuffers {
    /// Allocates the buffers, with the most rows per band that fit.
    ///
    /// # Errors
    /// When one row exceeds a binding of the device, or the budget.
    pub(super) fn new(
        gpu: &Gpu,
        memory: &mut Memory,
        size: FrameSize,
        purpose: Purpose,
        kernels: &Kernels,
        grid: &DeviceBuffer,
        chunks: &[Chunk],
    ) -> Result<Self, RenderError> {
        let uniform = BufferUsages::UNIFORM | BufferUsages::COPY_DST;
        let storage = BufferUsages::STORAGE | BufferUsages::COPY_SRC;
        let view = memory.zeros("the view", size_of::<ViewParams>() as u64, uniform)?;
        let (work_bytes, fetched_bytes) = match purpose {
            Purpose::Picture => (0, PIXEL_BYTES),
            Purpose::Work => (WORK_BYTES, WORK_BYTES),
        };
        let pixel_bytes = PIXEL_BYTES + work_bytes + fetched_bytes;
        let width = u64::from(size.width());
        let fit_binding = gpu.max_binding_bytes() / (width * fetched_bytes);
        let fit_budget = memory.spare_bytes().saturating_sub(WORK_BYTES) / (width * pixel_bytes);
        if fit_binding == 0 {
            return Err(RenderError::unsupported(
                NAME,
                format!(
                    "rows of {width} pixels: a shader of this device can bind at most {} bytes",
                    gpu.max_binding_bytes()
                ),
                "Render a narrower picture.",
            ));
        }
        // When the budget holds no row, the allocation of one row fails and names the needed bytes.
        let rows = fit_binding.min(fit_budget.max(1)).min(size.height().into());
        let pixels = width * rows;
        let pixel_buffer = memory.zeros("the pixels", pixels * PIXEL_BYTES, storage)?;
        // A buffer cannot be empty.
        let work = (pixels * work_bytes).max(WORK_BYTES);
        let work = memory.zeros("the counted work", work, storage)?;
        let fetched = memory.zeros(
            "the picture read back",
            pixels * fetched_bytes,
            READBACK_USAGE,
        )?;
        let kernel = purpose.kernel(kernels);
        let bind = |chunk: &Chunk| {
            let buffers = [
                &view,
                grid,
                &chunk.starts,
                &chunk.counts,
                &chunk.lists_m,
                &pixel_buffer,
                &work,
            ];
            kernel.bind(gpu, &buffers)
        };
        let bindings: Result<_, _> = chunks.iter().map(bind).collect();
        Ok(Self {
            bindings: bindings.map_err(|error| memory.device_error(&error))?,
            size,
            band_rows: rows as u32,
            view,
            pixels: pixel_buffer,
            work,
            fetched,
            purpose,
        })
    }

    /// The rows of each band, from the top.
    pub(super) fn bands(&self) -> impl ExactSizeIterator<Item = Range<u32>> + use<> {
        let (rows, height) = (self.band_rows, self.size.height());
        (0..height.div_ceil(rows)).map(move |band| {
            let first = band * rows;
            first..height.min(first + rows)
        })
    }

    /// The buffer to read back after each band, and its bytes per row.
    pub(super) fn result(&self) -> (&DeviceBuffer, u64) {
        let width = u64::from(self.size.width());
        match self.purpose {
            Purpose::Picture => (&self.pixels, width * PIXEL_BYTES),
            Purpose::Work => (&self.work, width * WORK_BYTES),
        }
    }
}
