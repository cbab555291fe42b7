//! Pictures that stay on the device have the pixels of those in main memory.

use guideway_scene::{DevicePicture, Rgba};

use super::*;
use crate::tiles::frame::presenter::Presenter;

/// Pixels of a texture, fetched through a buffer with padded rows.
fn fetch(gpu: &Gpu, picture: &DevicePicture) -> Vec<[u8; 4]> {
    let texture: &wgpu::Texture = picture.texture().expect("it is a texture of wgpu");
    let (width, height) = (texture.width(), texture.height());
    let row_bytes = (width * 4).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
    let device = gpu.device();
    let buffer = device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: u64::from(row_bytes * height),
        usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    });
    let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    let layout = wgpu::TexelCopyBufferLayout {
        offset: 0,
        bytes_per_row: Some(row_bytes),
        rows_per_image: None,
    };
    encoder.copy_texture_to_buffer(
        texture.as_image_copy(),
        wgpu::TexelCopyBufferInfo {
            buffer: &buffer,
            layout,
        },
        texture.size(),
    );
    gpu.submit(encoder.finish());
    buffer
        .slice(..)
        .map_async(wgpu::MapMode::Read, |mapped| mapped.unwrap());
    device.poll(wgpu::PollType::wait_indefinitely()).unwrap();
    let bytes = buffer.slice(..).get_mapped_range().unwrap();
    let rows = bytes.chunks_exact(row_bytes as usize);
    let pixels = rows.flat_map(|row| row[..width as usize * 4].as_chunks().0.to_vec());
    pixels.collect()
}

/// Straight alpha to premultiplied alpha, rounded.
fn premultiplied(frame: &Frame) -> Vec<[u8; 4]> {
    let of = |color: u8, alpha: u8| (f32::from(color) * f32::from(alpha) / 255.0).round() as u8;
    let pixels = frame.pixels().iter();
    pixels
        .map(|&[r, g, b, a]| [of(r, a), of(g, a), of(b, a), a])
        .collect()
}

fn on_device(prepared: &mut PreparedTiles, view: &View, style: &Style) -> (DevicePicture, Report) {
    let drawn = prepared.render_on_device(view, style, &Cancel::default());
    drawn.unwrap().expect("colors stay on the device")
}

#[test]
fn pictures_on_the_device_have_the_same_pixels() {
    let Some(tiles) = tiles() else { return };
    let banded = limited(GpuOptions {
        storage_binding_bytes: Some(32 << 10),
        ..GpuOptions::default()
    });
    let transparent = Style {
        background: Rgba {
            r: 200,
            g: 100,
            b: 50,
            a: 77,
        },
        ..Style::default()
    };
    for tiles in [&tiles, &banded] {
        let gpu = &tiles.0.gpu;
        for (scene, style) in [
            (plain(700, 3.0), Style::default()),
            (mixed(700, 3.0), transparent),
        ] {
            let (mut memory, mut device) = (prepared(tiles, &scene), prepared(tiles, &scene));
            // The same view again, a scrolled one, and one of another size.
            let wide = View::new(
                FrameSize::new(301, 77).unwrap(),
                Point::new(50.0, 30.0),
                3.0,
            );
            for view in [all(), all(), view([51.0, 30.0], 2.0), wide.unwrap(), all()] {
                let (frame, report) = picture(&mut memory, &view, &style);
                let (picture, own) = on_device(&mut device, &view, &style);
                assert!(fetch(gpu, &picture) == premultiplied(&frame), "{view:?}");
                assert_eq!((own.drawn, own.total), (report.drawn, report.total));
            }
        }
    }
}

#[test]
fn a_shown_picture_is_not_drawn_over() {
    let Some(tiles) = tiles() else { return };
    let gpu = &tiles.0.gpu;
    let scene = plain(300, 8.0);
    let mut prepared = prepared(&tiles, &scene);
    let (first, _) = on_device(&mut prepared, &all(), &Style::default());
    let before = fetch(gpu, &first);
    let (next, _) = on_device(&mut prepared, &view([20.0, 30.0], 5.0), &Style::default());
    assert!(fetch(gpu, &first) == before && fetch(gpu, &next) != before);
    drop(first);
    // Two textures serve any number of pictures, of which one is shown.
    let mut shown = next;
    for step in 0..5 {
        let view = view([20.0 + f64::from(step), 30.0], 5.0);
        (shown, _) = on_device(&mut prepared, &view, &Style::default());
    }
    drop(shown);
    let textures = prepared.presenter.as_ref().map(Presenter::texture_count);
    assert_eq!(textures, Some(2));
}

#[test]
fn density_and_empty_scenes_are_drawn_in_main_memory() {
    let Some(tiles) = tiles() else { return };
    let density = style(Shading::Density(ToneMap::default()));
    for (scene, style) in [(plain(9, 3.0), density), (plain(0, 1.0), Style::default())] {
        let mut prepared = prepared(&tiles, &scene);
        let drawn = prepared.render_on_device(&all(), &style, &Cancel::default());
        assert!(drawn.unwrap().is_none());
    }
}

#[test]
fn methods_share_a_device_with_their_caller() {
    let Some(tiles) = tiles() else { return };
    let (adapter, device, queue) = crate::device::open_for_tests().unwrap();
    let gpu = Gpu::shared(&adapter, device.clone(), queue);
    let own = Tiles::new(Arc::clone(&gpu), OPTIONS).unwrap();
    let scene = mixed(300, 8.0);
    let mut shared = prepared(&own, &scene);
    assert_eq!(
        shared.device().and_then(|d| d.downcast_ref()),
        Some(&device)
    );
    let (frame, _) = picture(&mut prepared(&tiles, &scene), &all(), &Style::default());
    let (on_device, _) = on_device(&mut shared, &all(), &Style::default());
    assert!(fetch(&gpu, &on_device) == premultiplied(&frame));
    assert!(!gpu.is_lost());
    device.destroy();
    assert!(gpu.is_lost());
    let lost = shared.render_on_device(&all(), &Style::default(), &Cancel::default());
    assert!(matches!(lost, Err(RenderError::Device { .. })), "{lost:?}");
}
