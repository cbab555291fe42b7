//! A finished picture, and what of it a view moved by whole pixels can keep.

use guideway_render::{RenderError, Stage, Style, View};
use wgpu::BufferUsages;

use super::bound::Bound;
use super::canvas::Canvas;
use super::params::{ShiftParams, TILE_PX, WORKGROUP};
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
    style: Style,
    /// How far it has been moved since.
    moved_px: [i32; 2],
}

/// What to do for the next picture.
pub(super) struct Move {
    pub(super) kept: Kept,
    pub(super) shift: ShiftParams,
    /// What came into view.
    pub(super) windows: Vec<Window>,
}

impl Kept {
    pub(super) fn new(view: &View, style: &Style) -> Self {
        Self {
            drawn: *view,
            style: *style,
            moved_px: [0, 0],
        }
    }

    /// How to get to another view; none unless it is the same moved by whole pixels, and not out of sight.
    pub(super) fn moved_to(&self, view: &View, style: &Style, canvas: &Canvas) -> Option<Move> {
        let (old, size) = (&self.drawn, view.size());
        let is_alike = old.px_per_m() == view.px_per_m() && old.size() == size;
        if !is_alike || self.style != *style || !canvas.is_whole() {
            return None;
        }
        let offset_px = (view.center_m() - old.center_m()) * view.px_per_m();
        // The picture's y goes down.
        let offset_px = [offset_px.x, -offset_px.y];
        let whole_px = offset_px.map(f64::round);
        let drift_px = [0, 1].map(|axis| (offset_px[axis] - whole_px[axis]).abs());
        let size_px = [size.width(), size.height()].map(f64::from);
        let step_px = [0, 1].map(|axis| whole_px[axis] - f64::from(self.moved_px[axis]));
        let is_near = [0, 1].iter().all(|&axis| {
            drift_px[axis] <= MOST_DRIFT_PX
                && step_px[axis].abs() < size_px[axis]
                && whole_px[axis].abs() < f64::from(i32::MAX)
        });
        if !is_near || step_px == [0.0, 0.0] {
            return None;
        }
        let [right_px, down_px] = step_px.map(|px| px as i32);
        Some(Move {
            kept: Self {
                moved_px: whole_px.map(|px| px as i32),
                ..*self
            },
            shift: ShiftParams {
                width_px: size.width(),
                height_px: size.height(),
                right_px,
                down_px,
            },
            windows: uncovered([right_px, down_px], canvas),
        })
    }
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
    let is_there = |window: &Window| !window.rows.is_empty() && !window.columns.is_empty();
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
        let Some(moved) = kept.moved_to(shot.view, shot.style, canvas) else {
            return Ok(None);
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
            self.runner.set("the view", &shifter.params, &moved.shift)?;
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
