//! Keeps the last picture, so that a pan or an edit redraws only the pixels that changed.

use std::ops::Range;

use guideway_scene::{FrameSize, Style};
use guideway_spline::{Bounds, Point};
use rayon::prelude::*;

use crate::cpu::bin::cull::VisibleClusters;
use crate::cpu::ground::damage::DamageMap;
use crate::cpu::ground::frame_context::FrameContext;
use crate::cpu::ground::snapped_view::SnappedTransform;

/// Most boxes of changes that are recorded; of more, the whole picture is redrawn.
const MAX_CHANGES: usize = 4096;
/// Pixels per task of a copy.
const CHUNK_PX: usize = 1 << 16;

/// The picture of the last frame: colors, or the bytes of a density per pixel.
///
/// A pan moves the corner instead of the pixels: they wrap around the sides.
///
/// ```text
///   +-------+---+
///   |   C   | D |     corner at A: the rows of the picture are A B, then C D
///   +-------+---+
///   |   B   | A |
///   +-------+---+
/// ```
///
/// Pixels are stored only when a second frame of the same scale is drawn: a zoom has no use for
/// them.
pub(crate) struct PictureCache {
    transform: SnappedTransform,
    size: FrameSize,
    style: Style,
    /// Column and row of the upper left corner in the stored pixels.
    corner: [usize; 2],
    /// Empty until pixels are stored.
    pixels: Vec<[u8; 4]>,
    /// Boxes in meters that have changed since.
    changes: Vec<Bounds<f64>>,
}

