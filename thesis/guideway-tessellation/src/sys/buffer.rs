//! Buffers in the memory of the device: allocation, writes, reads and bindings.

use std::rc::Rc;

use bytemuck::Pod;
use glow::HasContext;

use super::Gl;
use crate::error::GlError;

/// A buffer in the memory of the device.
pub(crate) struct Buffer {
    gl: Rc<Gl>,
    name: glow::Buffer,
    bytes: u64,
}

impl Buffer {
    /// Allocates a buffer of `bytes` bytes, at least one; `what` names it in an error.
    ///
    /// # Errors
    /// When the size exceeds one buffer, or the device is out of memory.
    pub(crate) fn new(gl: &Rc<Gl>, what: &str, bytes: u64) -> Result<Self, GlError> {
        let size = i32::try_from(bytes).map_err(|_| GlError::BufferTooLarge {
            buffer: what.to_owned(),
            bytes,
        })?;
        // SAFETY: without data the call reads no host memory.
        let name = unsafe {
            let name = gl
                .raw
                .create_named_buffer()
                .map_err(GlError::create("buffer"))?;
            gl.raw
                .named_buffer_storage(name, size, None, glow::DYNAMIC_STORAGE_BIT);
            name
        };
        let buffer = Self {
            gl: Rc::clone(gl),
            name,
            bytes,
        };
        gl.check_allocation(what, bytes)?;
        Ok(buffer)
    }

    /// Allocates a buffer that holds `data`.
    pub(crate) fn of<T: Pod>(gl: &Rc<Gl>, what: &str, data: &T) -> Result<Self, GlError> {
        let buffer = Self::new(gl, what, size_of::<T>() as u64)?;
        buffer.write(0, std::slice::from_ref(data));
        Ok(buffer)
    }

    /// Size in bytes.
    pub(crate) fn bytes(&self) -> u64 {
        self.bytes
    }

    /// Writes `data` to item `first` and the following ones.
    ///
    /// # Panics
    /// When the data exceeds the buffer.
    pub(crate) fn write<T: Pod>(&self, first: usize, data: &[T]) {
        let offset = first * size_of::<T>();
        let bytes: &[u8] = bytemuck::cast_slice(data);
        assert!((offset + bytes.len()) as u64 <= self.bytes);
        // SAFETY: the assertion keeps the bytes within the buffer.
        unsafe {
            self.gl
                .raw
                .named_buffer_sub_data_u8_slice(self.name, offset as i32, bytes);
        }
    }

    /// Reads the first `data.len()` items. Waits for pending writes.
    ///
    /// # Panics
    /// When the buffer has fewer items.
    pub(crate) fn read<T: Pod>(&self, data: &mut [T]) {
        let bytes: &mut [u8] = bytemuck::cast_slice_mut(data);
        assert!(bytes.len() as u64 <= self.bytes);
        self.bind(glow::COPY_READ_BUFFER);
        // SAFETY: the assertion keeps the bytes within the buffer, which is bound.
        unsafe {
            self.gl
                .raw
                .get_buffer_sub_data(glow::COPY_READ_BUFFER, 0, bytes);
        }
    }

    /// Binds the buffer to a storage block.
    pub(crate) fn bind_storage(&self, binding: u32) {
        // SAFETY: the object belongs to this context, which is current; no memory of the host is
        // passed.
        unsafe {
            self.gl
                .raw
                .bind_buffer_base(glow::SHADER_STORAGE_BUFFER, binding, Some(self.name));
        }
    }

    /// Binds the buffer to a uniform block.
    pub(crate) fn bind_uniform(&self, binding: u32) {
        // SAFETY: the object belongs to this context, which is current; no memory of the host is
        // passed.
        unsafe {
            self.gl
                .raw
                .bind_buffer_base(glow::UNIFORM_BUFFER, binding, Some(self.name));
        }
    }

    pub(super) fn bind(&self, target: u32) {
        // SAFETY: the object belongs to this context, which is current; no memory of the host is
        // passed.
        unsafe { self.gl.raw.bind_buffer(target, Some(self.name)) };
    }

    pub(super) fn name(&self) -> glow::Buffer {
        self.name
    }
}

impl Drop for Buffer {
    fn drop(&mut self) {
        // SAFETY: the object belongs to this context, and nothing uses it afterwards.
        unsafe { self.gl.raw.delete_buffer(self.name) };
    }
}
