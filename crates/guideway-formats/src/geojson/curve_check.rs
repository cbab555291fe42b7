//! Curve check: compares the line of a feature with the exact curve in its properties.

use guideway_spline::{Point, Runs, nearest_on_run, uniform};

/// Largest distance of a position from the curve, in meters: the tolerance of written lines.
const TOLERANCE_M: f64 = 1e-3;

/// Returns whether all positions of a line lie on a curve, in order and from its start to its end.
///
/// Cost: O(positions + segments), whatever a file contains.
pub(super) fn is_along(line: &[Point<f64>], curve: &Runs) -> bool {
    let mut segments = Vec::new();
    for run in curve.iter() {
        segments.extend(run.array_windows::<4>());
    }
    let ends = segments.first().zip(segments.last());
    let Some(((start, end), (first, last))) = ends.zip(line.first().zip(line.last())) else {
        return false;
    };
    let is_at_ends = first.distance(uniform::start(start)) <= TOLERANCE_M
        && last.distance(uniform::end(end)) <= TOLERANCE_M;
    let is_near = |segment: &[Point<f64>; 4], position| {
        let nearest = nearest_on_run(segment, position, 0.1 * TOLERANCE_M);
        nearest.is_some_and(|nearest| nearest.distance <= TOLERANCE_M)
    };
    let mut rest = segments.into_iter().peekable();
    is_at_ends
        && line.iter().all(|&position| {
            while rest
                .next_if(|segment| !is_near(segment, position))
                .is_some()
            {}
            rest.peek().is_some()
        })
}

#[cfg(test)]
mod tests {
    use guideway_spline::{arc_to_runs, flatten_run};

    use super::*;

    #[test]
    fn a_flattened_curve_lies_along_it_until_a_position_moves() {
        let mut curve = Runs::default();
        arc_to_runs(Point::new(3.0, 1.0), 8.0, 0.3, 5.0, 1e-5, &mut curve);
        let mut line = Vec::new();
        for run in curve.iter() {
            flatten_run(run, 1e-3, &mut |point| line.push(point));
        }
        assert!(line.len() > 20 && is_along(&line, &curve));
        let moved = |row: usize| {
            let mut line = line.clone();
            line[row].y += 0.02;
            line
        };
        for row in [0, 5, line.len() - 1] {
            assert!(!is_along(&moved(row), &curve), "{row}");
        }
        assert!(!is_along(&line[..9], &curve), "the end is missing");
        assert!(!is_along(&[], &curve));
    }
}
