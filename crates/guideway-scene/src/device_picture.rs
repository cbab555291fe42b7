//! A picture in the memory of a graphics device, for a program that shares the device.

use std::any::Any;
use std::fmt;
use std::sync::Arc;

/// An object of a graphics library, such as a `wgpu::Device`. This crate names no such library.
type DeviceObject = Arc<dyn Any + Send + Sync>;

/// A finished picture as a texture: RGBA of 8 bits per channel with premultiplied alpha, of the
/// size of its view. The method may draw into the texture again once all clones are dropped.
#[derive(Clone)]
pub struct DevicePicture(DeviceObject);

impl DevicePicture {
    /// A picture in a texture of this type, such as `wgpu::Texture`.
    pub fn new<T: Send + Sync + 'static>(texture: Arc<T>) -> Self {
        Self(texture)
    }

    /// The texture; `None` if it has another type.
    pub fn texture<T: Send + Sync + 'static>(&self) -> Option<&T> {
        self.0.downcast_ref()
    }
}

impl fmt::Debug for DevicePicture {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("DevicePicture")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn returns_the_texture_only_as_its_type() {
        let picture = DevicePicture::new(Arc::new(7_u32));
        assert_eq!(picture.texture::<u32>(), Some(&7));
        assert_eq!(picture.texture::<i32>(), None);
    }
}
