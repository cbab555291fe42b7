//! Redraws only the pixels of the window that change, where a processor draws them. Takes what
//! egui would draw, draws what differs from the last frame into a picture of the whole window, and
//! leaves that picture to egui.

mod damage_map;
mod picture;
mod pixel_rect;
mod triangles;

use std::collections::HashMap;
use std::mem;

use eframe::egui::epaint::ClippedShape;
use eframe::egui::{
    Context, FullOutput, Plugin, Pos2, Rect, TextureId, TexturesDelta, Vec2, ViewportId,
};
use eframe::egui_wgpu::{RenderState, ScreenDescriptor};
use eframe::wgpu;

use damage_map::DamageMap;
use picture::{Picture, Pictures};
use pixel_rect::PixelRect;
use triangles::FrameTriangles;

/// Stands between egui and its renderer.
pub(crate) struct PartialRedraw {
    state: RenderState,
    pictures: Pictures,
    picture: Option<Picture>,
    damage: DamageMap,
    /// Size in texels of each texture of egui.
    textures: HashMap<TextureId, [usize; 2]>,
    /// The parts of textures that changed since the last frame was drawn.
    changes: HashMap<TextureId, Rect>,
    /// Pixels that each frame drew.
    #[cfg(test)]
    pub(crate) drawn: Vec<u64>,
}

impl PartialRedraw {
    /// Draws with the renderer of egui.
    pub(crate) fn new(state: RenderState) -> Self {
        Self {
            pictures: Pictures::new(&state.device, state.target_format),
            state,
            picture: None,
            damage: DamageMap::default(),
            textures: HashMap::new(),
            changes: HashMap::new(),
            #[cfg(test)]
            drawn: Vec::new(),
        }
    }

    /// Brings the picture up to a frame.
    fn draw(&mut self, frame: &FrameTriangles, textures: &mut TexturesDelta) -> &Picture {
        self.take_textures(textures);
        let changes = mem::take(&mut self.changes);
        let picture = match self.picture.take() {
            Some(picture) if picture.size == frame.size => picture,
            _ => {
                self.damage.clear();
                self.pictures.make(frame.size)
            }
        };
        let rects = self.damage.damage(frame, &changes);
        #[cfg(test)]
        self.drawn.push(rects.iter().map(|rect| rect.area()).sum());
        if !rects.is_empty() {
            self.draw_within(frame, &rects, &picture);
        }
        let mut renderer = self.state.renderer.write();
        for id in textures.free.drain() {
            self.textures.remove(&id);
            renderer.free_texture(&id);
        }
        self.picture.insert(picture)
    }

    /// Uploads textures, and notes their changed parts.
    fn take_textures(&mut self, textures: &mut TexturesDelta) {
        self.note_changed_texels(textures);
        self.upload(textures);
    }

    /// Notes the part of each texture that a frame changes, in coordinates of the texture, with the
    /// texels beside it, which a linear filter mixes with it.
    fn note_changed_texels(&mut self, textures: &TexturesDelta) {
        for (&id, images) in &textures.set {
            for image in images {
                let size = image.image.size();
                let changed = match image.pos {
                    Some(pos) => {
                        let whole = self.textures.get(&id).copied().unwrap_or(size);
                        let whole = Vec2::new(whole[0] as f32, whole[1] as f32);
                        let min = Pos2::new(pos[0] as f32, pos[1] as f32);
                        let size = Vec2::new(size[0] as f32, size[1] as f32);
                        let texels = Rect::from_min_size(min, size).expand(1.0);
                        Rect::from_min_max(
                            (texels.min.to_vec2() / whole).to_pos2(),
                            (texels.max.to_vec2() / whole).to_pos2(),
                        )
                    }
                    None => {
                        self.textures.insert(id, size);
                        Rect::EVERYTHING
                    }
                };
                let all = self.changes.entry(id).or_insert(changed);
                *all = all.union(changed);
            }
        }
    }

    fn upload(&self, textures: &mut TexturesDelta) {
        let RenderState { device, queue, .. } = &self.state;
        let mut renderer = self.state.renderer.write();
        for (id, images) in mem::take(&mut textures.set) {
            for image in images {
                renderer.update_texture(device, queue, id, &image);
            }
        }
    }

    fn draw_within(&self, frame: &FrameTriangles, rects: &[PixelRect], picture: &Picture) {
        let RenderState { device, queue, .. } = &self.state;
        let screen = ScreenDescriptor {
            size_in_pixels: frame.size,
            pixels_per_point: frame.scale,
        };
        let parts = frame.within(rects);
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        let mut renderer = self.state.renderer.write();
        renderer.update_buffers(device, queue, &mut encoder, &parts, &screen);
        let pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("damaged parts of the window"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &picture.view,
                resolve_target: None,
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Load,
                    store: wgpu::StoreOp::Store,
                },
                depth_slice: None,
            })],
            ..wgpu::RenderPassDescriptor::default()
        });
        renderer.render(&mut pass.forget_lifetime(), &parts, &screen);
        queue.submit([encoder.finish()]);
    }
}

impl Plugin for PartialRedraw {
    fn debug_name(&self) -> &'static str {
        "partial redraw"
    }

    fn output_hook(&mut self, ctx: &Context, output: &mut FullOutput) {
        let window = ctx.input(|input| input.viewport_rect());
        let scale = output.pixels_per_point;
        let size = [window.width(), window.height()].map(|points| (points * scale).round() as u32);
        if ctx.viewport_id() != ViewportId::ROOT || size.contains(&0) {
            return;
        }
        if is_discarded(ctx, output) {
            // The next pass uses its textures.
            self.take_textures(&mut output.textures_delta);
            return;
        }
        let primitives = ctx.tessellate(mem::take(&mut output.shapes), scale);
        let frame = FrameTriangles::new(primitives, size, scale);
        let picture = self.draw(&frame, &mut output.textures_delta);
        let shape = picture.shape(window);
        output.shapes = vec![ClippedShape::new(window, shape)];
    }
}

/// Returns `true` if egui lays the frame out once more.
fn is_discarded(ctx: &Context, output: &FullOutput) -> bool {
    let output = &output.platform_output;
    let most = ctx.options(|options| options.max_passes.get());
    output.requested_discard() && output.num_completed_passes < most
}
