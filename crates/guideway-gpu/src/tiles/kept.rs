//! A finished picture, and what of it a view moved by whole pixels can keep.

use guideway_scene::{RenderError, Stage, Style, View};
use guideway_spline::Bounds;
use wgpu::BufferUsages;

use super::bound::Bound;
use super::canvas::Canvas;
use super::params::{Cluster, ShiftParams, TILE_PX, WORKGROUP};
use super::prepared::PreparedTiles;
use super::shot::Shot;
use super::window::Window;
use crate::device::{DeviceBuffer, Dispatch};

/// Farthest from whole pixels that a moved picture may be, all moves since it was drawn together.
const MOST_DRIFT_PX: f64 = 1.0 / 256.0;

/// What the buffer of pixels shows.
#[derive(Clone, Copy, PartialEq)]
pub(super) struct Kept {
    /// The view that it was drawn for before it was moved.
    drawn: View,
    /// That of the picture as it is.
    shown: View,
    style: Style,
    /// How far it has been moved since it was drawn.
    moved_px: [i32; 2],
    /// What edits have touched since: a box that holds it, and its greatest width, if any has one of its own.
    touched: Option<(Bounds<f64>, Option<f32>)>,
}

/// What to do for the next picture.
pub(super) struct Move {
    pub(super) kept: Kept,
    /// None if it is the same view.
    shift: Option<ShiftParams>,
    /// What came into view, or was touched.
    pub(super) windows: Vec<Window>,
}

/// What part of the tiles edits may have touched, at most, where the others are kept.
const MOST_TOUCHED: usize = 2;

impl Kept {
    pub(super) fn new(view: &View, style: &Style) -> Self {
        Self {
            drawn: *view,
            shown: *view,
            style: *style,
            moved_px: [0, 0],
            touched: None,
        }
    }

    /// After an edit of these clusters, whose boxes hold what they were and what they are.
    pub(super) fn touch<'a>(&mut self, clusters: impl Iterator<Item = &'a Cluster>) {
        for cluster in clusters {
            let (bounds, width_m) = (cluster.bounds(), cluster.width_m());
            self.touched = Some(match self.touched {
                Some((all, widest_m)) => (all.union(bounds), max_of(widest_m, width_m)),
                None => (bounds, width_m),
            });
        }
    }

    /// How to get to another view: the same moved by whole pixels, and not out of sight, or one that edits have touched
    /// little of. None if there is nothing to keep.
    pub(super) fn moved_to(&self, shot: &Shot<'_>, canvas: &Canvas) -> Option<Move> {
        let (old, view, size) = (&self.drawn, shot.view, shot.view.size());
        let is_alike = old.px_per_m() == view.px_per_m() && old.size() == size;
        if !is_alike || self.style != *shot.style || !canvas.is_whole() {
            return None;
        }
        let touched = self
            .touched
            .map(|(bounds, widest_m)| shot.marked_tiles(bounds, widest_m, canvas));
        let tiles = canvas.columns as usize * canvas.rows as usize;
        if touched
            .as_ref()
            .is_some_and(|window| window.tiles() > tiles / MOST_TOUCHED)
        {
            return None;
        }
        let (moved_px, shift) = if self.shown == *view {
            // Without an edit, it is drawn again.
            touched.as_ref()?;
            (self.moved_px, None)
        } else {
            let moved_px = self.move_px(view)?;
            let [right_px, down_px] = [0, 1].map(|axis| moved_px[axis] - self.moved_px[axis]);
            let shift = ShiftParams {
                width_px: size.width(),
                height_px: size.height(),
                right_px,
                down_px,
            };
            (moved_px, Some(shift))
        };
        let mut windows = shift.map_or(Vec::new(), |shift| {
            uncovered([shift.right_px, shift.down_px], canvas)
        });
        windows.extend(touched.filter(|window| window.tiles() > 0));
        Some(Move {
            kept: Self {
                shown: *view,
                moved_px,
                touched: None,
                ..*self
            },
            shift,
            windows,
        })
    }

    /// How far to move what was drawn for a view of its scale; none unless it is by whole pixels, farther or less far than it
    /// has been moved, and not out of sight.
    fn move_px(&self, view: &View) -> Option<[i32; 2]> {
        let offset_px = (view.center_m() - self.drawn.center_m()) * view.px_per_m();
        // The picture's y goes down.
        let offset_px = [offset_px.x, -offset_px.y];
        let whole_px = offset_px.map(f64::round);
        let drift_px = [0, 1].map(|axis| (offset_px[axis] - whole_px[axis]).abs());
        let size_px = [view.size().width(), view.size().height()].map(f64::from);
        let step_px = [0, 1].map(|axis| whole_px[axis] - f64::from(self.moved_px[axis]));
        let is_near = [0, 1].iter().all(|&axis| {
            drift_px[axis] <= MOST_DRIFT_PX
                && step_px[axis].abs() < size_px[axis]
                && whole_px[axis].abs() < f64::from(i32::MAX)
        });
        (is_near && step_px != [0.0, 0.0]).then(|| whole_px.map(|px| px as i32))
    }
}

