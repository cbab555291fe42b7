//! Every byte that a method holds, against its budget.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use guideway_scene::{Budget, RenderError};
use wgpu::BufferUsages;

use super::Gpu;

/// What one prepared scene may hold, and what it holds.
pub struct Memory {
    gpu: Arc<Gpu>,
    method: &'static str,
    budget_bytes: u64,
    held_bytes: Arc<AtomicU64>,
    peak_bytes: u64,
}

/// A part of the budget, given back when dropped.
pub struct Held {
    bytes: u64,
    all: Arc<AtomicU64>,
}

impl Drop for Held {
    fn drop(&mut self) {
        self.all.fetch_sub(self.bytes, Ordering::Relaxed);
    }
}

/// A buffer on the device, and its part of the budget.
pub struct DeviceBuffer {
    buffer: wgpu::Buffer,
    _held: Held,
}

impl DeviceBuffer {
    /// The buffer itself.
    pub fn raw(&self) -> &wgpu::Buffer {
        &self.buffer
    }

    /// Size of the buffer in bytes.
    pub fn bytes(&self) -> u64 {
        self.buffer.size()
    }
}

impl Memory {
    /// An empty account of `method` against a budget.
    pub fn new(gpu: Arc<Gpu>, method: &'static str, budget: &Budget) -> Self {
        Self {
            gpu,
            method,
            budget_bytes: budget.memory_bytes,
            held_bytes: Arc::default(),
            peak_bytes: 0,
        }
    }

    /// Bytes held now.
    pub fn held_bytes(&self) -> u64 {
        self.held_bytes.load(Ordering::Relaxed)
    }

    /// Bytes that may yet be held.
    pub fn spare_bytes(&self) -> u64 {
        self.budget_bytes.saturating_sub(self.held_bytes())
    }

    /// Most bytes held at once since it was last asked.
    pub fn take_peak_bytes(&mut self) -> u64 {
        let held_bytes = self.held_bytes();
        std::mem::replace(&mut self.peak_bytes, held_bytes)
    }

    /// Takes a part of the budget for memory outside of the device.
    pub fn hold(&mut self, what: &'static str, bytes: u64) -> Result<Held, RenderError> {
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
        Ok(Held {
            bytes,
            all: Arc::clone(&self.held_bytes),
        })
    }

    /// A buffer of zeros.
    pub fn zeros(
        &mut self,
        what: &'static str,
        bytes: u64,
        usage: BufferUsages,
    ) -> Result<DeviceBuffer, RenderError> {
        self.allocate(what, bytes, usage, false)
    }

    /// A buffer of these values, for shaders to read. At least one.
    pub fn upload<T: bytemuck::NoUninit>(
        &mut self,
        what: &'static str,
        values: &[T],
    ) -> Result<DeviceBuffer, RenderError> {
        let bytes: &[u8] = bytemuck::cast_slice(values);
        let held = self.allocate(what, bytes.len() as u64, BufferUsages::STORAGE, true)?;
        let view = held.buffer.get_mapped_range_mut(..);
        match view {
            Ok(mut view) => view.copy_from_slice(bytes),
            Err(error) => return Err(self.trouble(format!("{what}: {error}"))),
        }
        held.buffer.unmap();
        Ok(held)
    }

    fn allocate(
        &mut self,
        what: &'static str,
        bytes: u64,
        usage: BufferUsages,
        mapped_at_creation: bool,
    ) -> Result<DeviceBuffer, RenderError> {
        let held = self.hold(what, bytes)?;
        let descriptor = wgpu::BufferDescriptor {
            label: Some(what),
            size: bytes,
            usage,
            mapped_at_creation,
        };
        let device = &self.gpu.device;
        let made = self.gpu.checked(what, || device.create_buffer(&descriptor));
        let buffer = made.map_err(|what| self.trouble(what))?;
        Ok(DeviceBuffer {
            buffer,
            _held: held,
        })
    }

    /// What the device did, as an error of the method.
    pub fn trouble(&self, what: String) -> RenderError {
        RenderError::Device {
            method: self.method,
            what,
        }
    }
}
