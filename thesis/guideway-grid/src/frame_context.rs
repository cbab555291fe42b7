//! The context of a frame: checks that the method can draw a view, and computes the parameters of
//! its shaders.

use std::ops::Range;

use guideway_scene::{LineRule, NoOpaqueColor, RenderError, Rgba, Scene, Shading, Style, View};
use guideway_spline::{Bounds, Point};

use crate::local::LocalScene;
use crate::options::{Binning, GridOptions};
use crate::params::{GridParams, ViewParams};
use crate::pass::Pass;
use crate::variant::NAME;

/// Largest displacement of a line by rounding, in pixels, before a view is refused.
const MAX_ROUNDING_PX: f64 = 0.1;

/// A view of a scene that the method can draw.
pub(super) struct FrameContext {
    pub(super) view: View,
    pub(super) local: LocalScene,
    pub(super) grid: GridParams,
    /// Cells per side of the grid.
    pub(super) cells: u32,
    params: ViewParams,
}

impl FrameContext {
    /// Checks a view and computes the parameters that all its dispatches share.
    ///
    /// # Errors
    /// When the style or the widths are unsupported, or `f32` is too coarse for the scale.
    pub(super) fn new(
        view: &View,
        style: &Style,
        color: Rgba,
        widths: Widths,
        local: LocalScene,
        grid: GridParams,
        options: &GridOptions,
    ) -> Result<Self, RenderError> {
        let radius_m = radius_m(NAME, view, style, widths, &local)?;
        let px_per_m = view.px_per_m();
        let reach_m = radius_m + options.antialias.margin_px() / px_per_m;
        let (margin_m, excess_m) = match options.binning {
            Binning::LineBox => (0.0, 0.0),
            Binning::LineBoxWithRadius => (reach_m, (reach_m - f64::from(grid.reach_m)).max(0.0)),
        };
        let bounds = local.bounds_m.inflated(margin_m);
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
            color: packed_rgba(color),
            background: packed_rgba(style.background),
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

    /// The parameters of one dispatch: a range of tiles of the pixel rows `rows`.
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

    /// Bounds of everything drawn, in meters from the local origin.
    pub(super) fn draw_bounds_m(&self) -> Bounds<f64> {
        let point = |[x, y]: [f32; 2]| Point::new(f64::from(x), f64::from(y));
        Bounds {
            min: point(self.params.box_low_m),
            max: point(self.params.box_high_m),
        }
    }

    /// Distance by which a line may be visible beyond the cells that list it.
    pub(super) fn excess_m(&self) -> f64 {
        f64::from(self.params.excess_m)
    }
}

/// The widths of the paths of a scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Widths {
    /// One width for all paths; `None` takes the width of the line rule.
    One(Option<f32>),
    /// Different widths.
    Several,
}

impl Widths {
    /// The widths of the drawn paths.
    pub fn of(scene: &Scene) -> Self {
        let mut widths = scene.draw_order().iter().map(|&path| scene.width_m(path));
        let first = widths.next().flatten();
        if widths.all(|width| width == first) {
            Self::One(first)
        } else {
            Self::Several
        }
    }
}

/// The one color of all paths.
///
/// # Errors
/// When paths have several colors or translucent ones.
pub fn opaque_color(method: &'static str, scene: &Scene) -> Result<Rgba, RenderError> {
    scene.opaque_color().map_err(|error| {
        let remedy = match error {
            NoOpaqueColor::Several => "Remove --color-by, or use `--method cpu`.",
            NoOpaqueColor::Translucent => "Use an opaque color, or `--method cpu`.",
        };
        RenderError::unsupported(method, error.to_string(), remedy)
    })
}

/// The radius of all strokes in a view.
///
/// # Errors
/// When the style or the widths are unsupported, or `f32` is too coarse for the scale.
pub fn radius_m(
    method: &'static str,
    view: &View,
    style: &Style,
    widths: Widths,
    local: &LocalScene,
) -> Result<f64, RenderError> {
    if style.shading != Shading::Color {
        return Err(RenderError::unsupported(
            method,
            "shading by density",
            "Use color shading, or `--method cpu`.",
        ));
    }
    let px_per_m = view.px_per_m();
    let width_m = match widths {
        Widths::One(width_m) => width_m,
        // This rule gives all paths the same width and ignores their own.
        Widths::Several if style.line_rule == LineRule::Thesis => None,
        Widths::Several => {
            return Err(RenderError::unsupported(
                method,
                "paths of several widths",
                "Use the line rule of the thesis, or `--method cpu`.",
            ));
        }
    };
    let rounding_px = local.rounding_px(px_per_m);
    if rounding_px > MAX_ROUNDING_PX {
        return Err(RenderError::unsupported(
            method,
            format!(
                "this view: at {px_per_m} pixels per meter the single precision of the device \
                 may draw lines {rounding_px:.2} pixels off; the limit is {MAX_ROUNDING_PX}"
            ),
            "Zoom out, draw a part of the layout, or use `--method cpu`.",
        ));
    }
    // derived: 1e18 exceeds every distance in a scene, and its square does not overflow `f32`.
    Ok((style.line_rule.radius_px(width_m, px_per_m) / px_per_m).clamp(0.0, 1e18))
}

/// Packs a color into the byte order of a picture.
pub fn packed_rgba(color: Rgba) -> u32 {
    u32::from_le_bytes([color.r, color.g, color.b, color.a])
}
