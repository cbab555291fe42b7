use std::rc::Rc;

use bytemuck::Pod;
use glow::HasContext;

use super::Gl;

/// Memory of the device.
pub(crate) struct Buffer {
    gl: Rc<Gl>,
    name: glow::Buffer,
    bytes: u64,
}

impl Buffer {
    /// A buffer of `bytes` bytes, at least one; `what` names it in an error.
    pub(crate) fn new(gl: &Rc<Gl>, what: &str, bytes: u64) -> Result<Self, String> {
        let size = i32::try_from(bytes)
            .map_err(|_| format!("{bytes} bytes of {what} are more than one buffer holds"))?;
        // SAFETY: without data there is no host memory to read.
        let name = unsafe {
            let name = gl.raw.create_named_buffer()?;
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

    /// A buffer that holds `data`.
    pub(crate) fn of<T: Pod>(gl: &Rc<Gl>, what: &str, data: &T) -> Result<Self, String> {
        let buffer = Self::new(gl, what, size_of::<T>() as u64)?;
        buffer.write(0, std::slice::from_ref(data));
        Ok(buffer)
    }

    /// Size.
    pub(crate) fn bytes(&self) -> u64 {
        self.bytes
    }

    /// Writes `data` from item `first` on.
    ///
    /// # Panics
    /// When it does not fit.
    pub(crate) fn write<T: Pod>(&self, first: usize, data: &[T]) {
        let offset = first * size_of::<T>();
        let bytes: &[u8] = bytemuck::cast_slice(data);
        assert!((offset + bytes.len()) as u64 <= self.bytes);
        unsafe {
            self.gl
                .raw
                .named_buffer_sub_data_u8_slice(self.name, offset as i32, bytes);
        }
    }

    /// Reads the first `data.len()` items; waits for what writes them.
    ///
    /// # Panics
    /// When there are not so many.
    pub(crate) fn read<T: Pod>(&self, data: &mut [T]) {
        let bytes: &mut [u8] = bytemuck::cast_slice_mut(data);
        assert!(bytes.len() as u64 <= self.bytes);
        self.bind(glow::COPY_READ_BUFFER);
        unsafe {
            self.gl
                .raw
                .get_buffer_sub_data(glow::COPY_READ_BUFFER, 0, bytes);
        }
    }

    /// Binds it to a storage block.
    pub(crate) fn bind_storage(&self, binding: u32) {
        unsafe {
            self.gl
                .raw
                .bind_buffer_base(glow::SHADER_STORAGE_BUFFER, binding, Some(self.name));
        }
    }

    /// Binds it to a uniform block.
    pub(crate) fn bind_uniform(&self, binding: u32) {
        unsafe {
            self.gl
                .raw
                .bind_buffer_base(glow::UNIFORM_BUFFER, binding, Some(self.name));
        }
    }

    pub(super) fn bind(&self, target: u32) {
        unsafe { self.gl.raw.bind_buffer(target, Some(self.name)) };
    }

    pub(super) fn name(&self) -> glow::Buffer {
        self.name
    }
}

impl Drop for Buffer {
    fn drop(&mut self) {
        unsafe { self.gl.raw.delete_buffer(self.name) };
    }
}
