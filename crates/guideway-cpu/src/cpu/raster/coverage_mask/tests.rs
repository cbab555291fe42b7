//! Masks against hand-counted coverage.

use guideway_scene::Rgba;

use super::*;
use crate::cpu::ground::samples::LAYERED;
use crate::cpu::raster::background::Background;
use crate::cpu::raster::caps::CapTable;
use crate::cpu::raster::line_batch::{capsule, level_capsule};
use crate::cpu::raster::resolve::resolve_layered_row;

type LayeredMask = CoverageMask<LAYERED>;

/// Strokes a level line, in pixels.
fn stroke<const C: usize>(mask: &mut CoverageMask<C>, from: f32, to: f32, y: f32, radius: f32) {
    let mut caps = CapTable::<C>::default();
    caps.resize(radius * C as f32);
    let capsule = level_capsule::<C>([from, to].map(|x| x * C as f32), y * C as f32);
    let all = PixelBox {
        rows: u32::MAX,
        pixels: u32::MAX,
    };
    mask.stroke(&(&capsule, &caps), all);
}

fn pixel(mask: &LayeredMask, x: usize, y: usize, background: Rgba) -> [u8; 4] {
    let mut pixels = vec![[0; 4]; TILE_PX];
    resolve_layered_row(mask, y, &Background::new(background), &mut pixels);
    pixels[x]
}

#[test]
fn marks_pixels_with_all_bits_set() {
    fn check<const C: usize>(word: u32) {
        let of_pixel = |pixel: usize| word >> (pixel * C) & low_bits(C as u32);
        let full = (0..TILE_PX / C).map(|i| u32::from(of_pixel(i) == low_bits(C as u32)) << i);
        assert_eq!(full_pixels::<C>(word), full.sum(), "{word:#x}");
    }
    // Pixels that are empty, full, or lack the first or the last bit.
    let bytes = [0, 0xff, 0xfe, 0x7f];
    for number in 0..bytes.len().pow(4) {
        let word = [0, 2, 4, 6].map(|shift| bytes[number >> shift & 3]);
        let word = u32::from_le_bytes(word);
        check::<SOLID>(word);
        check::<LAYERED>(word);
    }
}

#[test]
fn counts_samples_per_pixel() {
    let mut block = [0; ROWS];
    assert_eq!(pixel_counts::<SOLID>(&block), [0; 4]);
    block[3] = 0x01_80_ff_13;
    assert_eq!(pixel_counts::<SOLID>(&block), [3, 8, 1, 1]);
    assert_eq!(pixel_counts::<LAYERED>(&block)[..2], [11, 2]);
    assert_eq!(pixel_counts::<SOLID>(&[u32::MAX; ROWS]), [128; 4]);
    assert_eq!(pixel_counts::<LAYERED>(&[u32::MAX; ROWS])[..2], [256; 2]);
}

#[test]
fn a_stroke_by_itself_counts_as_its_shape_in_the_mask() {
    let mut caps = CapTable::<LAYERED>::default();
    for (i, radius) in [4.8, 17.0, 200.0].into_iter().enumerate() {
        caps.resize(radius);
        for step in 0..60 {
            let at = |of: usize| (step * of % 700) as f32 - 90.0 + i as f32 / 3.0;
            let capsule = capsule::<LAYERED>([at(37), at(53)], [at(91), at(17)], radius);
            let part = PixelBox {
                rows: [u32::MAX, 0x00ff_ff00][step % 2],
                pixels: [u32::MAX, 0x000f_fff8, 0x0180_0000][step % 3],
            };
            let mut mask = LayeredMask::new();
            mask.begin_layers(27, 30);
            let mut counts = [[[1; TILE_PX]; TILE_PX]; 2];
            mask.count_stroke(&(&capsule, &caps), part, 2, &mut counts[0]);
            mask.stroke(&(&capsule, &caps), part);
            mask.count(2, part.pixels, &mut counts[1]);
            assert!(counts[0] == counts[1], "{capsule:?}, {radius}, {step}");
            assert!(mask.touched == [0; LAYERED], "a new shape begins");
        }
    }
}

