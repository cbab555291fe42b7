//! Walks along the center lines of paths in the pixels of a picture, a sample of all paths first.

use std::ops::Range;

use guideway_layout::PathRef;
use guideway_scene::View;
use guideway_spline::{Point, uniform};

/// Rows of a block: neighbors in memory.
const BLOCK: usize = 64;
/// Parts that each say something of all paths: a sixteenth of them, spread over all rows.
pub(crate) const PARTS: usize = 16;

/// The rows of one of [`PARTS`] parts of `0..len`: every sixteenth block.
pub(crate) fn rows_of_part(len: usize, part: usize) -> impl Iterator<Item = Range<usize>> {
    let blocks = (part..len.div_ceil(BLOCK)).step_by(PARTS);
    blocks.map(move |block| block * BLOCK..len.min((block + 1) * BLOCK))
}

/// Hands points on the center line of a path to `at`, at most about a unit apart: pixels from the
/// upper left corner of the picture, times `scale`. Points on the left of it or above it are left
/// out.
pub(crate) fn walk(path: PathRef<'_>, view: &View, scale: f64, mut at: impl FnMut(usize, usize)) {
    /// Most steps of a segment: one across a wide picture.
    const MOST: f64 = 4096.0;
    let square = |of: Point<f64>| of.dot(of);
    for run in path.runs() {
        // A point of a run is mapped once, though four segments need it.
        let mut points = run.iter().map(|p| view.pixel_from_world(p) * scale);
        let (Some(a), Some(b), Some(c)) = (points.next(), points.next(), points.next()) else {
            continue;
        };
        let mut corners = [a, a, b, c];
        let mut legs = [0.0, square(b - a), square(c - b)];
        for next in points {
            corners = [corners[1], corners[2], corners[3], next];
            legs = [legs[1], legs[2], square(next - corners[2])];
            let longest = legs[0].max(legs[1]).max(legs[2]);
            let steps = longest.sqrt().clamp(1.0, MOST).ceil();
            for step in 0..steps as u32 {
                let point = uniform::point(&corners, f64::from(step) / steps);
                if point.x >= 0.0 && point.y >= 0.0 {
                    at(point.x as usize, point.y as usize);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use guideway_layout::{Layout, NewPath};
    use guideway_scene::FrameSize;
    use guideway_spline::Runs;

    use super::*;

    #[test]
    fn parts_hold_every_row_once_and_each_is_spread_over_all() {
        for len in [0, 1, 64, 1000, 40_000] {
            let mut all: Vec<usize> = Vec::new();
            for part in 0..PARTS {
                let rows: Vec<usize> = rows_of_part(len, part).flatten().collect();
                let is_spread = rows.last().is_some_and(|last| last + PARTS * BLOCK >= len);
                assert!(len < PARTS * BLOCK || is_spread, "{len}, {part}");
                all.extend(rows);
            }
            all.sort_unstable();
            assert!(all.into_iter().eq(0..len));
        }
    }

    #[test]
    fn walk_visits_every_pixel_of_a_line() {
        let mut runs = Runs::default();
        runs.push_line(Point::new(-1.98, -0.02), Point::new(3.02, -0.02));
        let mut layout = Layout::default();
        layout.paths.push(&NewPath {
            runs: &runs,
            ..NewPath::default()
        });
        let size = FrameSize::new(100, 20).unwrap();
        let view = View::new(size, Point::default(), 20.0).unwrap();
        let mut visited = Vec::new();
        walk(layout.paths.get(0), &view, 1.0, |x, y| visited.push((x, y)));
        visited.dedup();
        assert!(visited.into_iter().eq((10..110).map(|x| (x, 10))));
    }
}
