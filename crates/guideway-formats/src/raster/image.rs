//! [`Raster`]: the pixels of an image; [`ImagePlacement`]: their place on the floor.

use guideway_layout::Place;
use guideway_spline::{Affine, Point};

use crate::Problem;

/// Most pixels of an image. Derived: with smaller copies for reduced views, 4/3 of 4 bytes per
/// pixel, an image takes 360 MB in memory.
pub const MAX_PIXELS: u64 = 1 << 26;

/// An image in memory, with 8 bits per channel.
pub struct Raster {
    /// Columns of pixels, at least 1.
    pub width: usize,
    /// Rows of pixels, at least 1.
    pub height: usize,
    /// Red, green, blue and opacity per pixel, not premultiplied; the top row first.
    pub pixels: Vec<[u8; 4]>,
    /// Whether the file has an opacity per pixel.
    pub has_alpha: bool,
    /// The bytes of the file if it is PNG, for formats that embed the file.
    pub png: Option<Vec<u8>>,
}

/// Scale, rotation and position of an image on the floor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ImagePlacement {
    /// Pixels of the image per meter.
    pub px_per_m: f64,
    /// Counter-clockwise rotation about the lower left corner, in degrees.
    pub rotate_deg: f64,
    /// Position of the lower left corner, in meters.
    pub offset_m: Point<f64>,
}

impl ImagePlacement {
    /// Maps pixels of an image of this height, y down from its upper left corner, to meters.
    pub fn world_from_image(&self, height_px: usize) -> Affine {
        let origin = Point::default();
        let height_m = height_px as f64 / self.px_per_m;
        Affine::scale(1.0 / self.px_per_m, -1.0 / self.px_per_m, origin)
            .then(Affine::translation(Point::new(0.0, height_m)))
            .then(Affine::rotation(self.rotate_deg.to_radians(), origin))
            .then(Affine::translation(self.offset_m))
    }

    /// The placement after the image as a whole is scaled and rotated about the origin of the
    /// world, then moved.
    #[must_use]
    pub fn transformed(&self, scale: f64, rotate_deg: f64, offset_m: Point<f64>) -> Self {
        let rotation = Affine::rotation(rotate_deg.to_radians(), Point::default());
        Self {
            px_per_m: self.px_per_m / scale,
            rotate_deg: self.rotate_deg + rotate_deg,
            offset_m: rotation.apply(self.offset_m * scale) + offset_m,
        }
    }
}

/// Checks the size of an image before memory is allocated. Returns its number of pixels.
///
/// # Errors
/// When it has no pixel, or more than [`MAX_PIXELS`].
pub(super) fn check_pixels(width: u64, height: u64) -> Result<usize, Problem> {
    let count = width.saturating_mul(height);
    if (1..=MAX_PIXELS).contains(&count) {
        return Ok(count as usize);
    }
    Err(Problem::InvalidValue {
        place: Place::element("size of the image"),
        detail: format!(
            "{width} x {height} pixels, outside of the limits of 1 to {MAX_PIXELS} pixels in total"
        ),
        remedy: "Save the image with fewer pixels, and adapt its scale".into(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn near(a: Point<f64>, b: Point<f64>) -> bool {
        a.distance(b) < 1e-9
    }

    #[test]
    fn lower_left_corner_lies_at_the_offset_and_turns_counter_clockwise() {
        let placement = ImagePlacement {
            px_per_m: 20.0,
            rotate_deg: 90.0,
            offset_m: Point::new(-5.0, -2.5),
        };
        let world = placement.world_from_image(100);
        assert!(near(
            world.apply(Point::new(0.0, 100.0)),
            Point::new(-5.0, -2.5)
        ));
        // 40 pixels to the right are 2 m upward, 20 pixels up are 1 m to the left.
        assert!(near(
            world.apply(Point::new(40.0, 100.0)),
            Point::new(-5.0, -0.5)
        ));
        assert!(near(
            world.apply(Point::new(0.0, 80.0)),
            Point::new(-6.0, -2.5)
        ));
    }

    #[test]
    fn transformed_placement_maps_as_one_after_the_other() {
        let placement = ImagePlacement {
            px_per_m: 4.0,
            rotate_deg: 30.0,
            offset_m: Point::new(3.0, -7.0),
        };
        let origin = Point::default();
        let after = Affine::scale(2.0, 2.0, origin)
            .then(Affine::rotation(20_f64.to_radians(), origin))
            .then(Affine::translation(Point::new(1.0, 5.0)));
        let both = placement.transformed(2.0, 20.0, Point::new(1.0, 5.0));
        for corner in [(0.0, 0.0), (9.0, 0.0), (2.0, 6.0)] {
            let corner = Point::new(corner.0, corner.1);
            let expected = after.apply(placement.world_from_image(6).apply(corner));
            assert!(near(both.world_from_image(6).apply(corner), expected));
        }
    }

    #[test]
    fn size_is_limited_without_overflow() {
        assert_eq!(check_pixels(3, 2).unwrap(), 6);
        for (width, height) in [(0, 5), (1 << 14, (1 << 12) + 1), (u64::MAX, 3)] {
            let error = check_pixels(width, height).unwrap_err().to_string();
            assert!(error.contains("67108864"), "{error}");
        }
    }
}
