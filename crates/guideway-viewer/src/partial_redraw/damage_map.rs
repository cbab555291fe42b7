//! Finds the pixels in which two frames differ, tile by tile.

use std::collections::HashMap;
use std::hash::{BuildHasher, BuildHasherDefault, DefaultHasher};

use eframe::egui::{Rect, TextureId};

use super::pixel_rect::PixelRect;
use super::triangles::{FrameTriangles, Triangle};

/// Edge of a tile in pixels: that of the tiles of Mesa's software device.
const TILE_PX: u32 = 64;

/// Rectangles that are drawn one by one. Each takes its own draw calls.
const MAX_RECTS: usize = 8;

/// Rectangles among which the best pairs are found; of more, all become one.
const MAX_PAIRED: usize = 48;

/// One hash per tile, of the triangles that touch the tile in their order.
#[derive(Default)]
pub(super) struct DamageMap {
    hashes: Vec<u64>,
}

impl DamageMap {
    /// Forgets the last frame: all of the next one differs.
    pub(super) fn clear(&mut self) {
        self.hashes.clear();
    }

    /// Returns rectangles that cover all pixels in which `frame` may differ from the last one,
    /// given the parts of textures that changed meanwhile.
    pub(super) fn damage(
        &mut self,
        frame: &FrameTriangles,
        changes: &HashMap<TextureId, Rect>,
    ) -> Vec<PixelRect> {
        let [columns, rows] = frame.size.map(|pixels| pixels.div_ceil(TILE_PX));
        let seed = u64::from(frame.scale.to_bits());
        let mut hashes = vec![seed; columns as usize * rows as usize];
        let mut is_damaged = vec![false; hashes.len()];
        for triangle in frame.visible() {
            let has_new_texels = changes
                .get(&triangle.texture)
                .is_some_and(|changed| changed.intersects(triangle.uv()));
            let hash = hash_of(&triangle);
            let first = triangle.pixels.min.map(|pixel| pixel / TILE_PX);
            let end = triangle.pixels.max.map(|pixel| pixel.div_ceil(TILE_PX));
            for row in first[1]..end[1] {
                for column in first[0]..end[0] {
                    let tile = (row * columns + column) as usize;
                    hashes[tile] = mix(hashes[tile], hash);
                    is_damaged[tile] |= has_new_texels;
                }
            }
        }
        if self.hashes.len() == hashes.len() {
            let tiles = self.hashes.iter().zip(&hashes).zip(&mut is_damaged);
            tiles.for_each(|((old, new), is_damaged)| *is_damaged |= old != new);
        } else {
            is_damaged.fill(true);
        }
        self.hashes = hashes;
        few(tiles_to_rects(&is_damaged, frame.size))
    }
}

fn hash_of(triangle: &Triangle) -> u64 {
    let hasher = BuildHasherDefault::<DefaultHasher>::new();
    let corners = triangle.corners.iter();
    corners.fold(
        hasher.hash_one((triangle.texture, triangle.clip.min, triangle.clip.max)),
        |hash, corner| {
            let pair = |x: f32, y: f32| u64::from(x.to_bits()) << 32 | u64::from(y.to_bits());
            let hash = mix(hash, pair(corner.pos.x, corner.pos.y));
            let hash = mix(hash, pair(corner.uv.x, corner.uv.y));
            mix(hash, u64::from(u32::from_le_bytes(corner.color.to_array())))
        },
    )
}

/// Adds a word to a hash: a step of Fibonacci hashing, whose high bits return to the low ones.
fn mix(hash: u64, word: u64) -> u64 {
    let product = (hash.rotate_left(23) ^ word).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    product ^ (product >> 32)
}

/// Joins damaged tiles that lie beside each other to runs, and equal runs below each other.
fn tiles_to_rects(is_damaged: &[bool], size: [u32; 2]) -> Vec<PixelRect> {
    let columns = size[0].div_ceil(TILE_PX) as usize;
    let mut rects = Vec::<PixelRect>::new();
    for (row, tiles) in (0_u32..).zip(is_damaged.chunks(columns.max(1))) {
        let runs = tiles.chunk_by(|left, right| left == right);
        let mut column = 0;
        for run in runs {
            let end = column + run.len() as u32;
            let pixels = PixelRect {
                min: [column * TILE_PX, row * TILE_PX],
                max: [end * TILE_PX, (row + 1) * TILE_PX],
            };
            column = end;
            if !run[0] {
                continue;
            }
            let run = pixels.intersect(PixelRect::whole(size));
            let above = rects.iter_mut().find(|above| {
                let [left, right] = [above.min[0], above.max[0]];
                above.max[1] == run.min[1] && left == run.min[0] && right == run.max[0]
            });
            match above {
                Some(above) => above.max[1] = run.max[1],
                None => rects.push(run),
            }
        }
    }
    rects
}

/// Joins rectangles until few are left, first those whose union has the fewest pixels beside them.
fn few(mut rects: Vec<PixelRect>) -> Vec<PixelRect> {
    if rects.len() > MAX_PAIRED {
        rects = rects
            .into_iter()
            .reduce(PixelRect::union)
            .into_iter()
            .collect();
    }
    while rects.len() > MAX_RECTS {
        let pairs = (0..rects.len()).flat_map(|right| (0..right).map(move |left| (left, right)));
        let best = pairs.min_by_key(|&(left, right)| {
            let [left, right] = [rects[left], rects[right]];
            left.union(right).area() as i64 - left.area() as i64 - right.area() as i64
        });
        let Some((left, right)) = best else { break };
        let joined = rects.swap_remove(right);
        rects[left] = rects[left].union(joined);
    }
    rects
}

#[cfg(test)]
#[path = "damage_map_tests.rs"]
mod tests;
