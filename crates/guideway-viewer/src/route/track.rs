//! The curve of a route, to place a vehicle along it.

use guideway_layout::Layout;
use guideway_spline::{Point, uniform};

/// Points per curve segment: a chord of a bend of 1 m radius is then within a millimeter of it.
const POINTS_PER_SEGMENT: usize = 32;

/// Points along a route, each with its distance from the start in meters.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Track {
    points: Vec<(f64, Point<f64>)>,
}

impl Track {
    /// The curve of all paths of a layout, in their order.
    pub(super) fn of(layout: &Layout) -> Self {
        let mut track = Self::default();
        for path in layout.paths.iter() {
            for segment in path.runs().flat_map(|run| run.segments()) {
                for i in 0..=POINTS_PER_SEGMENT {
                    let t = i as f64 / POINTS_PER_SEGMENT as f64;
                    track.push(uniform::point(&segment, t));
                }
            }
        }
        track
    }

    fn push(&mut self, at_m: Point<f64>) {
        let step_m = self.points.last().map(|(_, last)| last.distance(at_m));
        // Segments share their ends.
        if step_m != Some(0.0) {
            let along_m = self.length_m() + step_m.unwrap_or(0.0);
            self.points.push((along_m, at_m));
        }
    }

    pub(crate) fn length_m(&self) -> f64 {
        self.points.last().map_or(0.0, |(along_m, _)| *along_m)
    }

    /// Position and heading of a vehicle that has driven this far; `None` without a curve.
    pub(crate) fn pose(&self, along_m: f64) -> Option<(Point<f64>, f64)> {
        let after = self.points.partition_point(|(at, _)| *at <= along_m);
        let after = after.clamp(1, self.points.len().checked_sub(1)?.max(1));
        let (&(from_m, from), &(to_m, to)) = (self.points.get(after - 1)?, self.points.get(after)?);
        let part = ((along_m - from_m) / (to_m - from_m)).clamp(0.0, 1.0);
        let along = to - from;
        Some((from.lerp(to, part), along.y.atan2(along.x)))
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use super::*;

    #[test]
    fn vehicle_follows_the_track_at_its_heading() {
        let mut track = Track::default();
        assert_eq!(track.pose(0.0), None);
        for (x, y) in [(0.0, 0.0), (4.0, 0.0), (4.0, 0.0), (4.0, 3.0)] {
            track.push(Point::new(x, y));
        }
        assert_eq!(track.length_m(), 7.0);
        assert_eq!(track.pose(1.0), Some((Point::new(1.0, 0.0), 0.0)));
        assert_eq!(track.pose(5.5), Some((Point::new(4.0, 1.5), FRAC_PI_2)));
        assert_eq!(track.pose(99.0), Some((Point::new(4.0, 3.0), FRAC_PI_2)));
        assert_eq!(track.pose(-1.0), Some((Point::new(0.0, 0.0), 0.0)));
    }
}
