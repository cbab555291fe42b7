//! The level of detail (LOD) that lines are flattened for. Views of similar scale and place share
//! one, and so the lines. The LOD depends on the view alone.

use guideway_scene::View;
use guideway_spline::Point;

/// LOD scales per doubling of the view scale. Derived: the scales of LOD and view differ by at most
/// 9 %.
const LODS_PER_DOUBLING: f64 = 4.0;
/// LOD centers per picture width, or height if that is greater.
const CENTERS_PER_PICTURE: f64 = 16.0;
/// Distance from the visible area to where lines are clipped, in pixels: hides caps at cuts.
const CLIP_MARGIN_PX: f64 = 3.0;
/// Number of fixed-point coordinates of a line's end. Derived: 23 bits.
const LINE_STEPS: f64 = 8_388_608.0;

/// Scale and place that lines are flattened for. LOD pixels count from the center; y points down.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct LineLod {
    pub(crate) px_per_m: f64,
    pub(crate) center_m: Point<f64>,
    /// Half the extent along each axis, from the center.
    pub(crate) reach_px: [f64; 2],
}

impl LineLod {
    /// The LOD of a view. `radius_px` is the greatest radius of a stroke at a scale, and must not
    /// fall with the scale.
    pub(crate) fn of(view: &View, radius_px: impl Fn(f64) -> f64) -> Self {
        let number = (view.px_per_m().log2() * LODS_PER_DOUBLING).round();
        let px_per_m = (number / LODS_PER_DOUBLING).exp2();
        let size_px = [view.size().width(), view.size().height()].map(f64::from);
        let grid_px = (size_px[0].max(size_px[1]) / CENTERS_PER_PICTURE).ceil();
        let grid_m = grid_px / px_per_m;
        let snapped = |m: f64| (m / grid_m).round() * grid_m;
        let center_m = view.center_m();
        // The views of the LOD show slightly more of it, or less, than it has pixels.
        let max_ratio = (0.5 / LODS_PER_DOUBLING).exp2();
        let margin_px = (radius_px(px_per_m * max_ratio) + CLIP_MARGIN_PX) * max_ratio;
        Self {
            px_per_m,
            center_m: Point::new(snapped(center_m.x), snapped(center_m.y)),
            reach_px: size_px.map(|px| (px * max_ratio / 2.0 + grid_px / 2.0 + margin_px).ceil()),
        }
    }

    /// Fixed-point steps per LOD pixel.
    pub(crate) fn steps_per_px(&self) -> f64 {
        // One pixel to spare for rounding.
        LINE_STEPS / (2.0 * (self.reach_px[0].max(self.reach_px[1]) + 1.0))
    }

    /// LOD pixels per pixel of the view.
    pub(crate) fn px_per_view_px(&self, view: &View) -> f64 {
        self.px_per_m / view.px_per_m()
    }

    /// The center in the picture of a view.
    pub(crate) fn origin_px(&self, view: &View) -> Point<f64> {
        view.pixel_from_world(self.center_m)
    }
}

#[cfg(test)]
mod tests {
    use guideway_scene::FrameSize;

    use super::*;

    fn view(center: [f64; 2], px_per_m: f64) -> View {
        let size = FrameSize::new(1920, 1080).unwrap();
        View::new(size, Point::new(center[0], center[1]), px_per_m).unwrap()
    }

    #[test]
    fn lod_contains_all_of_its_views() {
        let radius_px = |px_per_m: f64| 0.5 * px_per_m;
        let mut lods = Vec::new();
        for i in 0..400 {
            let f = f64::from(i);
            let view = view([1e6 + 0.013 * f, -7.0 * f], 3.0 * (0.004 * f).exp());
            let lod = LineLod::of(&view, radius_px);
            let ratio = lod.px_per_view_px(&view);
            assert!((0.91..1.1).contains(&ratio), "{ratio}");
            let origin = lod.origin_px(&view);
            let reach_px = radius_px(view.px_per_m()) + 1.0;
            for (center, size, reach) in [
                (origin.x, 1920.0, lod.reach_px[0]),
                (origin.y, 1080.0, lod.reach_px[1]),
            ] {
                assert!((center + reach_px) * ratio <= reach, "{view:?}");
                assert!((size - center + reach_px) * ratio <= reach, "{view:?}");
            }
            assert!(lod.steps_per_px() > 2048.0);
            lods.push(lod);
        }
        lods.dedup();
        assert!((10..300).contains(&lods.len()), "{}", lods.len());
    }

    #[test]
    fn nearby_views_share_a_lod() {
        let lod = |center, px_per_m| LineLod::of(&view(center, px_per_m), |_| 1.0);
        let first = lod([0.0, 0.0], 2.0);
        assert_eq!(lod([10.0, -10.0], 2.1), first);
        assert_ne!(lod([0.0, 0.0], 2.4), first);
        assert_ne!(lod([100.0, 0.0], 2.0), first);
    }
}
