//! Bounding box and origin of a cluster, updated from the hulls of the members that changed.

use guideway_spline::{Affine, Bounds, Point};

/// Box of the control points of some rows, in meters; `None` without points.
pub type MemberHull = Option<Bounds<f64>>;

/// Bounding box of a cluster, in meters, and the origin of its local coordinates.
///
/// The box may exceed the tight one: when a member leaves a side of the box, only a pass over all
/// members finds the tight box. The box tolerates a slack instead, up to a quarter of its size.
#[derive(Clone, Copy, Debug)]
pub struct ClusterBounds {
    /// Holds all control points of the cluster.
    pub bounds: Bounds<f64>,
    /// Origin of data that is stored relative to the cluster, such as polylines. It stays in place
    /// while some members move a little, so that the data of the others stays valid, and moves when
    /// all members move.
    pub origin: Point<f64>,
    /// Most that a side of the tight box may lie inside of `bounds`.
    slack_m: f64,
}

impl ClusterBounds {
    /// The tight box `bounds`, with its center as origin.
    pub fn new(bounds: Bounds<f64>) -> Self {
        Self {
            bounds,
            slack_m: 0.0,
            origin: bounds.center(),
        }
    }

    /// Replaces the box by the tight box `bounds`. Keeps the origin while it is within a quarter of
    /// the size from the center.
    #[must_use]
    pub fn with_bounds(self, bounds: Bounds<f64>) -> Self {
        let size = bounds.size();
        let off = self.origin - bounds.center();
        if off.x.abs() <= size.x / 4.0 && off.y.abs() <= size.y / 4.0 {
            Self {
                bounds,
                slack_m: 0.0,
                ..self
            }
        } else {
            Self::new(bounds)
        }
    }

    /// Updates the box after some members changed their hull from `from` to `to`. `None` if the
    /// slack would become too large: the caller then recomputes the box from all members.
    pub fn after_change(&self, from: MemberHull, to: MemberHull) -> Option<Self> {
        let slack_m = self.slack_m + self.retreat_m(from, to);
        let bounds = to.map_or(self.bounds, |to| self.bounds.union(to));
        self.with_slack(bounds, slack_m)
    }

    /// Updates the box after all members were mapped `by`, which maps the old box into `bounds`.
    /// `None` if the slack would become too large. A translation moves the origin, too.
    pub fn after_map(&self, by: Affine, bounds: Bounds<f64>) -> Option<Self> {
        if let Some(by) = by.as_translation() {
            return Some(Self {
                bounds,
                origin: self.origin + by,
                ..*self
            });
        }
        // A point of the cluster is within the slack of each side, anywhere along it: a mapped side
        // can retreat by the slack across it and by the whole length along it.
        let Point { x, y } = self.bounds.size();
        let slack_m = |by_x: f64, by_y: f64| {
            let (by_x, by_y) = (by_x.abs(), by_y.abs());
            (by_x * self.slack_m + by_y * y).min(by_x * x + by_y * self.slack_m)
        };
        let [x, y] = [slack_m(by.x.x, by.y.x), slack_m(by.x.y, by.y.y)];
        self.with_slack(bounds, x.max(y))
    }

    /// The cluster where a map shows it: with the mapped origin, and a box of the mapped box.
    #[must_use]
    pub fn shown(&self, by: Affine) -> Self {
        let corners = self.bounds.corners().map(|p| by.apply(p));
        Self {
            bounds: Bounds::of_points(corners).unwrap_or(self.bounds),
            origin: by.apply(self.origin),
            ..*self
        }
    }

    /// Replaces the box, unless the slack is too large.
    fn with_slack(&self, bounds: Bounds<f64>, slack_m: f64) -> Option<Self> {
        /// Largest slack, in parts of the larger side: a box that is larger costs more in culling
        /// than recomputing it from its members.
        const MAX_SLACK: f64 = 1.0 / 4.0;
        let size = bounds.size();
        let is_small = slack_m <= size.x.max(size.y) * MAX_SLACK;
        is_small.then(|| Self {
            slack_m,
            ..self.with_bounds(bounds)
        })
    }

