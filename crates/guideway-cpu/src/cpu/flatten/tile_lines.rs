//! Polylines relative to a tile: maps cached or clipped vertices to sample columns.

use guideway_spline::Point;

use super::polylines::{Coordinate, Polylines};
use crate::cpu::ground::samples::SamplePattern;

/// Polylines, mapped to a tile of `C` sample columns per pixel: columns from its upper left corner.
pub(crate) struct TileLines<'a, T, const C: usize> {
    pub(crate) lines: &'a Polylines<T>,
    /// Columns per unit of the vertices.
    pub(crate) scale: f32,
    /// Origin of the vertices, in columns.
    pub(crate) offset: Point<f32>,
}

impl<'a, T, const C: usize> TileLines<'a, T, C> {
    /// Cached lines: one unit is `unit_px` pixels, and their origin lies at `origin_px` from the
    /// corner.
    #[inline(always)]
    pub(crate) fn cached(lines: &'a Polylines<T>, unit_px: f64, origin_px: Point<f64>) -> Self {
        let columns_per_px = C as f64;
        Self {
            lines,
            scale: (unit_px * columns_per_px) as f32,
            offset: (origin_px * columns_per_px).to_f32(),
        }
    }

    /// Clipped lines: in pixels of the picture, in which the corner of the tile lies at
    /// `corner_px`.
    #[inline(always)]
    pub(crate) fn clipped(lines: &'a Polylines<T>, corner_px: Point<f64>) -> Self {
        let columns = C as f32;
        Self {
            lines,
            scale: columns,
            offset: corner_px.to_f32() * -columns,
        }
    }
}

impl<T: Coordinate, const C: usize> TileLines<'_, T, C> {
    /// A vertex, in columns.
    #[inline(always)]
    pub(crate) fn vertex(&self, vertex: usize) -> Point<f32> {
        let map = |v: T, offset: f32| SamplePattern::<C>::snap(v.into() * self.scale) + offset;
        Point {
            x: map(self.lines.x[vertex], self.offset.x),
            y: map(self.lines.y[vertex], self.offset.y),
        }
    }
}
