//! The picture of the window, as the last frame left it, and its way to the screen.

use eframe::egui::{PaintCallbackInfo, Rect, Shape};
use eframe::egui_wgpu::{Callback, CallbackResources, CallbackTrait};
use eframe::wgpu;

/// Makes pictures for one device and format.
pub(super) struct Pictures {
    device: wgpu::Device,
    format: wgpu::TextureFormat,
    copy: wgpu::RenderPipeline,
}

/// All pixels of the window.
pub(super) struct Picture {
    pub(super) view: wgpu::TextureView,
    pub(super) size: [u32; 2],
    copy: Copy,
}

/// Copies a picture to the screen. The shader of egui would take ten times as long.
#[derive(Clone)]
struct Copy {
    pipeline: wgpu::RenderPipeline,
    picture: wgpu::BindGroup,
}

impl Pictures {
    pub(super) fn new(device: &wgpu::Device, format: wgpu::TextureFormat) -> Self {
        let module = device.create_shader_module(wgpu::include_wgsl!("copy.wgsl"));
        let copy = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some("copy of the window"),
            layout: None,
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some("corner"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                buffers: &[],
            },
            primitive: wgpu::PrimitiveState::default(),
            depth_stencil: None,
            multisample: wgpu::MultisampleState::default(),
            fragment: Some(wgpu::FragmentState {
                module: &module,
                entry_point: Some("copy"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                targets: &[Some(format.into())],
            }),
            multiview_mask: None,
            cache: None,
        });
        Self {
            device: device.clone(),
            format,
            copy,
        }
    }

    /// A picture of `size` in pixels, whose content is undefined.
    pub(super) fn make(&self, size: [u32; 2]) -> Picture {
        let [width, height] = size;
        let texture = self.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("window"),
            size: wgpu::Extent3d {
                width,
                height,
                depth_or_array_layers: 1,
            },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: self.format,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING,
            view_formats: &[],
        });
        let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
        let picture = self.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("picture of the window"),
            layout: &self.copy.get_bind_group_layout(0),
            entries: &[wgpu::BindGroupEntry {
                binding: 0,
                resource: wgpu::BindingResource::TextureView(&view),
            }],
        });
        Picture {
            view,
            size,
            copy: Copy {
                pipeline: self.copy.clone(),
                picture,
            },
        }
    }
}

impl Picture {
    /// The shape that shows the picture in a window of these points.
    pub(super) fn shape(&self, window: Rect) -> Shape {
        Callback::new_paint_callback(window, self.copy.clone()).into()
    }
}

impl CallbackTrait for Copy {
    fn paint(
        &self,
        _info: PaintCallbackInfo,
        pass: &mut wgpu::RenderPass<'static>,
        _resources: &CallbackResources,
    ) {
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &self.picture, &[]);
        pass.draw(0..3, 0..1);
    }
}
