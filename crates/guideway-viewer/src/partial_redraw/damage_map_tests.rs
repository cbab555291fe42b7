use eframe::egui::{ClippedPrimitive, Color32, Mesh, Pos2, Vec2};
use eframe::epaint::Primitive;

use super::*;

const SIZE: [u32; 2] = [300, 200];

/// A window with rectangles from these points, 20 points wide, in the order of drawing.
fn frame(rects: &[([f32; 2], Color32)]) -> FrameTriangles {
    let window = Rect::from_min_size(Pos2::ZERO, Vec2::new(300.0, 200.0));
    let mut mesh = Mesh::default();
    mesh.add_colored_rect(window, Color32::WHITE);
    for &([x, y], color) in rects {
        let rect = Rect::from_min_size(Pos2::new(x, y), Vec2::splat(20.0));
        mesh.add_colored_rect(rect, color);
    }
    let primitives = vec![ClippedPrimitive {
        clip_rect: window,
        primitive: Primitive::Mesh(mesh),
    }];
    FrameTriangles::new(primitives, SIZE, 1.0)
}

fn tile(column: u32, row: u32, end_column: u32, end_row: u32) -> PixelRect {
    let tile = PixelRect {
        min: [column * TILE_PX, row * TILE_PX],
        max: [end_column * TILE_PX, end_row * TILE_PX],
    };
    tile.intersect(PixelRect::whole(SIZE))
}

/// The damage of the second of two frames.
fn damage(first: &FrameTriangles, second: &FrameTriangles) -> Vec<PixelRect> {
    let mut map = DamageMap::default();
    let unchanged = HashMap::new();
    assert_eq!(map.damage(first, &unchanged), [PixelRect::whole(SIZE)]);
    map.damage(second, &unchanged)
}

#[test]
fn tiles_of_moved_and_recolored_triangles_differ() {
    let at = |x, color| frame(&[([x, 10.0], color), ([200.0, 150.0], Color32::GREEN)]);
    assert_eq!(damage(&at(10.0, Color32::RED), &at(10.0, Color32::RED)), []);
    assert_eq!(
        damage(&at(10.0, Color32::RED), &at(10.0, Color32::BLUE)),
        [tile(0, 0, 1, 1)]
    );
    // From the first tile to the border of the second and third.
    assert_eq!(
        damage(&at(10.0, Color32::RED), &at(120.0, Color32::RED)),
        [tile(0, 0, 3, 1)]
    );
}

#[test]
fn order_of_drawing_and_what_vanished_count() {
    let red = ([70.0, 70.0], Color32::RED);
    let blue = ([80.0, 80.0], Color32::BLUE);
    let other = ([260.0, 10.0], Color32::GREEN);
    let swapped = damage(&frame(&[red, blue, other]), &frame(&[blue, red, other]));
    assert_eq!(swapped, [tile(1, 1, 2, 2)]);
    // Triangles that only moved in the list of all draw the same pixels.
    assert_eq!(
        damage(&frame(&[red, blue, other]), &frame(&[other, red, blue])),
        []
    );
    assert_eq!(
        damage(&frame(&[red, blue, other]), &frame(&[red, blue])),
        [tile(4, 0, 5, 1)]
    );
}

#[test]
fn changed_texels_damage_triangles_that_show_them() {
    let mut map = DamageMap::default();
    let mut glyph = Mesh::default();
    let uv = Rect::from_min_max(Pos2::new(0.5, 0.5), Pos2::new(0.6, 0.6));
    let rect = Rect::from_min_size(Pos2::new(70.0, 70.0), Vec2::splat(10.0));
    glyph.add_rect_with_uv(rect, uv, Color32::WHITE);
    let primitives = vec![ClippedPrimitive {
        clip_rect: Rect::EVERYTHING,
        primitive: Primitive::Mesh(glyph),
    }];
    let frame = FrameTriangles::new(primitives, SIZE, 1.0);
    map.damage(&frame, &HashMap::new());
    let mut after = |min: f32, max: f32| {
        let texels = Rect::from_min_max(Pos2::new(min, min), Pos2::new(max, max));
        map.damage(&frame, &HashMap::from([(TextureId::default(), texels)]))
    };
    assert_eq!(after(0.0, 0.4), []);
    assert_eq!(after(0.55, 0.7), [tile(1, 1, 2, 2)]);
}

#[test]
fn scale_and_size_damage_the_whole_window() {
    let mut map = DamageMap::default();
    let mut at = |scale| {
        let mut frame = frame(&[]);
        frame.scale = scale;
        map.damage(&frame, &HashMap::new())
    };
    assert_eq!(at(1.0), [PixelRect::whole(SIZE)]);
    assert_eq!(at(1.0), []);
    assert_eq!(at(1.5), [PixelRect::whole(SIZE)]);
    let mut wider = frame(&[]);
    wider.size = [400, 200];
    assert_eq!(
        map.damage(&wider, &HashMap::new()),
        [PixelRect::whole([400, 200])]
    );
}

#[test]
fn joined_rectangles_cover_all_damage() {
    let spots: Vec<_> = (0..40)
        .map(|spot| PixelRect {
            min: [spot * 70 % 900, spot * 130 % 700],
            max: [spot * 70 % 900 + 64, spot * 130 % 700 + 64],
        })
        .collect();
    for count in [3, MAX_RECTS, 20, 40] {
        let joined = few(spots[..count].to_vec());
        assert!(joined.len() <= MAX_RECTS, "{count} become {}", joined.len());
        for spot in &spots[..count] {
            assert!(joined.iter().any(|rect| rect.contains(*spot)), "{spot:?}");
        }
    }
    assert_eq!(few(spots[..3].to_vec()), spots[..3]);
}
