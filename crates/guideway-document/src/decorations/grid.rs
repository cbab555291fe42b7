//! Grid: lines at round world coordinates, drawn below the paths.

use guideway_scene::{DrawList, View, round_step};
use guideway_spline::Point;

use super::style::DecorationStyle;

/// Least distance between grid lines, in points.
const MIN_SPACING_POINTS: f64 = 96.0;
/// Most lines along each axis: a bound for pictures of any size.
const MAX_LINES: usize = 1000;
/// Opacity of grid lines: visible, and fainter than any path.
const OPACITY: f64 = 0.12;

/// Least distance between the lines of a given step, in points; below it every tenth is drawn.
const MIN_GIVEN_POINTS: f64 = 8.0;

/// Distance of the grid lines of a view in meters: the given step, times a power of ten where its
/// lines would be too close. Without one it is 1, 2 or 5 times a power of ten.
pub fn grid_step_m(view: &View, given_m: Option<f64>, px_per_point: f64) -> f64 {
    let meters = |points: f64| points * px_per_point / view.px_per_m();
    match given_m {
        Some(step_m) => coarser(step_m, meters(MIN_GIVEN_POINTS)),
        None => round_step(meters(MIN_SPACING_POINTS)),
    }
}

/// The grid of a view: lines one point wide and [`grid_step_m`] apart.
pub fn grid(view: &View, given_m: Option<f64>, style: &DecorationStyle) -> DrawList {
    let mut list = DrawList::default();
    let color = style.ink.with_opacity(OPACITY);
    let half_px = style.px_per_point / 2.0;
    let size = view.size();
    let (width, height) = (f64::from(size.width()), f64::from(size.height()));
    let step_m = grid_step_m(view, given_m, style.px_per_point);
    let [x_px, y_px] = line_positions(view, step_m);
    for x in x_px {
        let (left, right) = (x - half_px, x + half_px);
        list.fill_rectangle(color, Point::new(left, 0.0), Point::new(right, height));
    }
    for y in y_px {
        let (top, bottom) = (y - half_px, y + half_px);
        list.fill_rectangle(color, Point::new(0.0, top), Point::new(width, bottom));
    }
    list
}

/// The step times the least power of ten, from 1, by which it is at least `least_m`.
fn coarser(step_m: f64, least_m: f64) -> f64 {
    let tens = (least_m / step_m).log10().ceil().max(0.0);
    step_m * 10_f64.powf(tens)
}

/// Pixel positions of the vertical lines along x and of the horizontal lines along y, `step_m`
/// apart.
fn line_positions(view: &View, step_m: f64) -> [Vec<f64>; 2] {
    let visible = view.world_bounds();
    let lines = |from_m: f64, to_m: f64| {
        let (first, last) = ((from_m / step_m).ceil(), (to_m / step_m).floor());
        // Negative where rounding, 2^53 steps from the origin and beyond, makes lines coincide.
        let count = (last - first + 1.0).max(0.0) as usize;
        (0..count.min(MAX_LINES)).map(move |i| (first + i as f64) * step_m)
    };
    let pixel = |x, y| view.pixel_from_world(Point::new(x, y));
    [
        lines(visible.min.x, visible.max.x)
            .map(|x| pixel(x, visible.min.y).x)
            .collect(),
        lines(visible.min.y, visible.max.y)
            .map(|y| pixel(visible.min.x, y).y)
            .collect(),
    ]
}

#[cfg(test)]
mod tests {
    use guideway_scene::{FrameSize, Rgba};

    use super::*;

    #[test]
    fn lines_are_at_round_coordinates() {
        let size = FrameSize::new(400, 300).unwrap();
        let view = View::new(size, Point::new(3.0, -2.0), 20.0).unwrap();
        let [x_px, y_px] = line_positions(&view, 5.0);
        let meters = |x, y| view.world_from_pixel(Point::new(x, y));
        let xs: Vec<_> = x_px.iter().map(|&x| meters(x, 0.0).x.round()).collect();
        let ys: Vec<_> = y_px.iter().map(|&y| meters(0.0, y).y.round()).collect();
        assert_eq!((xs, ys), (vec![-5.0, 0.0, 5.0, 10.0], vec![-5.0, 0.0, 5.0]));
    }

    #[test]
    fn given_step_holds_until_its_lines_are_too_close() {
        let lines = |px_per_m| {
            let size = FrameSize::new(400, 400).unwrap();
            let view = View::new(size, Point::new(3.0, 3.0), px_per_m).unwrap();
            let style = DecorationStyle::new(Rgba::WHITE, 1.0);
            let list = grid(&view, Some(1.5), &style);
            let lines: usize = list.fills.iter().map(|fill| fill.polygons.len()).sum();
            lines / 2
        };
        // 400 px at 20 px/m are 20 m; at 5 px/m the lines are 7.5 px apart, so 15 m it is.
        assert_eq!((lines(20.0), lines(5.0)), (13, 5));
        let step_m = |px_per_m| {
            let size = FrameSize::new(400, 400).unwrap();
            let view = View::new(size, Point::new(3.0, 3.0), px_per_m).unwrap();
            grid_step_m(&view, Some(1.5), 1.0)
        };
        assert_eq!([20.0, 5.0, 0.5].map(step_m), [1.5, 15.0, 150.0]);
    }

    #[test]
    fn number_of_lines_is_bounded_far_from_the_origin() {
        let size = FrameSize::new(400, 300).unwrap();
        let view = View::new(size, Point::new(1e9, 1e9), 1e6).unwrap();
        let list = grid(&view, None, &DecorationStyle::new(Rgba::WHITE, 1.0));
        let lines: usize = list.fills.iter().map(|fill| fill.polygons.len()).sum();
        assert!(lines <= 2 * MAX_LINES);
    }

    #[test]
    fn steps_are_round_and_not_less_than_the_minimum() {
        for (min, step) in [
            (1.0, 1.0),
            (1.1, 2.0),
            (3.0, 5.0),
            (6.0, 10.0),
            (0.03, 0.05),
        ] {
            assert!((round_step(min) - step).abs() < 1e-12 * step, "{min}");
        }
        for power in -9..9 {
            let min = 10f64.powi(power) * 1.0001;
            assert!((1.0..2.01).contains(&(round_step(min) / min)), "{min}");
        }
    }
}
