//! Where the world lies in the picture, so that a picture moved by whole pixels is the same to the bit.

use guideway_scene::View;
use guideway_spline::Point;

/// Steps of a pixel that clusters and all their lines are rounded to.
pub(super) const STEPS_PX: f64 = 4096.0;
/// Pixels from one anchor to the next, at least; at most twice as many.
const ANCHORS_PX: f64 = (1 << 20) as f64;

/// Where the world lies in the picture, rounded to steps.
///
/// Places are rounded from an anchor in the world, and that is rounded from the corner of the picture. So
/// whoever is moved by whole pixels moves by as many steps, near the same anchor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Placement {
    px_per_m: f64,
    anchor_m: Point<f64>,
    /// Where the anchor lies, in steps from the upper left corner: whole numbers.
    anchor: Point<f64>,
}

impl Placement {
    pub(super) fn new(view: &View) -> Self {
        let px_per_m = view.px_per_m();
        let lattice_m = power_of_two_below(2.0 * ANCHORS_PX / px_per_m);
        let center_m = view.center_m();
        let anchor_m = Point::new(
            (center_m.x / lattice_m).round() * lattice_m,
            (center_m.y / lattice_m).round() * lattice_m,
        );
        let corner = view.pixel_from_world(anchor_m) * STEPS_PX;
        Self {
            px_per_m,
            anchor_m,
            anchor: Point::new(corner.x.round(), corner.y.round()),
        }
    }

    /// Where a world point appears, rounded to steps, in pixels.
    pub(super) fn pixel(&self, world_m: Point<f64>) -> Point<f64> {
        let steps = (world_m - self.anchor_m) * (self.px_per_m * STEPS_PX);
        let steps = Point::new(
            self.anchor.x + steps.x.round(),
            self.anchor.y - steps.y.round(),
        );
        steps * (1.0 / STEPS_PX)
    }

    /// By how many whole pixels another picture begins farther right and down; none if it is not this one moved by
    /// whole pixels.
    pub(super) fn whole_px_to(&self, other: &Self) -> Option<[i64; 2]> {
        let is_alike = self.px_per_m == other.px_per_m && self.anchor_m == other.anchor_m;
        let moved_px = (self.anchor - other.anchor) * (1.0 / STEPS_PX);
        let is_whole = moved_px.x.fract() == 0.0 && moved_px.y.fract() == 0.0;
        (is_alike && is_whole).then_some([moved_px.x as i64, moved_px.y as i64])
    }
}

/// The greatest power of two that is at most `x`, a normal number above 0.
pub(super) fn power_of_two_below(x: f64) -> f64 {
    const EXPONENT: u64 = 0x7ff << 52;
    f64::from_bits(x.to_bits() & EXPONENT)
}

#[cfg(test)]
mod tests {
    use guideway_scene::FrameSize;

    use super::*;

    fn placement(x_m: f64, y_m: f64, px_per_m: f64) -> Placement {
        let size = FrameSize::new(101, 50).unwrap();
        Placement::new(&View::new(size, Point::new(x_m, y_m), px_per_m).unwrap())
    }

    #[test]
    fn places_are_those_of_the_view_to_a_step() {
        for (x_m, y_m, px_per_m) in [(3.0, -4.0, 7.3), (1e7, -2e6, 1e4), (-0.1, 0.0, 1e-6)] {
            let size = FrameSize::new(101, 50).unwrap();
            let view = View::new(size, Point::new(x_m, y_m), px_per_m).unwrap();
            let world_m = Point::new(x_m + 30.3 / px_per_m, y_m - 9.7 / px_per_m);
            let off = Placement::new(&view).pixel(world_m) - view.pixel_from_world(world_m);
            assert!(off.norm() < 3.0 / STEPS_PX, "{off:?}");
        }
    }

    #[test]
    fn whole_pixels_move_every_place_alike() {
        let (scale, world_m) = (3.7, Point::new(12.345, -6.789));
        let from = placement(10.0, 20.0, scale);
        let to = placement(10.0 + 13.0 / scale, 20.0 + 4.0 / scale, scale);
        assert_eq!(from.whole_px_to(&to), Some([13, -4]));
        let moved = from.pixel(world_m) - to.pixel(world_m);
        assert_eq!(moved, Point::new(13.0, -4.0));
    }

    #[test]
    fn other_views_are_not_moved_ones() {
        let from = placement(10.0, 20.0, 4.0);
        for to in [
            placement(10.125, 20.0, 4.0),
            placement(10.0, 20.0, 4.000_001),
            placement(1e7, 20.0, 4.0),
        ] {
            assert_eq!(from.whole_px_to(&to), None);
        }
    }
}