impl PictureCache {
    /// Stores what a frame has drawn, if a later frame may reuse it.
    pub(crate) fn keep(
        picture: &mut Option<Self>,
        (ctx, is_moved): (&FrameContext<'_>, bool),
        damage: &DamageMap,
        pixels: &[[u8; 4]],
        has_room: bool,
    ) {
        match picture {
            Some(picture) if is_moved => picture.store(damage, pixels),
            Some(picture) if picture.is_alike(ctx) => {
                if has_room {
                    picture.store_all(ctx, pixels);
                }
            }
            _ => *picture = Some(Self::new(ctx)),
        }
    }

    /// A cache for frames like `ctx`, without pixels.
    pub(crate) fn new(ctx: &FrameContext<'_>) -> Self {
        Self {
            transform: ctx.transform,
            size: ctx.view.size(),
            style: *ctx.style,
            corner: [0, 0],
            pixels: Vec::new(),
            changes: Vec::new(),
        }
    }

    #[cfg(test)]
    pub(crate) fn pixel_count(&self) -> usize {
        self.size.pixels()
    }

    /// Heap bytes held.
    pub(crate) fn bytes(&self) -> u64 {
        let pixels = self.pixels.capacity() * size_of::<[u8; 4]>();
        (pixels + self.changes.capacity() * size_of::<Bounds<f64>>()) as u64
    }

    /// Returns `true` if a frame differs at most by a pan of whole pixels.
    pub(crate) fn is_alike(&self, ctx: &FrameContext<'_>) -> bool {
        let is_near = self.transform.whole_px_to(&ctx.transform).is_some();
        is_near && self.size == ctx.view.size() && self.style == *ctx.style
    }

    /// Records changed boxes, in meters.
    pub(crate) fn add_changes(&mut self, changes: &[Bounds<f64>]) {
        if self.changes.len() + changes.len() > MAX_CHANGES {
            self.forget();
        } else if !self.pixels.is_empty() {
            self.changes.extend_from_slice(changes);
        }
    }

    /// Drops the pixels but keeps their memory.
    pub(crate) fn forget(&mut self) {
        self.pixels.clear();
        self.changes.clear();
    }

    /// Moves the cache to the view of a frame and adds the pixels that have to be drawn to
    /// `damage`. Returns false if that is the whole picture: no pixels are stored, or the frame is
    /// the last one again and its caller wants it drawn.
    pub(crate) fn move_to(
        &mut self,
        ctx: &FrameContext<'_>,
        visible: &VisibleClusters,
        damage: &mut DamageMap,
    ) -> bool {
        let [width, height] = [self.size.width(), self.size.height()].map(i64::from);
        let moved = self.transform.whole_px_to(&ctx.transform);
        let near = moved.filter(|[right, down]| right.abs() < width && down.abs() < height);
        let Some([right, down]) = near.filter(|_| self.is_alike(ctx)) else {
            return false;
        };
        if self.pixels.is_empty() || ([right, down] == [0, 0] && self.changes.is_empty()) {
            return false;
        }
        self.transform = ctx.transform;
        for ((corner, step), side) in self
            .corner
            .iter_mut()
            .zip([right, down])
            .zip([width, height])
        {
            *corner = (*corner as i64 + step).rem_euclid(side) as usize;
        }
        let [all_columns, all_rows] = [0..width as usize, 0..height as usize];
        damage.add(scrolled_in(right, width), all_rows.clone());
        damage.add(all_columns.clone(), scrolled_in(down, height));
        let mut add = |touched: Bounds<f64>| {
            let within = |min: f64, max: f64, all: &Range<usize>| {
                min.floor() as usize..(max.ceil() as usize).min(all.end)
            };
            damage.add(
                within(touched.min.x, touched.max.x, &all_columns),
                within(touched.min.y, touched.max.y, &all_rows),
            );
        };
        for bounds in self.changes.drain(..) {
            add(ctx.touched_px(bounds));
        }
        if [right, down] != [0, 0] {
            // Long lines may differ in the last bits after a pan by less than a tile.
            for visible in visible.iter().filter(|visible| visible.is_oversized) {
                let [min, max] = [visible.bounds_px.min, visible.bounds_px.max].map(Point::to_f64);
                add(Bounds { min, max });
            }
        }
        true
    }

    /// Copies rows of the picture to `pixels`, from `first_row` on.
    pub(crate) fn load(&self, first_row: usize, pixels: &mut [[u8; 4]]) {
        let width = self.size.width() as usize;
        for (row, pixels) in (first_row..).zip(pixels.chunks_exact_mut(width)) {
            let (left, right) = self.stored_row(row).split_at(self.corner[0]);
            pixels[..right.len()].copy_from_slice(right);
            pixels[right.len()..].copy_from_slice(left);
        }
    }

    /// The stored pixels of a row of the picture, in the order in which they are stored.
    fn stored_row(&self, row: usize) -> &[[u8; 4]] {
        let width = self.size.width() as usize;
        let stored = (row + self.corner[1]) % self.size.height() as usize;
        &self.pixels[stored * width..][..width]
    }

    /// Stores the damaged pixels of a picture.
    pub(crate) fn store(&mut self, damage: &DamageMap, pixels: &[[u8; 4]]) {
        let [width, height] = [self.size.width(), self.size.height()].map(|side| side as usize);
        for (columns, rows) in damage.rects_px() {
            for row in rows {
                let first = (row + self.corner[1]) % height * width;
                let stored = &mut self.pixels[first..first + width];
                let drawn = &pixels[row * width..][columns.clone()];
                let start = (columns.start + self.corner[0]) % width;
                let before_wrap = drawn.len().min(width - start);
                stored[start..start + before_wrap].copy_from_slice(&drawn[..before_wrap]);
                stored[..drawn.len() - before_wrap].copy_from_slice(&drawn[before_wrap..]);
            }
        }
    }

    /// Stores a whole picture, unless it is stored already.
    pub(crate) fn store_all(&mut self, ctx: &FrameContext<'_>, pixels: &[[u8; 4]]) {
        let is_current = self.transform == ctx.transform && self.changes.is_empty();
        if is_current && self.pixels.len() == pixels.len() {
            return;
        }
        let mut stored = std::mem::replace(self, Self::new(ctx)).pixels;
        stored.resize(pixels.len(), [0; 4]);
        let chunks = stored.par_chunks_mut(CHUNK_PX);
        let chunks = chunks.zip(pixels.par_chunks(CHUNK_PX));
        chunks.for_each(|(stored, pixels)| stored.copy_from_slice(pixels));
        self.pixels = stored;
    }
}

/// Pixels of a side that a pan by `step` brings into view.
fn scrolled_in(step: i64, side: i64) -> Range<usize> {
    match step {
        0 => 0..0,
        1.. => (side - step) as usize..side as usize,
        _ => 0..step.unsigned_abs() as usize,
    }
}
