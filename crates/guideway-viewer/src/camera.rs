use guideway_document::ViewHistory;
use guideway_scene::{FrameSize, View};
use guideway_spline::{Bounds, Point};

/// What is looked at, and where one has looked before. Positions in the picture are pixels of the screen.
#[derive(Clone, Debug)]
pub(crate) struct Camera {
    /// None while the picture has no size.
    size: Option<FrameSize>,
    place: Place,
    trail: ViewHistory<Place>,
    is_moving: bool,
    /// What to show once there is a size.
    awaited: Option<Bounds<f64>>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Place {
    center_m: Point<f64>,
    px_per_m: f64,
}

impl Camera {
    pub(crate) fn new() -> Self {
        let place = Place {
            center_m: Point::new(0.0, 0.0),
            px_per_m: 20.0,
        };
        Self {
            size: None,
            place,
            trail: ViewHistory::new(place),
            is_moving: false,
            awaited: None,
        }
    }

    /// What is seen; none while the picture has no size.
    pub(crate) fn view(&self) -> Option<View> {
        View::new(self.size?, self.place.center_m, self.place.px_per_m).ok()
    }

    /// The picture has another size; the middle stays.
    pub(crate) fn resize(&mut self, width: u32, height: u32) {
        self.size = FrameSize::new(width, height).ok();
        if self.size.is_some()
            && let Some(bounds) = self.awaited.take()
        {
            self.fit(bounds);
        }
    }

    /// Moves the world under the screen.
    pub(crate) fn pan(&mut self, by_px: Point<f64>) {
        let by_m = Point::new(-by_px.x, by_px.y) * (1.0 / self.place.px_per_m);
        self.move_to(Place {
            center_m: self.place.center_m + by_m,
            ..self.place
        });
    }

    /// Enlarges what is seen; the world stays where it is under `at_px`.
    pub(crate) fn zoom(&mut self, factor: f64, at_px: Point<f64>) {
        let Some(view) = self.view() else {
            return;
        };
        let fixed = view.world_from_pixel(at_px);
        self.move_to(Place {
            center_m: fixed + (self.place.center_m - fixed) * (1.0 / factor),
            px_per_m: self.place.px_per_m * factor,
        });
    }

    /// Enlarges what is seen about the middle of the picture.
    pub(crate) fn zoom_center(&mut self, factor: f64) {
        self.move_to(Place {
            px_per_m: self.place.px_per_m * factor,
            ..self.place
        });
    }

    /// Shows all of a box.
    pub(crate) fn fit(&mut self, bounds: Bounds<f64>) {
        let Some(size) = self.size else {
            self.awaited = Some(bounds);
            return;
        };
        if let Ok(view) = View::fit(size, Some(bounds)) {
            self.settle();
            self.move_to(Place {
                center_m: view.center_m(),
                px_per_m: view.px_per_m(),
            });
            self.settle();
        }
    }

    /// Looks at a place, from near enough to see it.
    pub(crate) fn fly_to(&mut self, bounds: Bounds<f64>) {
        // A dot is shown with a few meters around it.
        let least_m = 5.0;
        let size_m = bounds.size();
        self.fit(bounds.inflated(((least_m - size_m.x.max(size_m.y)) / 2.0).max(0.0)));
    }

    /// A movement has come to its end: its place is one to go back to.
    pub(crate) fn settle(&mut self) {
        if std::mem::take(&mut self.is_moving) {
            self.trail.go(self.place);
        }
    }

    pub(crate) fn back(&mut self) {
        self.settle();
        self.place = self.trail.back().unwrap_or(self.place);
    }

    pub(crate) fn forward(&mut self) {
        self.settle();
        self.place = self.trail.forward().unwrap_or(self.place);
    }

    /// Goes where a view can be, and nowhere else.
    fn move_to(&mut self, place: Place) {
        // The limits of a view do not depend on its size.
        let is_possible = FrameSize::new(1, 1)
            .and_then(|size| View::new(size, place.center_m, place.px_per_m))
            .is_ok();
        if is_possible {
            self.place = place;
            self.is_moving = true;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn camera() -> Camera {
        let mut camera = Camera::new();
        camera.resize(800, 600);
        camera
    }

    #[test]
    fn zooming_keeps_the_place_under_the_pointer() {
        let mut camera = camera();
        let at_px = Point::new(123.0, 456.0);
        let before = camera.view().unwrap().world_from_pixel(at_px);
        for factor in [1.7, 0.2, 30.0] {
            camera.zoom(factor, at_px);
            let after = camera.view().unwrap().world_from_pixel(at_px);
            assert!(after.distance(before) < 1e-9);
        }
    }

    #[test]
    fn panning_moves_the_world_with_the_hand() {
        let mut camera = camera();
        let world = camera
            .view()
            .unwrap()
            .world_from_pixel(Point::new(100.0, 100.0));
        camera.pan(Point::new(30.0, -20.0));
        let pixel = camera.view().unwrap().pixel_from_world(world);
        assert!(pixel.distance(Point::new(130.0, 80.0)) < 1e-9);
    }

    #[test]
    fn no_place_is_beyond_reach_of_a_view() {
        let mut camera = camera();
        for _ in 0..1000 {
            camera.zoom(0.5, Point::new(0.0, 0.0));
            camera.pan(Point::new(1e9, 0.0));
        }
        assert!(camera.view().is_some());
        camera.zoom(f64::NAN, Point::new(0.0, 0.0));
        for _ in 0..1000 {
            camera.zoom(2.0, Point::new(0.0, 0.0));
        }
        assert!(camera.view().is_some());
    }

    #[test]
    fn what_is_to_be_shown_waits_for_a_size() {
        let mut camera = Camera::new();
        assert_eq!(camera.view(), None);
        let bounds = Bounds {
            min: Point::new(10.0, 10.0),
            max: Point::new(50.0, 20.0),
        };
        camera.fit(bounds);
        camera.resize(0, 0);
        assert_eq!(camera.view(), None);
        camera.resize(400, 300);
        let seen = camera.view().unwrap().world_bounds();
        assert!(seen.contains(bounds.min) && seen.contains(bounds.max));
        camera.back();
        assert_eq!(camera.view().unwrap().center_m(), Point::new(0.0, 0.0));
        camera.forward();
        assert_eq!(camera.view().unwrap().center_m(), bounds.center());
    }
}
