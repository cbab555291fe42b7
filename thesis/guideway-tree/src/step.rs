//! Steps of a build: kernels with their buffers, and those that sort keys with their segments.
//!
//! Input: the account of a scene, buffers. Output: steps that a submission runs in their order.

use guideway_gpu::device::{
    Bindings, DeviceBuffer, DeviceError, Dispatch, Gpu, Kernel, Memory, Runner,
};
use guideway_grid::per_pixel::SCAN_THREADS;
use guideway_scene::RenderError;
use wgpu::BufferUsages;

use crate::params::{DIGIT_BITS, DigitParams, KEY_DIGITS, SORT_THREADS, Variant};

pub(super) const WORD: u64 = size_of::<u32>() as u64;

/// The device, and the account of the scene that builds on it.
pub(super) struct Builder<'a> {
    pub(super) variant: &'a Variant,
    pub(super) memory: &'a mut Memory,
    pub(super) runner: &'a Runner,
}

/// A kernel with its buffers.
pub(super) struct Step {
    kernel: Kernel,
    bindings: Bindings,
    workgroups: u32,
}

impl Step {
    pub(super) fn dispatch(&self) -> Dispatch<'_> {
        Dispatch {
            kernel: &self.kernel,
            bindings: &self.bindings,
            workgroups: self.workgroups,
        }
    }
}

pub(super) fn dispatches(steps: &[Step]) -> Vec<Dispatch<'_>> {
    steps.iter().map(Step::dispatch).collect()
}

/// Buffers and steps that sort keys with their segments.
pub(super) struct Sorter {
    /// Sorted after the steps.
    pub(super) keys: DeviceBuffer,
    pub(super) steps: Vec<Step>,
    _scratch: Vec<DeviceBuffer>,
}

impl Builder<'_> {
    pub(super) fn gpu(&self) -> &Gpu {
        &self.variant.gpu
    }

    pub(super) fn storage(
        &mut self,
        what: &'static str,
        bytes: u64,
    ) -> Result<DeviceBuffer, RenderError> {
        let usage = BufferUsages::STORAGE | BufferUsages::COPY_SRC | BufferUsages::COPY_DST;
        self.memory.zeros(what, bytes.max(WORD), usage)
    }

    pub(super) fn upload<T: bytemuck::NoUninit>(
        &mut self,
        what: &'static str,
        values: &[T],
    ) -> Result<DeviceBuffer, RenderError> {
        let buffer = self.storage(what, size_of_val(values) as u64)?;
        self.ok(self.runner.write_at(what, &buffer, 0, values))?;
        Ok(buffer)
    }

    pub(super) fn uniform<T: bytemuck::NoUninit>(
        &mut self,
        what: &'static str,
        value: &T,
    ) -> Result<DeviceBuffer, RenderError> {
        let usage = BufferUsages::UNIFORM | BufferUsages::COPY_DST;
        let buffer = self.memory.zeros(what, size_of::<T>() as u64, usage)?;
        self.ok(self.runner.write(what, &buffer, value))?;
        Ok(buffer)
    }

    pub(super) fn step(
        &self,
        kernel: &Kernel,
        buffers: &[&DeviceBuffer],
        workgroups: u32,
    ) -> Result<Step, RenderError> {
        Ok(Step {
            kernel: kernel.clone(),
            bindings: self.ok(kernel.bind(self.gpu(), buffers))?,
            workgroups,
        })
    }

    pub(super) fn ok<R>(&self, result: Result<R, DeviceError>) -> Result<R, RenderError> {
        result.map_err(|error| self.memory.device_error(&error))
    }

    /// Steps that sort `keys` and `order` in place, digit by digit.
    pub(super) fn sorter(
        &mut self,
        keys: DeviceBuffer,
        order: &DeviceBuffer,
        leaves: u32,
    ) -> Result<Sorter, RenderError> {
        let blocks = leaves.div_ceil(SORT_THREADS);
        let counts = blocks << DIGIT_BITS;
        let scanned = counts.div_ceil(2 * SCAN_THREADS);
        let what = "the buffers of the sort";
        let other_keys = self.storage(what, u64::from(leaves) * WORD)?;
        let other_order = self.storage(what, u64::from(leaves) * WORD)?;
        let counted = self.storage(what, u64::from(counts) * WORD)?;
        let starts = self.storage(what, u64::from(counts) * WORD)?;
        let sums = self.storage(what, u64::from(scanned) * WORD)?;
        let mut scratch = Vec::new();
        let mut steps = Vec::new();
        let kernels = &self.variant.kernels;
        let ways = [
            [&keys, order, &other_keys, &other_order],
            [&other_keys, &other_order, &keys, order],
        ];
        for digit in 0..KEY_DIGITS {
            let params = DigitParams {
                keys: leaves,
                shift: digit * DIGIT_BITS,
                blocks,
            };
            let uniform = self.uniform(what, &params)?;
            let [keys, order, to_keys, to_order] = ways[digit as usize % 2];
            let buffers = |blocks| [&uniform, keys, order, blocks, to_keys, to_order];
            let [scan_blocks, scan_sums, add_sums] = &kernels.scan;
            steps.extend([
                self.step(&kernels.count_digits, &buffers(&counted), blocks)?,
                self.step(scan_blocks, &[&counted, &starts, &sums], scanned)?,
                self.step(scan_sums, &[&sums], 1)?,
                self.step(add_sums, &[&starts, &sums], scanned)?,
                self.step(&kernels.move_keys, &buffers(&starts), blocks)?,
            ]);
            scratch.push(uniform);
        }
        scratch.extend([other_keys, other_order, counted, starts, sums]);
        Ok(Sorter {
            keys,
            steps,
            _scratch: scratch,
        })
    }
}
