//! A finished picture, and what of it the next one can keep.

use std::ops::Range;

use guideway_scene::{FrameSize, Style};
use guideway_spline::{Bounds, Point};
use rayon::prelude::*;

use super::place::Placement;
use super::shot::Shot;
use super::sight::Sights;
use super::tiles::Parts;

/// Boxes of changes that are kept in mind: more are all of the picture.
const MOST_CHANGES: usize = 4096;

/// The picture of the last frame, moved without being copied: it wraps around at its sides. A pixel is a color, or
/// the bytes of the number of paths there.
///
/// Pixels are kept only once a second frame of the same scale is asked for: a zoom has no use for them.
pub(super) struct Kept {
    place: Placement,
    size: FrameSize,
    style: Style,
    /// Where the upper left corner lies among the pixels.
    corner: [usize; 2],
    /// None until they are kept.
    pixels: Vec<[u8; 4]>,
    /// Where in the world something has changed since.
    changes: Vec<Bounds<f64>>,
}

impl Kept {
    /// What a frame shows, not its pixels.
    pub(super) fn new(shot: &Shot<'_>) -> Self {
        Self {
            place: shot.place,
            size: shot.view.size(),
            style: *shot.style,
            corner: [0, 0],
            pixels: Vec::new(),
            changes: Vec::new(),
        }
    }

    #[cfg(test)]
    pub(super) fn pixel_count(&self) -> usize {
        self.size.pixels()
    }

    pub(super) fn bytes(&self) -> u64 {
        let pixels = self.pixels.capacity() * size_of::<[u8; 4]>();
        (pixels + self.changes.capacity() * size_of::<Bounds<f64>>()) as u64
    }

    /// Whether a frame differs by no more than where it looks.
    pub(super) fn is_alike(&self, shot: &Shot<'_>) -> bool {
        let is_near = self.place.whole_px_to(&shot.place).is_some();
        is_near && self.size == shot.view.size() && self.style == *shot.style
    }

    /// Takes note of what has changed.
    pub(super) fn change(&mut self, changes: &[Bounds<f64>]) {
        if self.changes.len() + changes.len() > MOST_CHANGES {
            self.forget();
        } else if !self.pixels.is_empty() {
            self.changes.extend_from_slice(changes);
        }
    }

    /// Lets go of the pixels, not of their memory.
    pub(super) fn forget(&mut self) {
        self.pixels.clear();
        self.changes.clear();
    }

    /// Moves to where a frame looks, and adds the parts that it has to draw. False if that is all of it: nothing
    /// is kept, or nothing has changed, and who asks for the same picture again wants it drawn.
    pub(super) fn move_to(&mut self, shot: &Shot<'_>, sights: &Sights, parts: &mut Parts) -> bool {
        let [width, height] = [self.size.width(), self.size.height()].map(i64::from);
        let moved = self.place.whole_px_to(&shot.place);
        let near = moved.filter(|[right, down]| right.abs() < width && down.abs() < height);
        let Some([right, down]) = near.filter(|_| self.is_alike(shot)) else {
            return false;
        };
        if self.pixels.is_empty() || ([right, down] == [0, 0] && self.changes.is_empty()) {
            return false;
        }
        self.place = shot.place;
        for ((corner, step), side) in self
            .corner
            .iter_mut()
            .zip([right, down])
            .zip([width, height])
        {
            *corner = (*corner as i64 + step).rem_euclid(side) as usize;
        }
        let [all_columns, all_rows] = [0..width as usize, 0..height as usize];
        parts.add(came_into_view(right, width), all_rows.clone());
        parts.add(all_columns.clone(), came_into_view(down, height));
        let mut add = |reach: Bounds<f64>| {
            let within = |min: f64, max: f64, all: &Range<usize>| {
                min.floor() as usize..(max.ceil() as usize).min(all.end)
            };
            parts.add(
                within(reach.min.x, reach.max.x, &all_columns),
                within(reach.min.y, reach.max.y, &all_rows),
            );
        };
        for bounds in self.changes.drain(..) {
            add(shot.reach_px(bounds));
        }
        if [right, down] != [0, 0] {
            // What is cut at the picture is not the same to the bit elsewhere.
            for sight in sights.iter().filter(|sight| sight.is_large) {
                let [min, max] = [sight.reach_px.min, sight.reach_px.max].map(Point::to_f64);
                add(Bounds { min, max });
            }
        }
        true
    }

    /// Copies rows of pixels out, from one of the picture on.
    pub(super) fn load(&self, first_row: usize, pixels: &mut [[u8; 4]]) {
        let width = self.size.width() as usize;
        for (row, pixels) in (first_row..).zip(pixels.chunks_exact_mut(width)) {
            let (left, right) = self.row(row).split_at(self.corner[0]);
            pixels[..right.len()].copy_from_slice(right);
            pixels[right.len()..].copy_from_slice(left);
        }
    }

    /// The pixels of a row of the picture, from the least place on.
    fn row(&self, row: usize) -> &[[u8; 4]] {
        let width = self.size.width() as usize;
        let place = (row + self.corner[1]) % self.size.height() as usize;
        &self.pixels[place * width..][..width]
    }

    /// Keeps the parts that were drawn.
    pub(super) fn store(&mut self, parts: &Parts, pixels: &[[u8; 4]]) {
        let [width, height] = [self.size.width(), self.size.height()].map(|side| side as usize);
        for (columns, rows) in parts.pixels() {
            for row in rows {
                let place = (row + self.corner[1]) % height * width;
                let kept = &mut self.pixels[place..place + width];
                let drawn = &pixels[row * width..][columns.clone()];
                let start = (columns.start + self.corner[0]) % width;
                let before_wrap = drawn.len().min(width - start);
                kept[start..start + before_wrap].copy_from_slice(&drawn[..before_wrap]);
                kept[..drawn.len() - before_wrap].copy_from_slice(&drawn[before_wrap..]);
            }
        }
    }

    /// Keeps a whole picture; no need to where it is kept already.
    pub(super) fn store_all(&mut self, shot: &Shot<'_>, pixels: &[[u8; 4]]) {
        let is_there = self.place == shot.place && self.changes.is_empty();
        if is_there && self.pixels.len() == pixels.len() {
            return;
        }
        let kept = Self::new(shot);
        let mut own = std::mem::replace(self, kept).pixels;
        own.resize(pixels.len(), [0; 4]);
        let chunks = own.par_chunks_mut(1 << 16).zip(pixels.par_chunks(1 << 16));
        chunks.for_each(|(own, pixels)| own.copy_from_slice(pixels));
        self.pixels = own;
    }
}

/// Pixels of a side that a picture moved by `step` did not show before.
fn came_into_view(step: i64, side: i64) -> Range<usize> {
    match step {
        0 => 0..0,
        1.. => (side - step) as usize..side as usize,
        _ => 0..step.unsigned_abs() as usize,
    }
}
