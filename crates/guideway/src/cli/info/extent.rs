//! Total length and bounding box of all paths, and the length of each kind.

use guideway::layout::{PathRef, Paths};
use guideway::spline::{Bounds, Point, segment_length};
use rayon::prelude::*;

/// Maximum error of the length of a segment, relative to the size of its control polygon.
const TOLERANCE: f64 = 1e-7;

/// Total length of paths in meters, and their tight bounding box.
pub(super) struct Extent {
    pub(super) length_m: f64,
    pub(super) bounds: Option<Bounds<f64>>,
}

impl Extent {
    const NONE: Self = Self {
        length_m: 0.0,
        bounds: None,
    };

    /// The extent of all paths, and the length of each kind of path: `kind_of` maps a row to a
    /// number below `kinds`.
    pub(super) fn of(
        paths: &Paths,
        kinds: usize,
        kind_of: impl Fn(usize) -> usize + Sync,
    ) -> (Self, Vec<f64>) {
        // Joined in order, so that the rounded sum does not depend on the threads.
        const CHUNK: usize = 4096;
        let starts: Vec<usize> = (0..paths.len()).step_by(CHUNK).collect();
        let chunks: Vec<(Self, Vec<f64>)> = starts
            .into_par_iter()
            .map(|start| {
                let (mut all, mut lengths_m) = (Self::NONE, vec![0.0; kinds]);
                for row in start..paths.len().min(start + CHUNK) {
                    let before_m = all.length_m;
                    all = all.with(paths.get(row));
                    lengths_m[kind_of(row)] += all.length_m - before_m;
                }
                (all, lengths_m)
            })
            .collect();
        let none = (Self::NONE, vec![0.0; kinds]);
        chunks
            .into_iter()
            .fold(none, |(all, mut lengths_m), chunk| {
                let sums = lengths_m.iter_mut().zip(chunk.1);
                sums.for_each(|(sum, length_m)| *sum += length_m);
                (all.join(chunk.0), lengths_m)
            })
    }

    fn with(self, path: PathRef<'_>) -> Self {
        let segments = path.runs().flat_map(|run| run.segments());
        segments.fold(self, Self::with_segment)
    }

    fn with_segment(self, segment: [Point<f64>; 4]) -> Self {
        let Some(hull) = Bounds::of_points(segment) else {
            return self;
        };
        let size = hull.size();
        let length_m = segment_length(&segment, TOLERANCE * (size.x + size.y));
        // Only a segment that may extend the box so far needs its own tight box.
        let is_inside = |all: Bounds<f64>| all.contains(hull.min) && all.contains(hull.max);
        let bounds = match self.bounds {
            Some(all) if is_inside(all) => None,
            _ => Some(Bounds::of_segment(&segment)),
        };
        self.join(Self { length_m, bounds })
    }

    fn join(self, other: Self) -> Self {
        let both = self.bounds.zip(other.bounds).map(|(a, b)| a.union(b));
        Self {
            length_m: self.length_m + other.length_m,
            bounds: both.or(self.bounds).or(other.bounds),
        }
    }
}

#[cfg(test)]
mod tests {
    use guideway::layout::{Layout, NewPath};
    use guideway::spline::Runs;

    use super::*;

    #[test]
    fn sums_lengths_and_unites_boxes() {
        let mut layout = Layout::default();
        for x in [0.0, 1e6] {
            let mut runs = Runs::default();
            // y = x^2 from 0 to 1, which is sqrt(5)/2 + asinh(2)/4 long.
            let parabola = [
                (0.0, 0.0),
                (1.0 / 3.0, 0.0),
                (2.0 / 3.0, 1.0 / 3.0),
                (1.0, 1.0),
            ];
            runs.push_bezier(&parabola.map(|(dx, y)| Point::new(x + dx, y)));
            layout.paths.push(&NewPath {
                runs: &runs,
                ..NewPath::default()
            });
        }
        let (extent, lengths_m) = Extent::of(&layout.paths, 2, |row| row);
        assert_eq!(lengths_m.iter().sum::<f64>(), extent.length_m);
        assert!((lengths_m[0] - lengths_m[1]).abs() < 1e-9);
        let known = 2.0 * (5f64.sqrt() / 2.0 + 2f64.asinh() / 4.0);
        assert!((extent.length_m - known).abs() < 1e-6 * known);
        let size = extent.bounds.unwrap().size();
        assert!((size.x - 1_000_001.0).abs() < 1e-6 && (size.y - 1.0).abs() < 1e-6);
    }
}
