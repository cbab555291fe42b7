//! The window drawn in parts and as a whole, on a graphics device: each frame shows the same bits.

use std::sync::{Arc, Mutex};

use eframe::egui::mutex::RwLock;
use eframe::egui::{
    ClippedPrimitive, Context, Event, FullOutput, Key, Modifiers, Plugin, Pos2, Vec2,
};
use eframe::egui_wgpu::{
    RenderState, Renderer, RendererOptions, ScreenDescriptor, WgpuConfiguration,
};
use eframe::wgpu;

use super::services::{TestServices, lanes};
use super::test_window::TestWindow;
use crate::panels::SideTab;
use crate::partial_redraw::PartialRedraw;

const NONE: Modifiers = Modifiers::NONE;
const CTRL: Modifiers = Modifiers::COMMAND;

/// Draws each frame as a whole and in parts.
struct Both {
    whole: RenderState,
    in_parts: RenderState,
    redraw: PartialRedraw,
    frames: Arc<Mutex<Frames>>,
}

/// The pixels that the frames showed.
#[derive(Default)]
struct Frames {
    count: usize,
    /// The frames whose pictures differ, and by how many pixels.
    differing: Vec<(usize, usize)>,
    /// The share of the window that each frame drew.
    drawn: Vec<f64>,
    /// Layouts that egui made once more, of which nothing was drawn.
    discarded: usize,
    /// The last picture in parts.
    picture: Vec<u8>,
}

/// A device without a window. `None` if this computer has none.
fn device() -> Option<RenderState> {
    let config = WgpuConfiguration::default();
    let options = RendererOptions {
        dithering: false,
        ..RendererOptions::default()
    };
    pollster::block_on(async {
        let instance = config.wgpu_setup.new_instance().await;
        let mut state = RenderState::create(&config, &instance, None, options)
            .await
            .ok()?;
        state.target_format = wgpu::TextureFormat::Bgra8Unorm;
        Some(with_own_renderer(&state))
    })
}

fn with_own_renderer(state: &RenderState) -> RenderState {
    let options = RendererOptions {
        dithering: false,
        ..RendererOptions::default()
    };
    let renderer = Renderer::new(&state.device, state.target_format, options);
    RenderState {
        renderer: Arc::new(RwLock::new(renderer)),
        ..state.clone()
    }
}

/// Shows a frame as eframe does. Returns the pixels.
fn present(state: &RenderState, ctx: &Context, output: &mut FullOutput) -> Vec<u8> {
    let scale = output.pixels_per_point;
    let primitives = ctx.tessellate(std::mem::take(&mut output.shapes), scale);
    let mut renderer = state.renderer.write();
    for (id, images) in std::mem::take(&mut output.textures_delta.set) {
        for image in images {
            renderer.update_texture(&state.device, &state.queue, id, &image);
        }
    }
    let window = ctx.input(|input| input.viewport_rect()).size() * scale;
    let size = [window.x.round() as u32, window.y.round() as u32];
    let pixels = pixels(state, &mut renderer, &primitives, size, scale);
    for id in output.textures_delta.free.drain() {
        renderer.free_texture(&id);
    }
    pixels
}

fn pixels(
    RenderState { device, queue, .. }: &RenderState,
    renderer: &mut Renderer,
    primitives: &[ClippedPrimitive],
    [width, height]: [u32; 2],
    pixels_per_point: f32,
) -> Vec<u8> {
    let size = wgpu::Extent3d {
        width,
        height,
        depth_or_array_layers: 1,
    };
    let texture = device.create_texture(&wgpu::TextureDescriptor {
        label: None,
        size,
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Bgra8Unorm,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
        view_formats: &[],
    });
    let row = (width * 4).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
    let buffer = device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: u64::from(row) * u64::from(height),
        usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
        mapped_at_creation: false,
    });
    let screen = ScreenDescriptor {
        size_in_pixels: [width, height],
        pixels_per_point,
    };
    let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    renderer.update_buffers(device, queue, &mut encoder, primitives, &screen);
    let pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view: &texture.create_view(&wgpu::TextureViewDescriptor::default()),
            resolve_target: None,
            ops: wgpu::Operations {
                // The harness leaves a margin around the window.
                load: wgpu::LoadOp::Clear(wgpu::Color::BLACK),
                store: wgpu::StoreOp::Store,
            },
            depth_slice: None,
        })],
        ..wgpu::RenderPassDescriptor::default()
    });
    renderer.render(&mut pass.forget_lifetime(), primitives, &screen);
    let layout = wgpu::TexelCopyBufferLayout {
        offset: 0,
        bytes_per_row: Some(row),
        rows_per_image: None,
    };
    let to = wgpu::TexelCopyBufferInfo {
        buffer: &buffer,
        layout,
    };
    encoder.copy_texture_to_buffer(texture.as_image_copy(), to, size);
    queue.submit([encoder.finish()]);
    buffer.map_async(wgpu::MapMode::Read, .., |mapped| mapped.unwrap());
    device.poll(wgpu::PollType::wait_indefinitely()).unwrap();
    let rows = buffer.get_mapped_range(..);
    let rows = rows.unwrap();
    let rows = rows.chunks(row as usize);
    rows.flat_map(|row| row[..width as usize * 4].to_vec())
        .collect()
}

fn differing_pixels(whole: &[u8], in_parts: &[u8]) -> usize {
    let (whole, in_parts) = (whole.as_chunks::<4>().0, in_parts.as_chunks::<4>().0);
    let pairs = whole.iter().zip(in_parts);
    whole.len().abs_diff(in_parts.len()) + pairs.filter(|(a, b)| a != b).count()
}