#[test]
fn composites_below_what_is_there() {
    let mut mask = LayeredMask::new();
    mask.begin_layers(32, 32);
    let (red, blue) = (Rgba::opaque(255, 0, 0), Rgba::opaque(0, 0, 255));
    stroke(&mut mask, 0.0, 16.0, 4.5, 0.5);
    mask.composite(red);
    stroke(&mut mask, 0.0, 16.0, 5.0, 0.25);
    mask.composite(blue);
    assert_eq!(pixel(&mask, 8, 4, Rgba::WHITE), [255, 0, 0, 255]);
    assert_eq!(pixel(&mask, 8, 5, Rgba::WHITE), [191, 191, 255, 255]);
}

#[test]
fn composites_translucent_paths_per_sample() {
    let mut mask = LayeredMask::new();
    mask.begin_layers(32, 32);
    for _ in 0..2 {
        stroke(&mut mask, 0.0, 16.0, 4.5, 0.25);
        mask.composite(Rgba::from_u32(0x0000_0080));
    }
    stroke(&mut mask, 0.0, 16.0, 4.5, 9.0);
    mask.composite(Rgba::opaque(0, 255, 0));
    let clear = (1.0 - 128.0 / 255.0_f64).powi(2);
    let green = (255.0 * (0.5 + 0.5 * clear)).round() as u8;
    assert_eq!(pixel(&mask, 8, 4, Rgba::WHITE), [0, green, 0, 255]);
}

#[test]
fn resolves_a_translucent_background_to_straight_alpha() {
    let background = Rgba::from_u32(0xff00_0080);
    let mut mask = LayeredMask::new();
    mask.begin_layers(32, 32);
    stroke(&mut mask, 0.0, 16.0, 4.5, 0.25);
    mask.composite(Rgba::opaque(0, 0, 255));
    assert_eq!(pixel(&mask, 0, 0, background), [255, 0, 0, 128]);
    // Half opaque blue, and a quarter red.
    assert_eq!(pixel(&mask, 8, 4, background), [85, 0, 170, 192]);
}

#[test]
fn is_full_once_all_visible_pixels_are_covered() {
    let mut mask = CoverageMask::<SOLID>::new();
    mask.begin(5, 3);
    stroke(&mut mask, 0.0, 0.0, 1.5, 4.5);
    assert!(!mask.is_full());
    assert!(mask.is_open(Point::new(4.0, 0.0), Point::new(9.0, 9.0)));
    assert!(!mask.is_open(Point::new(-1e9, 0.0), Point::new(3.0, 1e9)));
    stroke(&mut mask, 4.5, 4.5, 1.5, 2.5);
    assert!(mask.is_full());
}

#[test]
fn skipping_closing_changes_no_sample() {
    let counts = |mask: &CoverageMask<SOLID>| {
        let rows = mask.shape.iter().flatten();
        rows.map(pixel_counts::<SOLID>).collect::<Vec<_>>()
    };
    let mut canvases = [CoverageMask::<SOLID>::new(), CoverageMask::new()];
    for mask in &mut canvases {
        mask.begin(29, 31);
    }
    canvases[1].skip_closing();
    for i in 0..40_u16 {
        let [x, y] = [7, 11].map(|step| f32::from(i * step % 31));
        for mask in &mut canvases {
            stroke(mask, x, x + 6.3, y, 2.7);
        }
    }
    let [closed, open] = canvases.each_ref().map(CoverageMask::open_count);
    assert!(closed < 29 * 31 / 2);
    assert_eq!(open, 29 * 31);
    assert_eq!(counts(&canvases[0]), counts(&canvases[1]));
    canvases[1].begin(29, 31);
    stroke(&mut canvases[1], 4.0, 20.0, 9.0, 4.0);
    assert!(canvases[1].open_count() < open);
}
