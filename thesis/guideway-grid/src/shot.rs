//! One view of a scene: whether it can be drawn, and what shaders need to know of it.

use std::ops::Range;

use guideway_scene::{LineRule, Rgba};
use guideway_scene::{RenderError, Shading, Style, View};
use guideway_spline::{Bounds, Point};

use crate::local::Local;
use crate::options::{Binning, GridOptions};
use crate::params::{GridParams, ViewParams};
use crate::pass::Pass;
use crate::unsupported;

/// Farthest that a line may be from where it belongs, in pixels.
const MOST_ROUNDING_PX: f64 = 0.1;

/// What is seen.
pub(super) struct Shot {
    pub(super) view: View,
    pub(super) local: Local,
    pub(super) grid: GridParams,
    /// Along each side of the grid.
    pub(super) cells: u32,
    params: ViewParams,
}

/// The widths of the paths of a scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Widths {
    /// The same for all: their own or that of the rule.
    One(Option<f32>),
    Several,
}

impl Shot {
    /// A view, unless the method cannot draw it.
    pub(super) fn new(
        view: &View,
        style: &Style,
        color: Rgba,
        widths: Widths,
        local: Local,
        grid: GridParams,
        options: &GridOptions,
    ) -> Result<Self, RenderError> {
        if style.shading != Shading::Color {
            return Err(unsupported(
                "how many paths cover a pixel",
                "Ask for color shading, or use `--method cpu`.",
            ));
        }
        let px_per_m = view.px_per_m();
        let width_m = match widths {
            Widths::One(width_m) => width_m,
            // A rule that gives all paths one width does not ask for theirs.
            Widths::Several if style.line_rule == LineRule::Thesis => None,
            Widths::Several => {
                return Err(unsupported(
                    "paths of several widths",
                    "Ask for the line rule of the thesis, or use `--method cpu`.",
                ));
            }
        };
        let rounding_px = local.rounding_px(px_per_m);
        if rounding_px > MOST_ROUNDING_PX {
            return Err(unsupported(
                format!(
                    "this view: in the single precision of the device, lines of so large a scene at \
                     {px_per_m} pixels a meter may be {rounding_px:.2} pixels off, and {MOST_ROUNDING_PX} \
                     is allowed"
                ),
                "Zoom out, draw a part of the layout, or use `--method cpu`.",
            ));
        }
        // Nothing that `f32` can hold is as far away as this, nor does the square of it overflow.
        let radius_m = (style.line_rule.radius_px(width_m, px_per_m) / px_per_m).clamp(0.0, 1e18);
        let reach_m = radius_m + options.antialias.beyond_px() / px_per_m;
        let (beyond_box_m, excess_m) = match options.binning {
            Binning::LineBox => (0.0, 0.0),
            Binning::LineBoxWithRadius => (reach_m, (reach_m - f64::from(grid.reach_m)).max(0.0)),
        };
        let bounds = local.bounds_m.inflated(beyond_box_m);
        let side = |point: Point<f64>| [point.x as f32, point.y as f32];
        let size = view.size();
        let half = |side: u32| (f64::from(side) / 2.0) as f32;
        let params = ViewParams {
            center_m: local.local_from_world(view.center_m()),
            half_size_px: [half(size.width()), half(size.height())],
            box_low_m: side(bounds.min),
            box_high_m: side(bounds.max),
            excess_m: excess_m as f32,
            m_per_px: (1.0 / px_per_m) as f32,
            px_per_m: px_per_m as f32,
            radius_m: radius_m as f32,
            color: in_bytes(color),
            background: in_bytes(style.background),
            width_px: size.width(),
            first_row: 0,
            rows: 0,
            first_tile: 0,
            end_tile: 0,
            first_cell_row: 0,
            end_cell_row: 0,
            first_line: 0,
            end_line: 0,
            is_first_pass: 0,
            is_last_pass: 0,
            padding: 0,
        };
        Ok(Self {
            view: *view,
            local,
            grid,
            cells: options.cells,
            params,
        })
    }

    /// The view for one dispatch: these rows of pixels and tiles of them.
    pub(super) fn params(&self, rows: &Range<u32>, tiles: &Range<u32>, pass: &Pass) -> ViewParams {
        ViewParams {
            first_row: rows.start,
            rows: rows.end - rows.start,
            first_tile: tiles.start,
            end_tile: tiles.end,
            first_cell_row: pass.cell_rows.start,
            end_cell_row: pass.cell_rows.end,
            first_line: pass.lines.start,
            end_line: pass.lines.end,
            is_first_pass: u32::from(pass.is_first),
            is_last_pass: u32::from(pass.is_last),
            ..self.params
        }
    }

    /// Corners of the box outside of which nothing is drawn, in meters from the middle of the scene.
    pub(super) fn box_m(&self) -> Bounds<f64> {
        let point = |[x, y]: [f32; 2]| Point::new(f64::from(x), f64::from(y));
        Bounds {
            min: point(self.params.box_low_m),
            max: point(self.params.box_high_m),
        }
    }

    /// How far beyond the cells where it is entered a line may be seen.
    pub(super) fn excess_m(&self) -> f64 {
        f64::from(self.params.excess_m)
    }
}

/// A color as it is in the bytes of a picture.
fn in_bytes(color: Rgba) -> u32 {
    u32::from_le_bytes([color.r, color.g, color.b, color.a])
}
