//! From a view in `f64` to what the shaders get in `f32`, and when that is not enough.

use guideway_scene::Rgba;
use guideway_scene::View;

use super::plan::Plan;
use super::shared;
use super::tiles::Tile;

/// Lines leave a mark at most so far from the curve: half a pixel across and half along, and a little more
/// for rounding.
const MARK_PX: f64 = 1.0;
/// Half a step of `f32`, relative.
const HALF_STEP: f64 = f32::EPSILON as f64 / 2.0;
/// Greatest error of a point that the shaders compute from exact control points, as a share of the largest
/// of their coordinates: 3 roundings to pixels, at most 13 in equation 3.2.
const EVALUATION: f64 = 16.0 * HALF_STEP;

/// How far a line that is seen may be off its place, in pixels: by the rounding of control points to `f32`
/// around the origin of the scene, and by the arithmetic of segments that reach out of the view.
pub(super) fn error_px(plan: &Plan, view: &View) -> f64 {
    let size = view.size();
    let half_side_px = f64::from(size.width().max(size.height())) / 2.0 + MARK_PX;
    let stored_px = plan.reach_m * view.px_per_m() * HALF_STEP;
    let computed_px = (half_side_px + plan.longest_m * view.px_per_m()) * EVALUATION;
    stored_px + computed_px
}

/// What the shaders get to draw one tile of a view.
pub(super) fn uniforms(plan: &Plan, view: &View, tile: &Tile, color: Rgba) -> shared::View {
    let center_m = view.center_m() - plan.origin_m;
    let high = center_m.to_f32();
    let low = (center_m - high.to_f64()).to_f32();
    let seen_m = view.world_bounds().inflated(MARK_PX / view.px_per_m());
    let [least, most] = [seen_m.min, seen_m.max].map(|corner| (corner - plan.origin_m).to_f32());
    let size = view.size();
    let (middle_x, middle_y) = tile.viewport_middle();
    shared::View {
        center_high_m: [high.x, high.y],
        center_low_m: [low.x, low.y],
        seen_min_m: [least.x.next_down(), least.y.next_down()],
        seen_max_m: [most.x.next_up(), most.y.next_up()],
        viewport_px: [
            (f64::from(tile.x + middle_x) - f64::from(size.width()) / 2.0) as f32,
            (f64::from(tile.y + middle_y) - f64::from(size.height()) / 2.0) as f32,
        ],
        px_per_m: view.px_per_m() as f32,
        clip_per_px: 2.0 / tile.viewport_side as f32,
        color: rgba(color),
    }
}

/// A color as OpenGL takes it.
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

    /// What the vertex shader does with one coordinate.
    fn pixel(point_m: f32, high_m: f32, low_m: f32, px_per_m: f32) -> f32 {
        ((point_m - high_m) - low_m) * px_per_m
    }

    #[test]
    fn control_points_are_placed_within_the_error_that_is_promised() {
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
                    plan.reach_m * px_per_m * HALF_STEP + 3.0 * HALF_STEP * expected.x.abs();
                let off = (f64::from(x) - expected.x).abs();
                // The view itself knows where 1e7 m is to 2 nm.
                assert!(off <= allowed + 4e-9 * px_per_m, "{off} of {allowed} px");
            }
        }
    }

    #[test]
    fn far_out_is_exact_enough_and_close_in_is_not() {
        assert!(error_px(&plan(500.0, 10.0), &view(1.0)) < 0.01);
        assert!(error_px(&plan(500.0, 10.0), &view(100.0)) < 0.01);
        assert!(error_px(&plan(500.0, 10.0), &view(1e4)) > 0.1, "reach");
        assert!(error_px(&plan(10.0, 10.0), &view(1e3)) < 0.1);
        assert!(error_px(&plan(10.0, 1e3), &view(1e3)) > 0.1, "segments");
    }

    #[test]
    fn the_box_of_what_is_seen_is_never_too_small() {
        let plan = plan(500.0, 10.0);
        for px_per_m in [0.013, 1.0, 77.7] {
            let view = view(px_per_m);
            let tile = Tiling::new(view.size(), 16_384, u64::MAX).unwrap().first();
            let shared = uniforms(&plan, &view, &tile, Rgba::BLACK);
            let seen_m = view.world_bounds();
            for (box_m, edge_m) in [
                (shared.seen_max_m[0], seen_m.max.x - plan.origin_m.x),
                (shared.seen_max_m[1], seen_m.max.y - plan.origin_m.y),
                (-shared.seen_min_m[0], plan.origin_m.x - seen_m.min.x),
                (-shared.seen_min_m[1], plan.origin_m.y - seen_m.min.y),
            ] {
                let margin_px = (f64::from(box_m) - edge_m) * px_per_m;
                assert!((1.0..1.1).contains(&margin_px), "{margin_px} px");
            }
        }
    }
}
