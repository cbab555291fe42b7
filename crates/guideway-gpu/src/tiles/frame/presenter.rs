//! Writes finished pixels to a texture that a caller on the same device shows.

use std::ops::Range;
use std::sync::Arc;

use guideway_scene::{FrameSize, RenderError};
use wgpu::{BufferUsages, Texture, TextureDescriptor, TextureFormat, TextureUsages};

use crate::device::{DeviceBuffer, DeviceError, Dispatch, Gpu, Kernel, Reservation};
use crate::tiles::constants::CLUSTER_THREADS;
use crate::tiles::device_context::{DeviceContext, device_error};
use crate::tiles::layouts::PresentParams;

/// Bytes per pixel of a texture.
const PIXEL_BYTES: u64 = 4;

/// The textures of one scene. A caller shows one while the next is drawn, so there are two, or
/// three where the caller is slow.
pub(crate) struct Presenter {
    kernel: Kernel,
    params: DeviceBuffer,
    textures: Vec<PresentTexture>,
}

struct PresentTexture {
    texture: Arc<Texture>,
    size: FrameSize,
    _reservation: Reservation,
}

impl Presenter {
    pub(crate) fn new(kernel: Kernel, device: &mut DeviceContext) -> Result<Self, RenderError> {
        let usage = BufferUsages::UNIFORM | BufferUsages::COPY_DST;
        let bytes = size_of::<PresentParams>() as u64;
        Ok(Self {
            kernel,
            params: device.memory.zeros("the view", bytes, usage)?,
            textures: Vec::new(),
        })
    }

    /// A texture of this size that nobody shows.
    pub(crate) fn texture(
        &mut self,
        device: &mut DeviceContext,
        size: FrameSize,
    ) -> Result<Arc<Texture>, RenderError> {
        let is_shown = |own: &PresentTexture| Arc::strong_count(&own.texture) > 1;
        self.textures
            .retain(|own| own.size == size || is_shown(own));
        let mut own = self.textures.iter();
        if let Some(free) = own.find(|own| own.size == size && !is_shown(own)) {
            return Ok(Arc::clone(&free.texture));
        }
        let what = "the picture";
        let bytes = size.pixels() as u64 * PIXEL_BYTES;
        let reservation = device.memory.reserve(what, bytes)?;
        let texture = Arc::new(create_texture(&device.gpu, size).map_err(device_error)?);
        self.textures.push(PresentTexture {
            texture: Arc::clone(&texture),
            size,
            _reservation: reservation,
        });
        Ok(texture)
    }

    #[cfg(test)]
    pub(crate) fn texture_count(&self) -> usize {
        self.textures.len()
    }

    /// Writes the first pixels of a buffer, which are these of the picture, without waiting.
    pub(crate) fn present(
        &self,
        device: &DeviceContext,
        buffer: &DeviceBuffer,
        pixels: Range<usize>,
        texture: &Texture,
    ) -> Result<(), RenderError> {
        let params = PresentParams {
            width_px: texture.width(),
            first_pixel: pixels.start as u32,
            pixels: pixels.len() as u32,
            unused: 0,
        };
        let run = || {
            device.runner.write("the view", &self.params, &params)?;
            let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
            let buffers = [&self.params, buffer];
            let bindings = self
                .kernel
                .bind_with_texture(&device.gpu, &buffers, &view)?;
            let dispatch = Dispatch {
                kernel: &self.kernel,
                bindings: &bindings,
                workgroups: params.pixels.div_ceil(CLUSTER_THREADS),
            };
            device.runner.start("the picture", &[dispatch])
        };
        run().map_err(device_error)
    }
}

fn create_texture(gpu: &Gpu, size: FrameSize) -> Result<Texture, DeviceError> {
    let descriptor = TextureDescriptor {
        label: Some("the picture"),
        size: wgpu::Extent3d {
            width: size.width(),
            height: size.height(),
            depth_or_array_layers: 1,
        },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: TextureFormat::Rgba8Unorm,
        usage: TextureUsages::STORAGE_BINDING
            | TextureUsages::TEXTURE_BINDING
            | TextureUsages::COPY_SRC,
        view_formats: &[],
    };
    gpu.checked("the picture", || gpu.device().create_texture(&descriptor))
}
