//! Round numbers for a grid and a scale bar.

use guideway_scene::View;
use guideway_spline::Point;

/// The least of 1, 2 and 5 times a power of ten that is at least `least`, which is above zero.
pub fn round_step(least: f64) -> f64 {
    let magnitude = 10f64.powf(least.log10().floor());
    let steps = [1.0, 2.0, 5.0, 10.0].map(|factor| factor * magnitude);
    // Rounding of the logarithm may put `least` a little above the last one.
    steps
        .into_iter()
        .find(|&step| step >= least)
        .unwrap_or(20.0 * magnitude)
}

/// Most lines of a grid along each side.
const MOST_LINES: usize = 1000;

/// Where the lines of a grid cross the picture of a view, in pixels: along x those that stand, along y those that
/// lie. They are at least `least_px` apart, at round places in the world.
pub fn grid_lines_px(view: &View, least_px: f64) -> [Vec<f64>; 2] {
    let step_m = round_step(least_px / view.px_per_m());
    let seen = view.world_bounds();
    let lines = |from_m: f64, to_m: f64| {
        let (first, last) = ((from_m / step_m).ceil(), (to_m / step_m).floor());
        // Beyond 2^53 steps from the origin there are no lines that could be told apart.
        let count = (last - first + 1.0).max(0.0) as usize;
        (0..count.min(MOST_LINES)).map(move |i| (first + i as f64) * step_m)
    };
    let pixel = |x, y| view.pixel_from_world(Point::new(x, y));
    [
        lines(seen.min.x, seen.max.x)
            .map(|x| pixel(x, seen.min.y).x)
            .collect(),
        lines(seen.min.y, seen.max.y)
            .map(|y| pixel(seen.min.x, y).y)
            .collect(),
    ]
}

#[cfg(test)]
mod tests {
    use guideway_scene::FrameSize;

    use super::*;

    #[test]
    fn steps_are_round_and_never_too_small() {
        for (least, step) in [
            (1.0, 1.0),
            (1.1, 2.0),
            (3.0, 5.0),
            (6.0, 10.0),
            (0.03, 0.05),
        ] {
            assert!((round_step(least) - step).abs() < 1e-12 * step, "{least}");
        }
        for power in -9..9 {
            let least = 10f64.powi(power) * 1.0001;
            assert!(
                (1.0..2.01).contains(&(round_step(least) / least)),
                "{least}"
            );
        }
    }

    #[test]
    fn lines_of_a_grid_are_at_round_places() {
        let size = FrameSize::new(400, 300).unwrap();
        let view = View::new(size, Point::new(3.0, -2.0), 20.0).unwrap();
        let [x_px, y_px] = grid_lines_px(&view, 96.0);
        let meters = |x, y| view.world_from_pixel(Point::new(x, y));
        let xs: Vec<_> = x_px.iter().map(|&x| meters(x, 0.0).x.round()).collect();
        let ys: Vec<_> = y_px.iter().map(|&y| meters(0.0, y).y.round()).collect();
        assert_eq!((xs, ys), (vec![-5.0, 0.0, 5.0, 10.0], vec![-5.0, 0.0, 5.0]));
        let far = View::new(size, Point::new(1e9, 1e9), 1e6).unwrap();
        assert!(
            grid_lines_px(&far, 96.0)
                .iter()
                .all(|l| l.len() <= MOST_LINES)
        );
    }
}
