//! The camera: center and scale of the view, and the view history.

use guideway_document::ViewHistory;
use guideway_scene::{FrameSize, View};
use guideway_spline::{Bounds, Point};

/// Center and scale of the view, and the views before. Positions are pixels of the picture.
#[derive(Clone, Debug)]
pub(crate) struct Camera {
    /// `None` while the canvas has no size.
    size: Option<FrameSize>,
    position: Position,
    history: ViewHistory<Position>,
    /// True if the position is not in the history yet.
    is_moving: bool,
    /// Bounds to fit as soon as the canvas has a size.
    pending_fit: Option<Bounds<f64>>,
    files: Option<FilesFit>,
}

/// The files that the view was made for.
#[derive(Clone, Copy, Debug)]
struct FilesFit {
    bounds: Bounds<f64>,
    /// The position afterwards: at another one, the user has moved the view.
    position: Position,
    /// False if the view was not made for them.
    is_shown: bool,
}

/// Least extent shown by [`Camera::zoom_to`], in meters: about two vehicle lengths.
const MIN_EXTENT_M: f64 = 5.0;

/// Least distance of a followed point from the edges, as a part of the shorter side.
const FOLLOW_MARGIN: f64 = 0.15;

#[derive(Clone, Copy, Debug, PartialEq)]
struct Position {
    center_m: Point<f64>,
    px_per_m: f64,
}

impl Camera {
    pub(crate) fn new() -> Self {
        let position = Position {
            center_m: Point::new(0.0, 0.0),
            px_per_m: 20.0,
        };
        Self {
            size: None,
            position,
            history: ViewHistory::new(position),
            is_moving: false,
            pending_fit: None,
            files: None,
        }
    }

    /// The view; `None` while the canvas has no size.
    pub(crate) fn view(&self) -> Option<View> {
        View::new(self.size?, self.position.center_m, self.position.px_per_m).ok()
    }

    /// Shows another view for a while, apart from the history. Returns the present one.
    pub(super) fn exchange_view(&mut self, view: Option<View>) -> Option<View> {
        let present = self.view();
        if let Some(view) = view {
            self.size = Some(view.size());
            self.position = Position {
                center_m: view.center_m(),
                px_per_m: view.px_per_m(),
            };
        }
        present
    }

    /// Sets the size of the canvas. The center stays, but the view of all files follows the size of
    /// the window until the user moves it.
    pub(crate) fn resize(&mut self, width: u32, height: u32) {
        let before = std::mem::replace(&mut self.size, FrameSize::new(width, height).ok());
        if let (Some(before), Some(size)) = (before, self.size) {
            self.follow_window(before, size);
        }
        if self.size.is_some()
            && let Some(bounds) = self.pending_fit.take()
        {
            self.fit(bounds);
            if let Some(files) = &mut self.files {
                files.position = self.position;
            }
        }
    }

    /// Fits the files into another size, if the view was made for them. A panel that opens changes
    /// one side only, and leaves the view as it is.
    fn follow_window(&mut self, before: FrameSize, size: FrameSize) {
        let is_panel = before.width() == size.width() || before.height() == size.height();
        let Some(files) = self.files.as_mut().filter(|_| !is_panel) else {
            return;
        };
        if files.is_shown
            && files.position == self.position
            && let Ok(view) = View::fit(size, Some(files.bounds))
        {
            self.position = Position {
                center_m: view.center_m(),
                px_per_m: view.px_per_m(),
            };
            files.position = self.position;
        }
    }

    /// Shows the bounds of a file that has appeared, together with those of earlier files. Without
    /// effect once the user has moved the view, unless the file `is_first` in the list.
    pub(crate) fn fit_file(&mut self, bounds: Bounds<f64>, is_first: bool) {
        let earlier = self.files.filter(|files| files.position == self.position);
        let bounds = earlier.map_or(bounds, |files| files.bounds.union(bounds));
        let is_shown = is_first || earlier.is_some_and(|files| files.is_shown);
        if self.files.is_some() && earlier.is_none() && !is_first {
            return;
        }
        if is_shown {
            self.fit(bounds);
        }
        self.files = Some(FilesFit {
            bounds,
            position: self.position,
            is_shown,
        });
    }

    /// Moves the world by this many pixels.
    pub(crate) fn pan(&mut self, by_px: Point<f64>) {
        let by_m = Point::new(-by_px.x, by_px.y) * (1.0 / self.position.px_per_m);
        self.move_to(Position {
            center_m: self.position.center_m + by_m,
            ..self.position
        });
    }

    /// Moves the view as little as shows a point with some surroundings.
    pub(crate) fn bring_into_view(&mut self, at_m: Point<f64>) {
        let Some(view) = self.view() else {
            return;
        };
        let [width, height] = [view.size().width(), view.size().height()].map(f64::from);
        let margin = FOLLOW_MARGIN * width.min(height);
        let at = view.pixel_from_world(at_m);
        let inside = Point::new(
            at.x.clamp(margin, width - margin),
            at.y.clamp(margin, height - margin),
        );
        if inside != at {
            self.pan(inside - at);
        }
    }