fn max_of(a: Option<f32>, b: Option<f32>) -> Option<f32> {
    a.into_iter().chain(b).reduce(f32::max)
}

/// The tiles that a picture moved by so much does not reach: whole rows, and the columns of the others.
fn uncovered([right_px, down_px]: [i32; 2], canvas: &Canvas) -> Vec<Window> {
    let new = |step_px: i32, size_px: u32, tiles: u32| {
        let kept_px = size_px - step_px.unsigned_abs();
        match step_px {
            0 => 0..0,
            1.. => kept_px / TILE_PX..tiles,
            _ => 0..step_px.unsigned_abs().div_ceil(TILE_PX).min(tiles),
        }
    };
    let rows = new(down_px, canvas.size.height(), canvas.rows);
    let columns = new(right_px, canvas.size.width(), canvas.columns);
    let others = if rows.is_empty() {
        0..canvas.rows
    } else if rows.start == 0 {
        rows.end..canvas.rows
    } else {
        0..rows.start
    };
    let all = Window {
        columns: 0..canvas.columns,
        rows,
    };
    let side = Window {
        columns,
        rows: others,
    };
    let is_there = |window: &Window| window.tiles() > 0;
    [all, side].into_iter().filter(is_there).collect()
}

/// Buffers that a picture is moved with.
pub(super) struct Shifter {
    params: DeviceBuffer,
    /// The one that is not the canvas's.
    pixels: DeviceBuffer,
    /// What a frame binds while that one is the canvas's.
    pub(super) bound: Option<Bound>,
}

impl PreparedTiles {
    /// Moves what is kept to where the view has it now; none if nothing can be kept.
    pub(super) fn move_kept(
        &mut self,
        shot: &Shot<'_>,
        stages: &mut Vec<Stage>,
    ) -> Result<Option<Move>, RenderError> {
        let (Some(kept), Some(canvas)) = (self.easel.kept.take(), &mut self.easel.canvas) else {
            return Ok(None);
        };
        let Some(moved) = kept.moved_to(shot, canvas) else {
            return Ok(None);
        };
        let Some(shift) = &moved.shift else {
            return Ok(Some(moved));
        };
        let shifter = match &mut self.easel.shifter {
            Some(shifter) => shifter,
            None if canvas.pixels.bytes() > self.memory.spare_bytes() => return Ok(None),
            empty => {
                let usage = BufferUsages::UNIFORM | BufferUsages::COPY_DST;
                let bytes = size_of::<ShiftParams>() as u64;
                empty.insert(Shifter {
                    params: self.memory.zeros("the view", bytes, usage)?,
                    pixels: canvas.more_pixels(&mut self.memory)?,
                    bound: None,
                })
            }
        };
        std::mem::swap(&mut canvas.pixels, &mut shifter.pixels);
        std::mem::swap(&mut self.easel.bound, &mut shifter.bound);
        let gpu = &self.shared.gpu;
        let kernel = &self.shared.kernels.shift;
        let run = || {
            self.runner.set("the view", &shifter.params, shift)?;
            let buffers = [&shifter.params, &shifter.pixels, &canvas.pixels];
            let bindings = kernel.bind(gpu, &buffers)?;
            let pixels = canvas.size.pixels() as u32;
            let dispatch = Dispatch {
                kernel,
                bindings: &bindings,
                workgroups: pixels.div_ceil(WORKGROUP),
            };
            self.runner
                .run_stages("the frame", &[], &[("move", &[dispatch])])
        };
        let run: Result<_, String> = run();
        Stage::merge(stages, run.map_err(|what| self.memory.trouble(what))?);
        Ok(Some(moved))
    }
}
