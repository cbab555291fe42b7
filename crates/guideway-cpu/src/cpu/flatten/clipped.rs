//! Flattens a run of control points to lines within a box: for curves too large for cached lines.

use guideway_spline::{Bounds, Point, flatten_run, uniform};

/// Largest distance of a line from its curve, in pixels. The borders of a stroke move by as much,
/// which changes a pixel by about 1/30.
const TOLERANCE_PX: f64 = 1.0 / 32.0;
/// Largest side of the hull of what is flattened at once, in pixels; larger curves are halved, and
/// the halves out of view dropped.
const WHOLE_PX: f64 = 1024.0;
/// Most halvings of one segment: enough to bring 10^18 px below that side, the largest coordinate
/// at the largest scale.
const MAX_HALVINGS: u32 = 50;

/// Calls `emit` with the lines of a run of control points, in pixels. Drops lines outside
/// `clip_box`, so that cost and coordinates stay small however large the curve.
///
/// A line is kept whole: its ends do not depend on the box, and so a tile shows the same bits in a
/// picture of any size. It is at most 3/2 of [`WHOLE_PX`] long.
pub(crate) fn flatten_clipped(
    run: &[Point<f64>],
    clip_box: Bounds<f64>,
    emit: &mut impl FnMut(Point<f64>, Point<f64>),
) {
    flatten_part(run, clip_box, MAX_HALVINGS, emit);
}

fn flatten_part(
    run: &[Point<f64>],
    clip_box: Bounds<f64>,
    halvings: u32,
    emit: &mut impl FnMut(Point<f64>, Point<f64>),
) {
    let hull = hull(run);
    if !hull.intersects(clip_box) {
        return;
    }
    let size = hull.size();
    if halvings == 0 || size.x.max(size.y) <= WHOLE_PX {
        let mut last = None;
        flatten_run(run, TOLERANCE_PX, &mut |vertex| {
            if let Some(last) = last.replace(vertex)
                && meets(last, vertex, clip_box)
            {
                emit(last, vertex);
            }
        });
    } else if let Ok(segment) = run.try_into() {
        for half in uniform::halves(segment) {
            flatten_part(&half, clip_box, halvings - 1, emit);
        }
    } else {
        let middle = (run.len() - 3) / 2;
        flatten_part(&run[..middle + 3], clip_box, halvings, emit);
        flatten_part(&run[middle..], clip_box, halvings, emit);
    }
}

/// Returns `true` if the box of a line meets a box.
fn meets(a: Point<f64>, b: Point<f64>, clip_box: Bounds<f64>) -> bool {
    hull(&[a, b]).intersects(clip_box)
}

fn hull(points: &[Point<f64>]) -> Bounds<f64> {
    let mut hull = Bounds {
        min: points[0],
        max: points[0],
    };
    for &p in &points[1..] {
        hull = hull.union(Bounds { min: p, max: p });
    }
    hull
}

#[cfg(test)]
mod tests {
    use super::*;

    const VIEW: Bounds<f64> = Bounds {
        min: Point { x: 0.0, y: 0.0 },
        max: Point { x: 200.0, y: 100.0 },
    };

    fn lines(control: &[Point<f64>]) -> Vec<(Point<f64>, Point<f64>)> {
        let mut lines = Vec::new();
        let mut emit = |a, b| lines.push((a, b));
        flatten_clipped(control, VIEW, &mut emit);
        lines
    }

    fn distance(p: Point<f64>, a: Point<f64>, b: Point<f64>) -> f64 {
        let along = b - a;
        let t = (p - a).dot(along) / along.dot(along).max(1e-30);
        p.distance(a + along * t.clamp(0.0, 1.0))
    }

    #[test]
    fn lines_stay_within_the_tolerance_of_the_curve() {
        let control: Vec<_> = [(10, 10), (60, 90), (90, 20), (100, 80), (20, 90), (180, 10)]
            .map(|(x, y)| Point::new(f64::from(x), f64::from(y)))
            .to_vec();
        let lines = lines(&control);
        assert!(lines.len() < 100, "{}", lines.len());
        for p in control.windows(4) {
            for i in 0..=100 {
                let at = uniform::point(&[p[0], p[1], p[2], p[3]], f64::from(i) / 100.0);
                let near = lines.iter().map(|&(a, b)| distance(at, a, b));
                assert!(near.fold(f64::INFINITY, f64::min) <= TOLERANCE_PX);
            }
        }
    }

    #[test]
    fn a_small_path_is_one_line_and_so_is_a_point() {
        let small: Vec<_> = (0..11)
            .map(|i| Point::new(50.0 + f64::from(i), 50.0 + 0.03 * f64::from(i % 2)))
            .collect();
        assert_eq!(lines(&small).len(), 1);
        let p = Point::new(3.0, 4.0);
        let dot = lines(&[p; 4]);
        assert_eq!(dot.len(), 1);
        assert!(dot[0].0.distance(p) < 1e-12 && dot[0].1.distance(p) < 1e-12);
    }

    #[test]
    fn drops_curves_far_outside_and_keeps_short_lines() {
        // Symmetric about the middle of the view, so that it passes there.
        let huge = [(-1e10, 3e9), (-1e9, -1e9), (1e9, 1e9), (1e10, -3e9)];
        let lines = lines(&huge.map(|(x, y)| Point::new(100.0 + x, 50.0 + y)));
        assert!((1..40).contains(&lines.len()), "{}", lines.len());
        assert!(lines.iter().all(|&(a, b)| meets(a, b, VIEW)));
        assert!(lines.iter().all(|(a, b)| a.distance(*b) <= 1.5 * WHOLE_PX));
    }

    #[test]
    fn lines_are_those_of_every_other_box_that_they_meet() {
        let huge = [(-9e3, 2e4), (-1e3, -9e3), (8e3, 1e4), (2e4, -8e4)];
        let control = huge.map(|(x, y)| Point::new(x, y));
        let small = lines(&control);
        let mut large = Vec::new();
        flatten_clipped(&control, VIEW.inflated(1e4), &mut |a, b| large.push((a, b)));
        assert!(small.len() < large.len());
        assert!(small.iter().all(|line| large.contains(line)));
    }
}
