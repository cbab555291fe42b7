//! Lines of one stroke width that wait until they fill a batch, with the path of each.

use guideway_spline::Point;

use super::capsule::Capsule;
use super::coverage_mask::{CoverageMask, PixelBox};
use super::line_batch::{LineBatch, LineBoxes, LineSlopes, OpenRows};
use crate::cpu::flatten::polylines::bits_below;
use crate::cpu::ground::samples::LAYERED;
use crate::cpu::ground::tile::LANES;

/// At most sixteen lines, in columns from the tile's corner.
#[derive(Default)]
pub(crate) struct WaitingLines {
    x: [[f32; LANES]; 2],
    y: [[f32; LANES]; 2],
    paths: [u32; LANES],
    len: usize,
    /// Half the stroke width of all these lines, in columns.
    pub(crate) radius: f32,
}

impl WaitingLines {
    /// Adds a line of a path. Returns `true` if the batch is full then: it must be taken.
    #[inline(always)]
    pub(crate) fn push(&mut self, start: Point<f32>, end: Point<f32>, path: u32) -> bool {
        self.x[0][self.len] = start.x;
        self.x[1][self.len] = end.x;
        self.y[0][self.len] = start.y;
        self.y[1][self.len] = end.y;
        self.paths[self.len] = path;
        self.len += 1;
        self.len == LANES
    }

    /// Takes the lines out; `None` if none of them touches a block of pixels with an open one.
    #[inline(always)]
    pub(crate) fn take(&mut self, mask: &CoverageMask<LAYERED>) -> Option<TakenLines> {
        let batch = LineBatch::new(self.x, self.y, self.radius);
        let boxes = batch.boxes();
        let open = boxes.open(mask.open());
        let visible = bits_below(self.len) & open.lines;
        self.len = 0;
        if visible == 0 {
            return None;
        }
        Some(TakenLines {
            slopes: batch.slopes(),
            paths: self.paths,
            visible,
            batch,
            boxes,
            open,
        })
    }
}

/// The lines of a batch.
pub(crate) struct TakenLines {
    batch: LineBatch<LAYERED>,
    boxes: LineBoxes,
    open: OpenRows,
    slopes: LineSlopes,
    /// The path of each line.
    pub(crate) paths: [u32; LANES],
    /// One bit per line that may touch open pixels.
    pub(crate) visible: u32,
}

impl TakenLines {
    /// The pixels of a line that may be open.
    #[inline(always)]
    pub(crate) fn pixel_box(&self, lane: usize) -> PixelBox {
        self.boxes.pixel_box(lane, &self.open)
    }

    /// The capsule around a line.
    #[inline(always)]
    pub(crate) fn capsule(&self, lane: usize) -> Capsule {
        self.batch.capsule(&self.slopes, lane)
    }
}