    /// Scales the view about `at_px`, whose world position stays.
    pub(crate) fn zoom(&mut self, factor: f64, at_px: Point<f64>) {
        let Some(view) = self.view() else {
            return;
        };
        let fixed_m = view.world_from_pixel(at_px);
        self.move_to(Position {
            center_m: fixed_m + (self.position.center_m - fixed_m) * (1.0 / factor),
            px_per_m: self.position.px_per_m * factor,
        });
    }

    /// Scales the view about its center.
    pub(crate) fn zoom_center(&mut self, factor: f64) {
        self.move_to(Position {
            px_per_m: self.position.px_per_m * factor,
            ..self.position
        });
    }

    /// Shows the center at this scale.
    pub(crate) fn scale_center(&mut self, px_per_m: f64) {
        self.move_to(Position {
            px_per_m,
            ..self.position
        });
    }

    /// Shows a whole box; enters the view history.
    pub(crate) fn fit(&mut self, bounds: Bounds<f64>) {
        let Some(size) = self.size else {
            self.pending_fit = Some(bounds);
            return;
        };
        if let Ok(view) = View::fit(size, Some(bounds)) {
            self.settle();
            self.move_to(Position {
                center_m: view.center_m(),
                px_per_m: view.px_per_m(),
            });
            self.settle();
        }
    }

    /// Shows this point at the center, at this scale; enters the view history.
    pub(crate) fn look_at(&mut self, center_m: Point<f64>, px_per_m: f64) {
        self.pending_fit = None;
        self.settle();
        self.move_to(Position { center_m, px_per_m });
        self.settle();
    }

    /// Shows a box with its surroundings, for an element that may be a point.
    pub(crate) fn zoom_to(&mut self, bounds: Bounds<f64>) {
        let size_m = bounds.size();
        self.fit(bounds.inflated(((MIN_EXTENT_M - size_m.x.max(size_m.y)) / 2.0).max(0.0)));
    }

    /// Ends a movement: its position enters the view history.
    pub(crate) fn settle(&mut self) {
        if std::mem::take(&mut self.is_moving) {
            self.history.go(self.position);
        }
    }

    /// Returns to the previous view.
    pub(crate) fn back(&mut self) {
        self.settle();
        self.position = self.history.back().unwrap_or(self.position);
    }

    /// Goes to the next view of the history.
    pub(crate) fn forward(&mut self) {
        self.settle();
        self.position = self.history.forward().unwrap_or(self.position);
    }

    /// Moves to a position, unless it is beyond the limits of a view.
    fn move_to(&mut self, position: Position) {
        // The limits do not depend on the size of the view.
        let is_valid = FrameSize::new(1, 1)
            .and_then(|size| View::new(size, position.center_m, position.px_per_m))
            .is_ok();
        if is_valid {
            self.position = position;
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
    fn view_of_all_files_follows_the_window_until_it_is_moved() {
        let mut camera = camera();
        let [min, max] = [Point::new(0.0, 0.0), Point::new(80.0, 20.0)];
        camera.fit_file(Bounds { min, max }, true);
        let scale = |camera: &Camera| camera.view().unwrap().px_per_m();
        let whole = scale(&camera);
        camera.resize(400, 300);
        assert!((scale(&camera) / whole - 0.5).abs() < 0.05);
        let half = scale(&camera);
        camera.resize(400, 200);
        assert_eq!(scale(&camera), half, "a panel opened");
        camera.zoom_center(2.0);
        camera.resize(800, 600);
        assert_eq!(scale(&camera), 2.0 * half, "the user moved it");
    }

    #[test]
    fn zoom_keeps_the_position_under_the_pointer() {
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
    fn pan_moves_the_world_with_the_pointer() {
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
    fn point_out_of_sight_is_brought_into_view_at_the_same_scale() {
        let mut camera = camera();
        let scale = camera.view().unwrap().px_per_m();
        let seen = camera
            .view()
            .unwrap()
            .world_from_pixel(Point::new(400.0, 200.0));
        camera.bring_into_view(seen);
        assert_eq!(camera.view().unwrap().center_m(), Point::new(0.0, 0.0));
        camera.bring_into_view(Point::new(1000.0, 0.0));
        let view = camera.view().unwrap();
        let at = view.pixel_from_world(Point::new(1000.0, 0.0));
        assert!(at.distance(Point::new(710.0, 300.0)) < 1e-6, "{at:?}");
        assert_eq!(view.px_per_m(), scale);
    }

    #[test]
    fn view_stays_valid_at_its_limits() {
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
    fn fit_waits_for_a_size_and_enters_the_history() {
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
