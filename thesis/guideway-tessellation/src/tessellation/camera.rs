//! Converts a view from `f64` to the `f32` uniforms of the shaders, and bounds the rounding error.

use guideway_scene::{Rgba, View};

use super::plan::Plan;
use super::shared;
use super::tiles::Tile;

/// Largest distance of a changed pixel from the curve. derived: half a pixel across and half a
/// pixel along the line, rounded up.
const MARGIN_PX: f64 = 1.0;
/// Relative rounding error of `f32`.
const HALF_ULP: f64 = f32::EPSILON as f64 / 2.0;
/// Error of a point that the shaders compute from exact control points, relative to their largest
/// coordinate. derived: 3 roundings to pixels and at most 13 in equation 3.2.
const EVALUATION_ERROR: f64 = 16.0 * HALF_ULP;

/// Upper bound of the displacement of a visible line, in pixels: by rounding control points to
/// `f32` around the origin of the scene, and by the arithmetic of segments that extend past the
/// view.
pub(super) fn error_px(plan: &Plan, view: &View) -> f64 {
    let size = view.size();
    let half_side_px = f64::from(size.width().max(size.height())) / 2.0 + MARGIN_PX;
    let stored_px = plan.reach_m * view.px_per_m() * HALF_ULP;
    let computed_px = (half_side_px + plan.longest_m * view.px_per_m()) * EVALUATION_ERROR;
    stored_px + computed_px
}

/// The uniforms for one tile of a view.
pub(super) fn uniforms(plan: &Plan, view: &View, tile: &Tile, color: Rgba) -> shared::View {
    let center_m = view.center_m() - plan.origin_m;
    let high = center_m.to_f32();
    let low = (center_m - high.to_f64()).to_f32();
    let visible_m = view.world_bounds().inflated(MARGIN_PX / view.px_per_m());
    let corners = [visible_m.min, visible_m.max];
    let [min, max] = corners.map(|corner| (corner - plan.origin_m).to_f32());
    let size = view.size();
    let (center_x, center_y) = tile.viewport_center();
    shared::View {
        center_high_m: [high.x, high.y],
        center_low_m: [low.x, low.y],
        visible_min_m: [min.x.next_down(), min.y.next_down()],
        visible_max_m: [max.x.next_up(), max.y.next_up()],
        viewport_px: [
            (f64::from(tile.x + center_x) - f64::from(size.width()) / 2.0) as f32,
            (f64::from(tile.y + center_y) - f64::from(size.height()) / 2.0) as f32,
        ],
        px_per_m: view.px_per_m() as f32,
        clip_per_px: 2.0 / tile.viewport_side as f32,
        color: rgba(color),
    }
}

/// Converts a color to OpenGL's channels from 0 to 1.
pub(super) fn rgba(color: Rgba) -> [f32; 4] {
    [color.r, color.g, color.b, color.a].map(|channel| f32::from(channel) / 255.0)
}

#[cfg(test)]
mod tests {
    use guideway_scene::FrameSize;
    use guideway_spline::Point;

    use super::*;
    use crate::tessellation::tiles::Tiling;

    fn plan(reach_m: f64, longest_m: f64) -> Plan {
        Plan {
            origin_m: Point::new(1e7, -1e7),
            reach_m,
            longest_m,
            widths: crate::tessellation::plan::Widths::default(),
            smallest_m: 1.0,
            chunks: Vec::new(),
        }
    }

    fn view(px_per_m: f64) -> View {
        let size = FrameSize::new(1920, 1080).unwrap();
        View::new(size, Point::new(1e7 + 123.456_789, -1e7 - 0.1), px_per_m).unwrap()
    }

    /// The vertex shader's conversion of one coordinate.
    fn pixel(point_m: f32, high_m: f32, low_m: f32, px_per_m: f32) -> f32 {
        ((point_m - high_m) - low_m) * px_per_m
    }

    #[test]
    fn control_points_are_within_the_error_bound() {
        let plan = plan(500.0, 20.0);
        for px_per_m in [0.5, 10.0, 1000.0] {
            let view = view(px_per_m);
            let tile = Tiling::new(view.size(), 16_384, u64::MAX).unwrap().first();
            let shared = uniforms(&plan, &view, &tile, Rgba::BLACK);
            let center_px = view.pixel_from_world(view.center_m());
            for i in -500..=500 {
                let point_m = Point::new(f64::from(i) * 0.987_654, f64::from(-i) * 0.444);
                let expected = view.pixel_from_world(plan.origin_m + point_m) - center_px;
                let stored = point_m.to_f32();
                let x = pixel(
                    stored.x,
                    shared.center_high_m[0],
                    shared.center_low_m[0],
                    shared.px_per_m,
                );
                let allowed =
                    plan.reach_m * px_per_m * HALF_ULP + 3.0 * HALF_ULP * expected.x.abs();
                let off = (f64::from(x) - expected.x).abs();
                // At 1e7 m the view itself is exact to 2 nm.
                assert!(off <= allowed + 4e-9 * px_per_m, "{off} of {allowed} px");
            }
        }
    }

    #[test]
    fn error_exceeds_the_limit_only_at_large_scales() {
        assert!(error_px(&plan(500.0, 10.0), &view(1.0)) < 0.01);
        assert!(error_px(&plan(500.0, 10.0), &view(100.0)) < 0.01);
        assert!(error_px(&plan(500.0, 10.0), &view(1e4)) > 0.1, "reach");
        assert!(error_px(&plan(10.0, 10.0), &view(1e3)) < 0.1);
        assert!(error_px(&plan(10.0, 1e3), &view(1e3)) > 0.1, "segments");
    }

    #[test]
    fn visible_bounds_include_the_margin() {
        let plan = plan(500.0, 10.0);
        for px_per_m in [0.013, 1.0, 77.7] {
            let view = view(px_per_m);
            let tile = Tiling::new(view.size(), 16_384, u64::MAX).unwrap().first();
            let shared = uniforms(&plan, &view, &tile, Rgba::BLACK);
            let visible_m = view.world_bounds();
            for (box_m, edge_m) in [
                (shared.visible_max_m[0], visible_m.max.x - plan.origin_m.x),
                (shared.visible_max_m[1], visible_m.max.y - plan.origin_m.y),
                (-shared.visible_min_m[0], plan.origin_m.x - visible_m.min.x),
                (-shared.visible_min_m[1], plan.origin_m.y - visible_m.min.y),
            ] {
                let margin_px = (f64::from(box_m) - edge_m) * px_per_m;
                assert!((1.0..1.1).contains(&margin_px), "{margin_px} px");
            }
        }
    }
}
