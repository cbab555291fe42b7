//! Rectangles of pixels in the window.

use eframe::egui::{Pos2, Rect};

/// Half a step of the positions to which rasterizers round vertices is far less, in pixels.
const ROUNDING: f32 = 1.0 / 16.0;

/// Columns and rows of pixels from `min` up to, but without, `max`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct PixelRect {
    pub(super) min: [u32; 2],
    pub(super) max: [u32; 2],
}

impl PixelRect {
    /// All pixels of a window of `size`.
    pub(super) fn whole(size: [u32; 2]) -> Self {
        Self {
            min: [0, 0],
            max: size,
        }
    }

    /// The pixels of a clip rectangle in points, rounded as the renderer of egui rounds it.
    pub(super) fn of_clip(clip: Rect, scale: f32, size: [u32; 2]) -> Self {
        let pixel = |points: f32| (points * scale).round() as u32;
        let clip = Self {
            min: [pixel(clip.min.x), pixel(clip.min.y)],
            max: [pixel(clip.max.x), pixel(clip.max.y)],
        };
        clip.intersect(Self::whole(size))
    }

    /// The pixels that a triangle with these corners, in points, may touch.
    pub(super) fn around(corners: [Pos2; 3], scale: f32, size: [u32; 2]) -> Self {
        if !corners.iter().all(|corner| corner.is_finite()) {
            return Self::whole(size);
        }
        let bounds = Rect::from_points(&corners);
        let first = |points: f32| (points * scale - ROUNDING).floor() as u32;
        let end = |points: f32| (points * scale + ROUNDING).ceil() as u32;
        let bounds = Self {
            min: [first(bounds.min.x), first(bounds.min.y)],
            max: [end(bounds.max.x), end(bounds.max.y)],
        };
        bounds.intersect(Self::whole(size))
    }

    /// The clip rectangle in points that the renderer rounds to these pixels.
    pub(super) fn to_clip(self, scale: f32) -> Rect {
        let corner = |[x, y]: [u32; 2]| Pos2::new(x as f32 / scale, y as f32 / scale);
        Rect::from_min_max(corner(self.min), corner(self.max))
    }

    pub(super) fn intersect(self, other: Self) -> Self {
        Self {
            min: [0, 1].map(|axis| self.min[axis].max(other.min[axis])),
            max: [0, 1].map(|axis| self.max[axis].min(other.max[axis])),
        }
    }

    pub(super) fn union(self, other: Self) -> Self {
        Self {
            min: [0, 1].map(|axis| self.min[axis].min(other.min[axis])),
            max: [0, 1].map(|axis| self.max[axis].max(other.max[axis])),
        }
    }

    pub(super) fn contains(self, other: Self) -> bool {
        self.union(other) == self
    }

    pub(super) fn is_empty(self) -> bool {
        self.min[0] >= self.max[0] || self.min[1] >= self.max[1]
    }

    /// Number of pixels of a rectangle that is not empty.
    pub(super) fn area(self) -> u64 {
        let [width, height] = [0, 1].map(|axis| u64::from(self.max[axis] - self.min[axis]));
        width * height
    }
}
