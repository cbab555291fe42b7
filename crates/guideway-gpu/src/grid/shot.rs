//! One view of a scene: what shaders need to know of it, and how much work it is.

use std::ops::Range;

use guideway_render::{RenderError, Shading, Style, View};
use guideway_scene::{LineRule, Rgba};
use guideway_spline::{Bounds, Point};

use super::NAME;
use super::build::Chunk;
use super::cut::Cutter;
use super::local::Local;
use super::options::{Antialias, Binning, GridOptions};
use super::params::{GridParams, HALF_EDGE_PX, TILE_PX, ViewParams};

/// Farthest that a line may be from where it belongs, in pixels.
const MOST_ROUNDING_PX: f64 = 0.1;

/// Distance tests that looking up a cell takes the time of.
const TESTS_A_LOOK: f64 = 2.0;

/// Half of a pixel's diagonal.
const CORNER_PX: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// What is seen.
pub(super) struct Shot {
    view: View,
    local: Local,
    grid: GridParams,
    /// Along each side of the grid.
    cells: u32,
    params: ViewParams,
}

/// The widths of the paths of a scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Widths {
    /// The same for all: their own or that of the rule.
    One(Option<f32>),
    Several,
}

fn unsupported(what: impl Into<String>, remedy: impl Into<String>) -> RenderError {
    RenderError::Unsupported {
        method: NAME,
        what: what.into(),
        remedy: remedy.into(),
    }
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
                "Ask for colour shading, or use `--method cpu`.",
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
                     {px_per_m} pixels a metre may be {rounding_px:.2} pixels off, and {MOST_ROUNDING_PX} \
                     is allowed"
                ),
                "Zoom out, draw a part of the layout, or use `--method cpu`.",
            ));
        }
        // Nothing that `f32` can hold is as far away as this, nor does the square of it overflow.
        let radius_m = (style.line_rule.radius_px(width_m, px_per_m) / px_per_m).clamp(0.0, 1e18);
        let beyond_px = match options.antialias {
            Antialias::Smooth => f64::from(HALF_EDGE_PX),
            Antialias::None => 0.0,
            Antialias::Subpixel => CORNER_PX,
        };
        let reach_m = radius_m + beyond_px / px_per_m;
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
            is_first_chunk: 0,
            is_last_chunk: 0,
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

    /// The view for one dispatch.
    pub(super) fn params(
        &self,
        rows: &Range<u32>,
        tiles: &Range<u32>,
        chunk: usize,
        chunks: usize,
    ) -> ViewParams {
        ViewParams {
            first_row: rows.start,
            rows: rows.end - rows.start,
            first_tile: tiles.start,
            end_tile: tiles.end,
            is_first_chunk: u32::from(chunk == 0),
            is_last_chunk: u32::from(chunk + 1 == chunks),
            ..self.params
        }
    }

    /// Cuts the tiles of a band into what is drawn at a time.
    pub(super) fn cut(
        &self,
        mut cutter: Cutter,
        chunk: &Chunk,
        rows: &Range<u32>,
        tiles_across: u32,
    ) -> Vec<Range<u32>> {
        for top in rows.clone().step_by(TILE_PX as usize) {
            let bottom = rows.end.min(top + TILE_PX);
            cutter.push(tiles_across, self.work(chunk, top, bottom));
        }
        cutter.finish()
    }

    /// Distance tests of some rows of pixels, at most; or other work of that size.
    fn work(&self, chunk: &Chunk, top: u32, bottom: u32) -> u64 {
        let width = f64::from(self.view.size().width());
        let corner = |x: f64, y: u32| {
            let point = Point::new(x, f64::from(y));
            let local = self
                .local
                .local_from_world(self.view.world_from_pixel(point));
            Point::new(f64::from(local[0]), f64::from(local[1]))
        };
        let seen = Bounds::of_points([corner(0.0, bottom), corner(width, top)]);
        let Some(seen) = seen else { return 0 };
        let pixels = width * f64::from(bottom - top);
        if !seen.intersects(self.box_m()) {
            return pixels as u64;
        }
        let across = self.axis(0, seen.min.x, seen.max.x, width);
        let down = self.axis(1, seen.min.y, seen.max.y, f64::from(bottom - top));
        let lines = chunk.table.within(across.cells.clone(), down.cells.clone());
        let tests = lines as f64 * across.pixels_a_cell * down.pixels_a_cell;
        let looks = pixels * across.cells_a_pixel * down.cells_a_pixel;
        (tests + looks * TESTS_A_LOOK) as u64
    }

    fn box_m(&self) -> Bounds<f64> {
        let point = |[x, y]: [f32; 2]| Point::new(f64::from(x), f64::from(y));
        Bounds {
            min: point(self.params.box_low_m),
            max: point(self.params.box_high_m),
        }
    }

    /// Which cells the pixels from `low_m` to `high_m` look into, so many pixels there are.
    fn axis(&self, axis: usize, low_m: f64, high_m: f64, pixels: f64) -> Axis {
        let per_m = f64::from(self.grid.cells_per_m[axis]);
        let excess_m = f64::from(self.params.excess_m);
        let cell = |at_m: f64| ((at_m - f64::from(self.grid.origin_m[axis])) * per_m).floor();
        // One cell more on each side makes up for rounding.
        let cells = f64::from(self.cells);
        let first = (cell(low_m - excess_m) - 1.0).clamp(0.0, cells - 1.0);
        let end = (cell(high_m + excess_m) + 2.0).clamp(1.0, cells);
        let cell_px = self.view.px_per_m() * (1.0 / per_m + 2.0 * excess_m) + 1.0;
        Axis {
            cells: first as usize..end as usize,
            pixels_a_cell: pixels.min(cell_px),
            cells_a_pixel: (2.0 * excess_m * per_m + 1.0).min(cells),
        }
    }
}

/// How pixels and cells meet along one axis.
struct Axis {
    cells: Range<usize>,
    /// Most pixels that look into one cell.
    pixels_a_cell: f64,
    /// Most cells that one pixel looks into.
    cells_a_pixel: f64,
}

/// A colour as it is in the bytes of a picture.
fn in_bytes(color: Rgba) -> u32 {
    u32::from_le_bytes([color.r, color.g, color.b, color.a])
}
