//! Maps the world to the picture in steps of 1/4096 pixel, so that a view moved by whole pixels
//! gives the same bits.

use guideway_scene::View;
use guideway_spline::Point;

/// Steps per pixel that clusters and the vertices of their lines are rounded to. Derived: a tile
/// and its surroundings in steps fit in the 24 bits of an `f32`.
pub(crate) const STEPS_PER_PX: f64 = 4096.0;
/// Distance of neighboring anchors in pixels, at least; at most twice as many.
const ANCHOR_PX: f64 = (1 << 20) as f64;

/// A view, rounded to steps.
///
/// Positions are rounded relative to an anchor in the world, and the anchor relative to the corner
/// of the picture. Two views that differ by whole pixels near the same anchor differ by whole
/// steps.
///
/// ```text
///   corner of the picture --(whole steps)--> anchor --(whole steps)--> position
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct SnappedTransform {
    px_per_m: f64,
    anchor_m: Point<f64>,
    /// The anchor, in steps from the upper left corner: whole numbers.
    anchor: Point<f64>,
}

impl SnappedTransform {
    /// Snaps a view.
    pub(crate) fn new(view: &View) -> Self {
        let px_per_m = view.px_per_m();
        let lattice_m = power_of_two_below(2.0 * ANCHOR_PX / px_per_m);
        let center_m = view.center_m();
        let anchor_m = Point::new(
            (center_m.x / lattice_m).round() * lattice_m,
            (center_m.y / lattice_m).round() * lattice_m,
        );
        let corner = view.pixel_from_world(anchor_m) * STEPS_PER_PX;
        Self {
            px_per_m,
            anchor_m,
            anchor: Point::new(corner.x.round(), corner.y.round()),
        }
    }

    /// Maps a world point to the picture, rounded to steps, in pixels.
    pub(crate) fn pixel(&self, world_m: Point<f64>) -> Point<f64> {
        let steps = (world_m - self.anchor_m) * (self.px_per_m * STEPS_PER_PX);
        let steps = Point::new(
            self.anchor.x + steps.x.round(),
            self.anchor.y - steps.y.round(),
        );
        steps * (1.0 / STEPS_PER_PX)
    }

    /// The pixel that holds the anchor: whole numbers, from the upper left corner.
    pub(crate) fn anchor_px(&self) -> Point<f64> {
        let anchor = self.anchor * (1.0 / STEPS_PER_PX);
        Point::new(anchor.x.floor(), anchor.y.floor())
    }

    /// Maps a world point, rounded to steps, to pixels from [`Self::anchor_px`]: the same bits in
    /// all views that differ by whole pixels.
    pub(crate) fn pixel_from_anchor(&self, world_m: Point<f64>) -> Point<f64> {
        let steps = (world_m - self.anchor_m) * (self.px_per_m * STEPS_PER_PX);
        let within_px = self.anchor * (1.0 / STEPS_PER_PX) - self.anchor_px();
        let px = Point::new(steps.x.round(), -steps.y.round()) * (1.0 / STEPS_PER_PX);
        within_px + px
    }

    /// The offset of another view to the right and down, if it is this one moved by whole pixels.
    pub(crate) fn whole_px_to(&self, other: &Self) -> Option<[i64; 2]> {
        let is_alike = self.px_per_m == other.px_per_m && self.anchor_m == other.anchor_m;
        let moved_px = (self.anchor - other.anchor) * (1.0 / STEPS_PER_PX);
        let is_whole = moved_px.x.fract() == 0.0 && moved_px.y.fract() == 0.0;
        (is_alike && is_whole).then_some([moved_px.x as i64, moved_px.y as i64])
    }
}

/// The greatest power of two up to `x`, a normal number above 0.
pub(crate) fn power_of_two_below(x: f64) -> f64 {
    const EXPONENT: u64 = 0x7ff << 52;
    f64::from_bits(x.to_bits() & EXPONENT)
}

#[cfg(test)]
mod tests {
    use guideway_scene::FrameSize;

    use super::*;

    fn snapped(x_m: f64, y_m: f64, px_per_m: f64) -> SnappedTransform {
        let size = FrameSize::new(101, 50).unwrap();
        SnappedTransform::new(&View::new(size, Point::new(x_m, y_m), px_per_m).unwrap())
    }

    #[test]
    fn positions_match_the_view_to_a_step() {
        for (x_m, y_m, px_per_m) in [(3.0, -4.0, 7.3), (1e7, -2e6, 1e4), (-0.1, 0.0, 1e-6)] {
            let size = FrameSize::new(101, 50).unwrap();
            let view = View::new(size, Point::new(x_m, y_m), px_per_m).unwrap();
            let world_m = Point::new(x_m + 30.3 / px_per_m, y_m - 9.7 / px_per_m);
            let off = SnappedTransform::new(&view).pixel(world_m) - view.pixel_from_world(world_m);
            assert!(off.norm() < 3.0 / STEPS_PER_PX, "{off:?}");
        }
    }

    #[test]
    fn whole_pixels_move_every_position_alike() {
        let (scale, world_m) = (3.7, Point::new(12.345, -6.789));
        let from = snapped(10.0, 20.0, scale);
        let to = snapped(10.0 + 13.0 / scale, 20.0 + 4.0 / scale, scale);
        assert_eq!(from.whole_px_to(&to), Some([13, -4]));
        let moved = from.pixel(world_m) - to.pixel(world_m);
        assert_eq!(moved, Point::new(13.0, -4.0));
    }

    #[test]
    fn pixels_from_the_anchor_are_the_same_bits_in_all_such_views() {
        let (scale, world_m) = (3.7, Point::new(12.345, -6.789));
        let from = snapped(10.0, 20.0, scale);
        let to = snapped(10.0 + 13.0 / scale, 20.0 + 4.0 / scale, scale);
        assert_eq!(
            from.pixel_from_anchor(world_m),
            to.pixel_from_anchor(world_m)
        );
        for view in [from, to] {
            let px = view.anchor_px() + view.pixel_from_anchor(world_m);
            assert_eq!(px, view.pixel(world_m));
        }
    }

    #[test]
    fn rejects_views_that_differ_by_part_of_a_pixel_or_in_scale() {
        let from = snapped(10.0, 20.0, 4.0);
        for to in [
            snapped(10.125, 20.0, 4.0),
            snapped(10.0, 20.0, 4.000_001),
            snapped(1e7, 20.0, 4.0),
        ] {
            assert_eq!(from.whole_px_to(&to), None);
        }
    }
}