    /// Upper bound of how far a side of the tight box moves inward.
    fn retreat_m(&self, from: MemberHull, to: MemberHull) -> f64 {
        let Some(from) = from else {
            return 0.0;
        };
        let [a, b] = [from.min - self.bounds.min, self.bounds.max - from.max];
        if a.x.min(a.y).min(b.x).min(b.y) > self.slack_m {
            return 0.0;
        }
        to.map_or(f64::INFINITY, |to| {
            let [a, b] = [to.min - from.min, to.max - from.max];
            let steps = [a.x, a.y, b.x, b.y].map(f64::abs);
            steps.into_iter().fold(0.0, f64::max)
        })
    }

    /// Largest distance of the box from its origin along an axis, in meters.
    #[inline]
    pub fn reach_m(&self) -> f64 {
        let [a, b] = [self.origin - self.bounds.min, self.bounds.max - self.origin];
        a.x.max(a.y).max(b.x).max(b.y)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bounds(from: f64, to: f64) -> Bounds<f64> {
        Bounds {
            min: Point::new(from, from),
            max: Point::new(to, to),
        }
    }

    #[test]
    fn a_change_inside_keeps_the_box_and_one_at_its_side_needs_all_members() {
        let cluster = ClusterBounds::new(bounds(0.0, 80.0));
        let after = |from, to| cluster.after_change(from, to).map(|after| after.bounds);
        let (inner, outer) = (Some(bounds(1.0, 79.0)), Some(bounds(70.0, 90.0)));
        assert_eq!(after(inner, outer), Some(bounds(0.0, 90.0)));
        assert_eq!(after(None, outer), Some(bounds(0.0, 90.0)));
        assert_eq!(after(inner, None), Some(bounds(0.0, 80.0)));
        for side in [bounds(0.0, 79.0), bounds(1.0, 80.0)] {
            assert_eq!(after(Some(side), outer), None);
            assert_eq!(after(Some(side), None), None);
        }
    }

    #[test]
    fn a_side_may_retreat_by_a_quarter_of_the_size() {
        let mut cluster = ClusterBounds::new(bounds(0.0, 80.0));
        for step in 0..20 {
            let from = f64::from(step);
            let [from, to] = [from, from + 1.0].map(|from| Some(bounds(from, 40.0)));
            cluster = cluster.after_change(from, to).unwrap();
            assert_eq!(cluster.bounds, bounds(0.0, 80.0));
        }
        let at_side = Some(bounds(0.0, 40.0));
        assert!(cluster.after_change(at_side, at_side).is_some());
        let inward = Some(bounds(0.1, 40.0));
        assert!(cluster.after_change(at_side, inward).is_none());
        let tight = cluster.with_bounds(bounds(20.0, 80.0));
        let [from, to] = [20.0, 21.0].map(|from| Some(bounds(from, 29.0)));
        assert!(tight.after_change(from, to).is_some());
    }

    #[test]
    fn a_mapped_box_exceeds_the_tight_one_by_its_slack_at_most() {
        let points: Vec<_> = (0..40)
            .map(|i| Point::new(f64::from(i), (f64::from(i) * 0.7).sin() * 9.0))
            .collect();
        let hull = |points: &[Point<f64>]| Bounds::of_slice(points).unwrap();
        let axis = Point::new(1.0, 0.0);
        for (by, least_known) in [
            (Affine::translation(Point::new(3.0, -1.0)), 20),
            (Affine::rotation(0.03, Point::new(5.0, 5.0)), 10),
            (Affine::mirror(Point::new(0.0, 1.0), axis), 20),
            // The mapped box is slanted: the extremes of the points in it are unknown.
            (Affine::mirror(axis, Point::new(1.0, 0.2)), 0),
            (Affine::scale(1.5, 0.5, Point::new(-3.0, 2.0)), 20),
        ] {
            let mut at = points.clone();
            let mut cluster = ClusterBounds::new(hull(&at));
            let mut known = 0;
            for _ in 0..20 {
                at.iter_mut().for_each(|p| *p = by.apply(*p));
                let corners = cluster.bounds.corners().map(|p| by.apply(p));
                let mapped = cluster.after_map(by, hull(&corners));
                known += u32::from(mapped.is_some());
                cluster = mapped.unwrap_or_else(|| cluster.with_bounds(hull(&at)));
                let (most, least) = (cluster.bounds.inflated(1e-9), hull(&at));
                assert!(most.contains(least.min) && most.contains(least.max));
                let size = most.size() - least.size();
                assert!(size.x.max(size.y) <= 2.0 * cluster.slack_m + 1e-6, "{by:?}");
            }
            assert!(known >= least_known, "{by:?}: {known}");
        }
    }
}
