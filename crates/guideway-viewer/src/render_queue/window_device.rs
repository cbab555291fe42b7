//! The graphics device of the window, on which pictures of render methods can stay.

use std::sync::{Arc, OnceLock};

use eframe::egui::TextureId;
use eframe::egui_wgpu::RenderState;
use eframe::wgpu;
use guideway_scene::{DevicePicture, Prepared};

/// The device, once the window is open. Clones share it.
#[derive(Clone, Default)]
pub(crate) struct WindowDevice(Arc<OnceLock<RenderState>>);

impl WindowDevice {
    /// Sets the device of the window, once.
    pub(crate) fn set(&self, state: RenderState) {
        // A window is opened once.
        let _ = self.0.set(state);
    }

    /// Returns `true` if a method draws on this device.
    pub(super) fn is_of(&self, prepared: &dyn Prepared) -> bool {
        let device = prepared
            .device()
            .and_then(<dyn std::any::Any + Send + Sync>::downcast_ref);
        let own = self.0.get().map(|state| &state.device);
        own.is_some_and(|own| device == Some(own))
    }

    /// Lets the window paint a picture. `None` if the picture is no texture of this device.
    pub(super) fn register(&self, picture: DevicePicture) -> Option<DeviceTexture> {
        let state = self.0.get()?;
        let texture = picture.texture::<wgpu::Texture>()?;
        let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
        let filter = wgpu::FilterMode::Linear;
        let mut renderer = state.renderer.write();
        let id = renderer.register_native_texture(&state.device, &view, filter);
        Some(DeviceTexture {
            id,
            _picture: picture,
            device: self.clone(),
        })
    }
}

/// A texture of the window's device that a render method drew.
pub(crate) struct DeviceTexture {
    id: TextureId,
    /// Keeps the method from drawing into the texture.
    _picture: DevicePicture,
    device: WindowDevice,
}

impl DeviceTexture {
    /// Name of the texture for the painter.
    pub(super) fn id(&self) -> TextureId {
        self.id
    }
}

impl Drop for DeviceTexture {
    fn drop(&mut self) {
        if let Some(state) = self.device.0.get() {
            state.renderer.write().free_texture(&self.id);
        }
    }
}