impl Plugin for Both {
    fn debug_name(&self) -> &'static str {
        "both ways"
    }

    fn output_hook(&mut self, ctx: &Context, output: &mut FullOutput) {
        let (mut whole, mut in_parts) = (output.clone(), output.clone());
        let whole = present(&self.whole, ctx, &mut whole);
        let drawn = self.redraw.drawn.len();
        self.redraw.output_hook(ctx, &mut in_parts);
        if output.platform_output.requested_discard() && self.redraw.drawn.len() == drawn {
            self.frames.lock().unwrap().discarded += 1;
            return;
        }
        assert_eq!(in_parts.shapes.len(), 1, "the picture of the window");
        let in_parts = present(&self.in_parts, ctx, &mut in_parts);
        let mut frames = self.frames.lock().unwrap();
        let differing = differing_pixels(&whole, &in_parts);
        if differing > 0 {
            let frame = frames.count;
            frames.differing.push((frame, differing));
        }
        frames.count += 1;
        let drawn = *self.redraw.drawn.last().unwrap();
        frames.drawn.push(drawn as f64 * 4.0 / whole.len() as f64);
        frames.picture = in_parts;
    }
}

/// A window of which each frame is drawn both ways. `None` without a graphics device.
///
/// # Panics
/// Without one, if `GUIDEWAY_REQUIRE_DEVICES` is 1.
fn window() -> Option<(TestWindow, Arc<Mutex<Frames>>)> {
    let Some(whole) = device() else {
        let reason = "no graphics adapter, not even a software one";
        let is_required = std::env::var("GUIDEWAY_REQUIRE_DEVICES").is_ok_and(|v| v == "1");
        assert!(!is_required, "{reason}");
        println!("SKIPPED: {reason}");
        return None;
    };
    let in_parts = with_own_renderer(&whole);
    let frames = Arc::<Mutex<Frames>>::default();
    let both = Both {
        redraw: PartialRedraw::new(in_parts.clone()),
        whole,
        in_parts,
        frames: Arc::clone(&frames),
    };
    let disk = TestServices::with([("site.arrow", lanes(12))]);
    let (services, files) = (disk.clone(), ["site.arrow"]);
    let setup = move |ctx: &Context| ctx.add_plugin(both);
    let mut window = TestWindow::with_setup(services, &disk, &files, Some("cpu"), setup);
    window.harness.set_size(Vec2::new(900.0, 600.0));
    window.wait(|app| app.document().is_some() && app.files.layers()[0].picture.shown().is_some());
    window.harness.run_steps(3);
    Some((window, frames))
}

/// The share of the window that the frames since `from` drew at most.
fn most_drawn(frames: &Mutex<Frames>, from: usize) -> f64 {
    let frames = frames.lock().unwrap();
    frames.drawn[from..].iter().copied().fold(0.0, f64::max)
}

#[test]
fn a_session_drawn_in_parts_shows_the_same_bits() {
    let Some((mut window, frames)) = window() else {
        return;
    };
    let count = || frames.lock().unwrap().count;
    window.harness.run_steps(2);
    let idle = count();
    window.harness.run_steps(2);
    assert_eq!(most_drawn(&frames, idle), 0.0, "nothing changes");
    let at = window.at(5.0, 6.5);
    window.harness.event(Event::PointerMoved(at));
    window.harness.run_steps(3);
    let hover = count();
    window
        .harness
        .event(Event::PointerMoved(at + Vec2::new(3.0, 0.0)));
    window.harness.run_steps(2);
    let share = most_drawn(&frames, hover);
    assert!(share > 0.0 && share < 0.2, "a movement draws {share}");
    for y in [4.0, 4.4] {
        let at = window.at(5.0, y);
        window.harness.event(Event::PointerMoved(at));
        window.harness.step();
    }
    let (path, node) = (window.at(5.0, 4.0), window.at(10.0, 4.0));
    window.click(path);
    window.drag(node, node + Vec2::new(20.0, 14.0));
    window.wheel(path, 2.0);
    window.harness.run_steps(3);
    window.key(CTRL, Key::Z);
    window.right_click(path);
    window.key(NONE, Key::Escape);
    for tab in [SideTab::Properties, SideTab::View, SideTab::Find] {
        window.app().side.open(tab);
        window.harness.run_steps(2);
    }
    window.harness.event(Event::Text("ÄÖÜ ß%&§".into()));
    window.harness.run_steps(2);
    window.key(NONE, Key::F1);
    window.key(NONE, Key::Escape);
    window.harness.ctx.set_theme(eframe::egui::Theme::Light);
    window.harness.run_steps(2);
    window.harness.set_size(Vec2::new(731.0, 523.0));
    window.harness.run_steps(3);
    window.harness.set_pixels_per_point(1.25);
    window.harness.run_steps(3);
    window
        .harness
        .event(Event::PointerMoved(Pos2::new(300.0, 300.0)));
    window.harness.run_steps(2);
    let frames = frames.lock().unwrap();
    assert_eq!(frames.differing, [], "of {} frames", frames.count);
    assert!(frames.count > 60 && frames.discarded > 0);
}

#[test]
fn comparison_finds_what_was_not_redrawn() {
    let Some((mut window, frames)) = window() else {
        return;
    };
    let before = frames.lock().unwrap().picture.clone();
    let path = window.at(5.0, 4.0);
    window.click(path);
    let frames = frames.lock().unwrap();
    assert!(differing_pixels(&before, &frames.picture) > 0);
    assert!(differing_pixels(&before, &before[4..]) > 0, "sizes count");
}
