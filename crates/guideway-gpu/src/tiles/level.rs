//! The scale and place that lines are made for. Views of about the same share a level, and so the lines: which level it is
//! says the view alone.

use guideway_scene::View;
use guideway_spline::Point;

/// Levels for each doubling of the scale: lines are made for one that differs from the view's by a twelfth at most.
const LEVELS_A_DOUBLING: f64 = 4.0;
/// So many parts of a picture the view may move, or few more, until its level has another place.
const PLACES_A_PICTURE: f64 = 16.0;
/// Farthest that a line goes on where it is cut, beyond what its stroke reaches, in pixels; and some to spare.
const BEYOND_PX: f64 = 3.0;
/// Numbers that an end of a line is one of.
const LINE_STEPS: f64 = 8_388_608.0;

/// What lines are made for. Its pixels count from its middle; y goes down.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Level {
    pub(super) px_per_m: f64,
    pub(super) center_m: Point<f64>,
    /// How far from the middle lines may reach.
    pub(super) reach_px: [f64; 2],
}

impl Level {
    /// That of a view, where strokes have at most such a radius in pixels at a scale, never a smaller one at a greater scale.
    pub(super) fn of(view: &View, widest_px: impl Fn(f64) -> f64) -> Self {
        let number = (view.px_per_m().log2() * LEVELS_A_DOUBLING).round();
        let px_per_m = (number / LEVELS_A_DOUBLING).exp2();
        let size_px = [view.size().width(), view.size().height()].map(f64::from);
        let place_px = (size_px[0].max(size_px[1]) / PLACES_A_PICTURE).ceil();
        let place_m = place_px / px_per_m;
        let snapped = |m: f64| (m / place_m).round() * place_m;
        let center_m = view.center_m();
        // The views of the level see a little more of it, or less, than it has pixels.
        let most_apart = (0.5 / LEVELS_A_DOUBLING).exp2();
        let beyond_px = (widest_px(px_per_m * most_apart) + BEYOND_PX) * most_apart;
        Self {
            px_per_m,
            center_m: Point::new(snapped(center_m.x), snapped(center_m.y)),
            reach_px: size_px.map(|px| (px * most_apart / 2.0 + place_px / 2.0 + beyond_px).ceil()),
        }
    }

    /// Steps a pixel that ends of lines are counted in, of which there are as many from border to border.
    pub(super) fn steps_a_px(&self) -> f64 {
        // One to spare, for rounding.
        LINE_STEPS / (2.0 * (self.reach_px[0].max(self.reach_px[1]) + 1.0))
    }

    /// Pixels of it that one of the view is.
    pub(super) fn px_a_px(&self, view: &View) -> f64 {
        self.px_per_m / view.px_per_m()
    }

    /// Where its middle is in the picture of a view.
    pub(super) fn origin_px(&self, view: &View) -> Point<f64> {
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
    fn a_level_reaches_as_far_as_its_views_see() {
        let widest_px = |px_per_m: f64| 0.5 * px_per_m;
        let mut levels = Vec::new();
        for i in 0..400 {
            let f = f64::from(i);
            let view = view([1e6 + 0.013 * f, -7.0 * f], 3.0 * (0.004 * f).exp());
            let level = Level::of(&view, widest_px);
            let ratio = level.px_a_px(&view);
            assert!((0.91..1.1).contains(&ratio), "{ratio}");
            let origin = level.origin_px(&view);
            let reach_px = widest_px(view.px_per_m()) + 1.0;
            for (middle, size, reach) in [
                (origin.x, 1920.0, level.reach_px[0]),
                (origin.y, 1080.0, level.reach_px[1]),
            ] {
                assert!((middle + reach_px) * ratio <= reach, "{view:?}");
                assert!((size - middle + reach_px) * ratio <= reach, "{view:?}");
            }
            assert!(level.steps_a_px() > 2048.0);
            levels.push(level);
        }
        levels.dedup();
        assert!((10..300).contains(&levels.len()), "{}", levels.len());
    }

    #[test]
    fn views_side_by_side_share_a_level_and_others_do_not() {
        let level = |center, px_per_m| Level::of(&view(center, px_per_m), |_| 1.0);
        let first = level([0.0, 0.0], 2.0);
        assert_eq!(level([10.0, -10.0], 2.1), first);
        assert_ne!(level([0.0, 0.0], 2.4), first);
        assert_ne!(level([100.0, 0.0], 2.0), first);
    }
}
