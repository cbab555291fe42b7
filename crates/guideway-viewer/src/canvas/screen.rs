//! Converts between points of the window and pixels of the picture.

use eframe::egui::{Pos2, Rect, Vec2};
use guideway_scene::View;
use guideway_spline::Point;

/// Size of a point of a screen at 96 points per inch, in meters.
pub(crate) const POINT_M: f64 = 0.0254 / 96.0;

/// The rectangle of the picture in the window.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Screen {
    pub(crate) rect: Rect,
    pub(crate) px_per_point: f32,
}

impl Screen {
    /// The pixel of the picture at a point of the window.
    pub(crate) fn pixel(self, at: Pos2) -> Point<f64> {
        let at = (at - self.rect.min) * self.px_per_point;
        Point::new(f64::from(at.x), f64::from(at.y))
    }

    /// The point of the window at a pixel of the picture.
    pub(crate) fn point(self, pixel: Point<f64>) -> Pos2 {
        self.rect.min + Vec2::new(pixel.x as f32, pixel.y as f32) / self.px_per_point
    }

    /// Rectangle of a picture of the view `of` while the window shows the view `on`.
    pub(crate) fn picture_rect(self, of: &View, on: &View) -> Rect {
        let bounds = of.world_bounds();
        let corner = |at| self.point(on.pixel_from_world(at));
        Rect::from_two_pos(corner(bounds.min), corner(bounds.max))
    }
}

#[cfg(test)]
mod tests {
    use eframe::egui::pos2;

    use super::*;

    #[test]
    fn pixel_and_point_are_inverse() {
        let rect = Rect::from_min_size(pos2(10.0, 20.0), Vec2::new(200.0, 100.0));
        let screen = Screen {
            rect,
            px_per_point: 2.0,
        };
        let pixel = Point::new(30.0, 50.0);
        assert_eq!(screen.point(pixel), pos2(25.0, 45.0));
        assert_eq!(screen.pixel(screen.point(pixel)), pixel);
    }
}
