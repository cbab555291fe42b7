//! View: the mapping between world meters and the pixels of a picture.

use guideway_spline::{Bounds, Point};

use crate::{FrameSize, RenderError};

/// A picture size, the world point at its center and a scale.
///
/// World coordinates are meters with y up. Pixel coordinates have y down; (0, 0) is the upper left
/// corner of the upper left pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    size: FrameSize,
    center_m: Point<f64>,
    px_per_m: f64,
}

impl View {
    /// A view of `size` pixels centered on `center_m`.
    ///
    /// # Errors
    /// [`RenderError::View`] when the center is farther than 1e12 m from the origin or the scale is
    /// outside 1e-9 to 1e9 pixels per meter.
    pub fn new(size: FrameSize, center_m: Point<f64>, px_per_m: f64) -> Result<Self, RenderError> {
        let is_far = !(center_m.x.abs() <= 1e12 && center_m.y.abs() <= 1e12);
        if is_far || !(1e-9..=1e9).contains(&px_per_m) {
            return Err(RenderError::View {
                x_m: center_m.x,
                y_m: center_m.y,
                px_per_m,
            });
        }
        Ok(Self {
            size,
            center_m,
            px_per_m,
        })
    }

    /// The view that shows all of `bounds` with a margin of 1/20 on each side. An empty box is shown
    /// at 100 pixels per meter; `None` shows the origin.
    ///
    /// # Errors
    /// As [`View::new`].
    pub fn fit(size: FrameSize, bounds: Option<Bounds<f64>>) -> Result<Self, RenderError> {
        let Some(bounds) = bounds else {
            return Self::new(size, Point::new(0.0, 0.0), 100.0);
        };
        let extent_m = bounds.size();
        let fit_x = 0.9 * f64::from(size.width()) / extent_m.x;
        let fit_y = 0.9 * f64::from(size.height()) / extent_m.y;
        let px_per_m = fit_x.min(fit_y);
        let px_per_m = if px_per_m.is_finite() {
            px_per_m.min(1e9)
        } else {
            100.0
        };
        Self::new(size, bounds.center(), px_per_m)
    }

    /// Size in pixels.
    pub fn size(&self) -> FrameSize {
        self.size
    }

    /// The world point at the center, in meters.
    pub fn center_m(&self) -> Point<f64> {
        self.center_m
    }

    /// Scale in pixels per meter.
    pub fn px_per_m(&self) -> f64 {
        self.px_per_m
    }

    /// Pixel position of a world point. Accurate to 1e-4 px near the view at any distance from the
    /// origin, because the center is subtracted in `f64` before scaling.
    pub fn pixel_from_world(&self, world_m: Point<f64>) -> Point<f64> {
        let half = self.half_size_px();
        Point::new(
            half.x + (world_m.x - self.center_m.x) * self.px_per_m,
            half.y - (world_m.y - self.center_m.y) * self.px_per_m,
        )
    }

    /// World point at a pixel position, in meters.
    pub fn world_from_pixel(&self, pixel: Point<f64>) -> Point<f64> {
        let half = self.half_size_px();
        Point::new(
            self.center_m.x + (pixel.x - half.x) / self.px_per_m,
            self.center_m.y - (pixel.y - half.y) / self.px_per_m,
        )
    }

    /// The visible part of the world, in meters.
    pub fn world_bounds(&self) -> Bounds<f64> {
        let half_m = self.half_size_px() * (1.0 / self.px_per_m);
        Bounds {
            min: self.center_m - half_m,
            max: self.center_m + half_m,
        }
    }

    fn half_size_px(&self) -> Point<f64> {
        Point::new(
            f64::from(self.size.width()) / 2.0,
            f64::from(self.size.height()) / 2.0,
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn maps_world_up_to_picture_up() {
        let size = FrameSize::new(200, 100).unwrap();
        let view = View::new(size, Point::new(1e7, -5.0), 10.0).unwrap();
        assert_eq!(
            view.pixel_from_world(Point::new(1e7, -5.0)),
            Point::new(100.0, 50.0)
        );
        assert_eq!(
            view.pixel_from_world(Point::new(1e7 + 1.0, -4.0)),
            Point::new(110.0, 40.0)
        );
        assert_eq!(
            view.world_from_pixel(Point::new(110.0, 40.0)),
            Point::new(1e7 + 1.0, -4.0)
        );
        assert_eq!(view.world_bounds().min, Point::new(1e7 - 10.0, -10.0));
    }

    #[test]
    fn fit_shows_all_of_the_bounds() {
        let size = FrameSize::new(300, 200).unwrap();
        let bounds = Bounds {
            min: Point::new(-3.0, 2.0),
            max: Point::new(30.0, 9.0),
        };
        let visible = View::fit(size, Some(bounds)).unwrap().world_bounds();
        assert!(visible.contains(bounds.min) && visible.contains(bounds.max));
        let dot = Bounds {
            min: Point::new(4.0, 4.0),
            max: Point::new(4.0, 4.0),
        };
        assert_eq!(View::fit(size, Some(dot)).unwrap().px_per_m(), 100.0);
    }

    #[test]
    fn rejects_centers_and_scales_out_of_range() {
        let size = FrameSize::new(1, 1).unwrap();
        for (x, scale) in [
            (f64::NAN, 1.0),
            (1e13, 1.0),
            (0.0, 0.0),
            (0.0, f64::NAN),
            (0.0, -1.0),
        ] {
            assert!(
                View::new(size, Point::new(x, 0.0), scale).is_err(),
                "{x} {scale}"
            );
        }
    }
}
