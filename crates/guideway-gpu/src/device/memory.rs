//! Charges every byte of a prepared scene to its memory budget.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use guideway_scene::{Budget, RenderError};
use wgpu::BufferUsages;

use super::error::DeviceError;
use super::gpu::Gpu;

/// The memory account of one prepared scene.
pub struct Memory {
    gpu: Arc<Gpu>,
    method: &'static str,
    budget_bytes: u64,
    held_bytes: Arc<AtomicU64>,
    peak_bytes: u64,
}

/// A share of the budget, returned when dropped.
pub struct Reservation {
    bytes: u64,
    held_bytes: Arc<AtomicU64>,
}

impl Drop for Reservation {
    fn drop(&mut self) {
        self.held_bytes.fetch_sub(self.bytes, Ordering::Relaxed);
    }
}

/// A buffer on the device and its share of the budget.
pub struct DeviceBuffer {
    buffer: wgpu::Buffer,
    _reservation: Reservation,
}

impl DeviceBuffer {
    /// The wgpu buffer.
    pub fn raw(&self) -> &wgpu::Buffer {
        &self.buffer
    }

    /// Size of the buffer in bytes.
    pub fn bytes(&self) -> u64 {
        self.buffer.size()
    }
}

impl Memory {
    /// Opens an empty account of `method`.
    pub fn new(gpu: Arc<Gpu>, method: &'static str, budget: &Budget) -> Self {
        Self {
            gpu,
            method,
            budget_bytes: budget.memory_bytes,
            held_bytes: Arc::default(),
            peak_bytes: 0,
        }
    }

    /// Bytes in use.
    pub fn held_bytes(&self) -> u64 {
        self.held_bytes.load(Ordering::Relaxed)
    }

    /// Bytes left in the budget.
    pub fn spare_bytes(&self) -> u64 {
        self.budget_bytes.saturating_sub(self.held_bytes())
    }

    /// Returns the most bytes in use at once since the last call.
    pub fn take_peak_bytes(&mut self) -> u64 {
        let held_bytes = self.held_bytes();
        std::mem::replace(&mut self.peak_bytes, held_bytes)
    }

    /// Reserves a share of the budget for memory of the host.
    ///
    /// # Errors
    /// [`RenderError::Budget`] if the budget is too small.
    pub fn reserve(&mut self, what: &'static str, bytes: u64) -> Result<Reservation, RenderError> {
        let needed_bytes = self.held_bytes().saturating_add(bytes);
        if needed_bytes > self.budget_bytes {
            return Err(RenderError::Budget {
                method: self.method,
                what,
                needed_bytes,
                budget_bytes: self.budget_bytes,
            });
        }
        self.held_bytes.store(needed_bytes, Ordering::Relaxed);
        self.peak_bytes = self.peak_bytes.max(needed_bytes);
        Ok(Reservation {
            bytes,
            held_bytes: Arc::clone(&self.held_bytes),
        })
    }

    /// Creates a buffer of zeros.
    ///
    /// # Errors
    /// [`RenderError::Budget`] if the budget is too small; any error of the device.
    pub fn zeros(
        &mut self,
        what: &'static str,
        bytes: u64,
        usage: BufferUsages,
    ) -> Result<DeviceBuffer, RenderError> {
        let reservation = self.reserve(what, bytes)?;
        let descriptor = wgpu::BufferDescriptor {
            label: Some(what),
            size: bytes,
            usage,
            mapped_at_creation: false,
        };
        let device = &self.gpu.device;
        let created = self.gpu.checked(what, || device.create_buffer(&descriptor));
        let buffer = created.map_err(|error| self.device_error(&error))?;
        Ok(DeviceBuffer {
            buffer,
            _reservation: reservation,
        })
    }

    /// Replaces a buffer by a larger one with its contents, and zeros behind them. The copy is made
    /// on the device, after all writes to the old buffer.
    ///
    /// # Errors
    /// As [`Self::zeros`].
    pub(crate) fn grow(
        &mut self,
        what: &'static str,
        buffer: &mut DeviceBuffer,
        bytes: u64,
    ) -> Result<(), RenderError> {
        let larger = self.zeros(what, bytes, buffer.raw().usage())?;
        let copied = self.gpu.checked(what, || {
            let descriptor = wgpu::CommandEncoderDescriptor { label: Some(what) };
            let mut encoder = self.gpu.device.create_command_encoder(&descriptor);
            encoder.copy_buffer_to_buffer(buffer.raw(), 0, larger.raw(), 0, buffer.bytes());
            self.gpu.queue.submit([encoder.finish()]);
        });
        copied.map_err(|error| self.device_error(&error))?;
        *buffer = larger;
        Ok(())
    }

    /// Creates a storage buffer of these values; at least one. All threads copy them.
    ///
    /// # Errors
    /// As [`Self::zeros`].
    pub fn upload<T: bytemuck::NoUninit>(
        &mut self,
        what: &'static str,
        values: &[T],
    ) -> Result<DeviceBuffer, RenderError> {
        self.upload_parts(what, &[bytemuck::cast_slice(values)], 0)
    }

    /// As [`Self::upload`], of parts back to back, of whole words, and zeros up to `least_bytes`.
    pub(crate) fn upload_parts(
        &mut self,
        what: &'static str,
        parts: &[&[u8]],
        least_bytes: u64,
    ) -> Result<DeviceBuffer, RenderError> {
        let bytes = parts.iter().map(|part| part.len() as u64).sum::<u64>();
        let bytes = bytes.max(least_bytes);
        let usage = BufferUsages::STORAGE | BufferUsages::COPY_DST | BufferUsages::COPY_SRC;
        let created = self.zeros(what, bytes, usage)?;
        // A buffer that is mapped when it is created gets zeros first.
        let written = self.gpu.write_parts(what, created.raw(), 0, parts);
        written.map_err(|error| self.device_error(&error))?;
        Ok(created)
    }

    /// Converts an error of the device to one of the method.
    pub fn device_error(&self, error: &DeviceError) -> RenderError {
        error.of_method(self.method)
    }
}
