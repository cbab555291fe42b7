//! Points at equal distances along a path.

use guideway_spline::{Point, flatten_run};

use super::table::{LENGTH_TOLERANCE_M, PathRef};

/// A point of a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Distance from the start of the path, along the curve.
    pub along_m: f64,
    /// The place, within a tenth of a millimeter of the curve.
    pub position_m: Point<f64>,
    /// Direction of the curve towards its end: 0 along x, counterclockwise.
    pub heading_rad: f64,
}

impl PathRef<'_> {
    /// Hands points from start to end to `each`, at equal distances of at most `spacing_m` along
    /// the curve, which is above 0. A path without segments has none.
    ///
    /// ```text
    /// o-----o-----o-----o     10 m by at most 4 m: three steps of 3.33 m
    /// ```
    pub fn sample(self, spacing_m: f64, each: impl FnMut(Sample)) {
        let mut line = Vec::new();
        for run in self.runs() {
            let points: Vec<Point<f64>> = run.iter().collect();
            flatten_run(&points, LENGTH_TOLERANCE_M, &mut |point| line.push(point));
        }
        line.dedup();
        sample_line(&line, spacing_m, each);
    }
}

fn sample_line(line: &[Point<f64>], spacing_m: f64, mut each: impl FnMut(Sample)) {
    let length_m: f64 = line.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
    let steps = (length_m / spacing_m).ceil().max(1.0);
    let mut passed_m = 0.0;
    let mut step = 0.0;
    let pieces = line.len().saturating_sub(1);
    for (index, pair) in line.windows(2).enumerate() {
        let (from, way) = (pair[0], pair[1] - pair[0]);
        let piece_m = pair[0].distance(pair[1]);
        let heading_rad = way.y.atan2(way.x);
        // Rounding must not lose the last point.
        let is_last = index + 1 == pieces;
        while step <= steps && (is_last || length_m * step / steps < passed_m + piece_m) {
            let along_m = length_m * step / steps;
            let share = ((along_m - passed_m) / piece_m).clamp(0.0, 1.0);
            each(Sample {
                along_m,
                position_m: from + way * share,
                heading_rad,
            });
            step += 1.0;
        }
        passed_m += piece_m;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sampled(line: &[(f64, f64)], spacing_m: f64) -> Vec<Sample> {
        let line: Vec<_> = line.iter().map(|&(x, y)| Point { x, y }).collect();
        let mut samples = Vec::new();
        sample_line(&line, spacing_m, |sample| samples.push(sample));
        samples
    }

    #[test]
    fn samples_lie_at_equal_distances_from_end_to_end() {
        let samples = sampled(&[(0.0, 0.0), (3.0, 0.0), (3.0, 7.0)], 4.0);
        let along: Vec<f64> = samples.iter().map(|sample| sample.along_m).collect();
        assert_eq!(along, [0.0, 10.0 / 3.0, 20.0 / 3.0, 10.0]);
        let at = |index: usize| samples[index].position_m;
        assert_eq!((at(0).x, at(0).y), (0.0, 0.0));
        assert_eq!(at(1).x, 3.0);
        assert!((at(1).y - 1.0 / 3.0).abs() < 1e-12);
        assert_eq!((at(3).x, at(3).y), (3.0, 7.0));
        assert_eq!(samples[0].heading_rad, 0.0);
        assert_eq!(samples[3].heading_rad, std::f64::consts::FRAC_PI_2);
    }

    #[test]
    fn a_point_has_no_samples_and_a_short_line_both_ends() {
        assert!(sampled(&[(1.0, 1.0)], 1.0).is_empty());
        assert_eq!(sampled(&[(0.0, 0.0), (0.5, 0.0)], 1.0).len(), 2);
    }
}
