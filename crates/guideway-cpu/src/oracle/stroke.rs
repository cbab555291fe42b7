//! A path as it is drawn, and its butt caps: half discs beyond its ends, which it does not cover.

use guideway_layout::RunPoints;
use guideway_scene::{CLOSED_M, Rgba, View};
use guideway_spline::{Bounds, Point};

/// A path that may be visible.
pub(super) struct Stroke {
    pub(super) path: u32,
    pub(super) color: Rgba,
    pub(super) radius_px: f64,
    /// Bounding box of all that the path covers.
    pub(super) bounds_px: Bounds<f64>,
    /// The half discs that its butt caps leave out.
    pub(super) cuts: [Option<Cut>; 2],
}

impl Stroke {
    /// Returns `true` if the caps leave out a point.
    pub(super) fn leaves_out(&self, at: Point<f64>) -> bool {
        self.cuts.iter().flatten().any(|cut| cut.holds(at))
    }
}

/// A half disc beyond one end of a path, in pixels.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cut {
    end: Point<f64>,
    /// From the path to the end, of any length.
    outward: Point<f64>,
    radius_px: f64,
}

impl Cut {
    /// Returns `true` if a point lies in the half disc.
    fn holds(&self, at: Point<f64>) -> bool {
        let from_end = at - self.end;
        from_end.dot(self.outward) > 0.0 && from_end.dot(from_end) <= self.radius_px.powi(2)
    }
}

/// The half discs beyond both ends of a path; none for a closed one.
pub(super) fn cuts<'a>(
    runs: impl Iterator<Item = RunPoints<'a>>,
    view: &View,
    radius_px: f64,
) -> [Option<Cut>; 2] {
    let onward: Vec<_> = runs.flat_map(|run| run.segments()).collect();
    let backward: Vec<_> = onward
        .iter()
        .rev()
        .map(|&[a, b, c, d]| [d, c, b, a])
        .collect();
    let ways = [onward, backward];
    let [Some(first), Some(last)] = [0, 1].map(|way| ways[way].first().map(start)) else {
        return [None, None];
    };
    if first.distance(last) <= CLOSED_M {
        return [None, None];
    }
    ways.map(|segments| {
        let inward = segments.iter().find_map(inward)?;
        Some(Cut {
            end: view.pixel_from_world(start(segments.first()?)),
            // The y axis of pictures points down.
            outward: Point::new(-inward.x, inward.y),
            radius_px,
        })
    })
}

/// Start of a segment: equation 3.2 of the thesis at t = 0.
fn start([a, b, c, _]: &[Point<f64>; 4]) -> Point<f64> {
    (*a + *b * 4.0 + *c) * (1.0 / 6.0)
}

/// Direction of a segment at its start: its derivative, or where that vanishes, its chord. `None`
/// for a segment without length.
fn inward(segment: &[Point<f64>; 4]) -> Option<Point<f64>> {
    let [a, b, c, d] = *segment;
    let chord = start(&[b, c, d, d]) - start(segment);
    [c - a, chord].into_iter().find(|way| way.norm() > 1e-9)
}
