//! Flattens a run of control points to lines within a box: for curves too large for cached lines.

use guideway_spline::{Bounds, Point, flatten_run, uniform};

/// Largest distance of a line from its curve, in pixels. The borders of a stroke move by as much,
/// which changes a pixel by about 1/30.
const TOLERANCE_PX: f64 = 1.0 / 32.0;
/// Largest side of the hull of what is flattened at once, in pixels; larger curves are halved, and
/// the halves out of view dropped.
const WHOLE_PX: f64 = 4096.0;
/// Most halvings of one segment: enough to bring 10^15 px below that side.
const MAX_HALVINGS: u32 = 40;

/// Calls `emit` with the lines of a run of control points, in pixels. Drops lines outside
/// `clip_box` and clips the others, so that cost and coordinates stay small however large the
/// curve.
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
            let line = last.and_then(|last| clip(last, vertex, clip_box));
            if let Some((start, end)) = line {
                emit(start, end);
            }
            last = Some(vertex);
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

/// Clips a line to a box (Liang and Barsky 1984).
fn clip(a: Point<f64>, b: Point<f64>, within: Bounds<f64>) -> Option<(Point<f64>, Point<f64>)> {
    let (mut from, mut to) = (0.0_f64, 1.0_f64);
    let along = b - a;
    for (start, step, min, max) in [
        (a.x, along.x, within.min.x, within.max.x),
        (a.y, along.y, within.min.y, within.max.y),
    ] {
        if step == 0.0 {
            if start < min || start > max {
                return None;
            }
        } else {
            let (t0, t1) = ((min - start) / step, (max - start) / step);
            from = from.max(t0.min(t1));
            to = to.min(t0.max(t1));
        }
    }
    // Ends inside the box keep their bits.
    let start = if from > 0.0 { a + along * from } else { a };
    let end = if to < 1.0 { a + along * to } else { b };
    (from <= to).then_some((start, end))
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
    fn drops_curves_far_outside() {
        let huge = [(-1e10, 3e9), (-1e9, -1e9), (1e9, 1.000_001e9), (2e9, -8e9)];
        let lines = lines(&huge.map(|(x, y)| Point::new(x, y)));
        assert!(lines.len() < 40, "{}", lines.len());
        let near = VIEW.inflated(1e-3);
        assert!(
            lines
                .iter()
                .all(|&(a, b)| near.contains(a) && near.contains(b))
        );
    }

    #[test]
    fn clips_a_line_to_the_box() {
        let p = Point::new;
        assert_eq!(
            clip(p(-1024.0, 50.0), p(1024.0, 50.0), VIEW),
            Some((p(0.0, 50.0), p(200.0, 50.0)))
        );
        assert_eq!(clip(p(-10.0, 5.0), p(5.0, -100.0), VIEW), None);
        assert_eq!(
            clip(p(1.0, 2.0), p(3.0, 4.0), VIEW),
            Some((p(1.0, 2.0), p(3.0, 4.0)))
        );
    }
}
