//! Where clusters lie.

use guideway_scene::{PathState, Scene};
use guideway_spline::{Affine, Bounds, Point};

/// Where a cluster lies, in meters.
#[derive(Clone, Copy, Debug)]
pub(super) struct Extent {
    /// Where its control points lie, or a little more.
    pub(super) bounds: Bounds<f64>,
    /// How far its borders may have come in since all of its paths were looked at.
    slack_m: f64,
    /// What its lines are measured from. It stays where it is while some paths move a little, and so do the lines of the others;
    /// it moves with all of them, and so do their lines.
    pub(super) middle: Point<f64>,
}

impl Extent {
    pub(super) fn new(bounds: Bounds<f64>) -> Self {
        Self {
            bounds,
            slack_m: 0.0,
            middle: bounds.center(),
        }
    }

    /// After its paths have changed, and all were looked at.
    pub(super) fn changed(self, bounds: Bounds<f64>) -> Self {
        let size = bounds.size();
        let off = self.middle - bounds.center();
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

    /// The same after some of its paths have gone from `from` to `to`; none if that takes a look at all of them, for some
    /// were at its border and have gone farther than may be neglected.
    pub(super) fn after(&self, from: Hull, to: Hull) -> Option<Self> {
        let slack_m = self.slack_m + self.retreat_m(from, to);
        let bounds = to.map_or(self.bounds, |to| self.bounds.union(to));
        self.within(bounds, slack_m)
    }

    /// The same after all of its paths were mapped, which took its bounds to `bounds`: what is still known of where they
    /// lie, unless that is too little. Its middle is moved with paths that are moved.
    pub(super) fn mapped(&self, by: Affine, bounds: Bounds<f64>) -> Option<Self> {
        if let Some(by) = by.as_translation() {
            return Some(Self {
                bounds,
                middle: self.middle + by,
                ..*self
            });
        }
        // A border comes from one on which there is a path, off by the slack, but it is not known where along it.
        let Point { x, y } = self.bounds.size();
        let slack_m = |by_x: f64, by_y: f64| {
            let (by_x, by_y) = (by_x.abs(), by_y.abs());
            (by_x * self.slack_m + by_y * y).min(by_x * x + by_y * self.slack_m)
        };
        let [x, y] = [slack_m(by.x.x, by.y.x), slack_m(by.x.y, by.y.y)];
        self.within(bounds, x.max(y))
    }

    /// Changed to bounds of so much slack, unless that is too much.
    fn within(&self, bounds: Bounds<f64>, slack_m: f64) -> Option<Self> {
        /// The part of its size that the bounds may be too large by.
        const MOST_SLACK: f64 = 1.0 / 4.0;
        let size = bounds.size();
        let is_little = slack_m <= size.x.max(size.y) * MOST_SLACK;
        is_little.then(|| Self {
            slack_m,
            ..self.changed(bounds)
        })
    }

    /// Farthest that a border may have come in.
    fn retreat_m(&self, from: Hull, to: Hull) -> f64 {
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

    /// Farthest that it reaches from its middle, to the side or up and down.
    pub(super) fn reach_m(&self) -> f64 {
        let [a, b] = [self.middle - self.bounds.min, self.bounds.max - self.middle];
        a.x.max(a.y).max(b.x).max(b.y)
    }
}

/// Where the control points of a path lie, in meters; none if it has none.
pub(super) type Hull = Option<Bounds<f64>>;

/// Where the control points of those paths lie that are shown, in meters, by their hulls.
pub(super) fn shown_bounds(scene: &Scene, paths: &[u32]) -> Hull {
    let rows = shown(scene, paths).map(|path| path as usize);
    scene.hulls().of(rows)
}

/// The same from the control points.
pub(super) fn bounds_anew(scene: &Scene, paths: &[u32]) -> Hull {
    let rows = shown(scene, paths).map(|path| path as usize);
    ask_for(scene, rows.clone());
    scene.layout().paths.geometry().hull_bounds(rows)
}

/// Asks for all paths, which lie anywhere, so that their ways through the caches go side by side.
pub(super) fn ask_for(scene: &Scene, rows: impl Iterator<Item = usize>) {
    let geometry = scene.layout().paths.geometry();
    rows.for_each(|row| geometry.prefetch(row));
}

fn shown(scene: &Scene, paths: &[u32]) -> impl Iterator<Item = u32> + Clone {
    let paths = paths.iter().copied();
    paths.filter(|&path| scene.state(path) == PathState::Shown)
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
    fn a_box_is_known_unless_what_left_was_at_its_border() {
        let extent = Extent::new(bounds(0.0, 80.0));
        let after = |from, to| extent.after(from, to).map(|extent| extent.bounds);
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
    fn a_border_may_come_in_a_little_and_then_all_are_looked_at() {
        let mut extent = Extent::new(bounds(0.0, 80.0));
        for step in 0..20 {
            let from = f64::from(step);
            let [from, to] = [from, from + 1.0].map(|from| Some(bounds(from, 40.0)));
            extent = extent.after(from, to).unwrap();
            assert_eq!(extent.bounds, bounds(0.0, 80.0));
        }
        let at_border = Some(bounds(0.0, 40.0));
        assert!(extent.after(at_border, at_border).is_some());
        assert!(extent.after(at_border, Some(bounds(0.1, 40.0))).is_none());
        let looked_at = extent.changed(bounds(20.0, 80.0));
        assert!(
            looked_at
                .after(Some(bounds(20.0, 29.0)), Some(bounds(21.0, 29.0)))
                .is_some()
        );
    }

    #[test]
    fn a_mapped_box_is_too_large_by_its_slack_at_most() {
        let points: Vec<_> = (0..40)
            .map(|i| Point::new(f64::from(i), (f64::from(i) * 0.7).sin() * 9.0))
            .collect();
        let hull = |points: &[Point<f64>]| Bounds::of_slice(points).unwrap();
        let axis = Point::new(1.0, 0.0);
        for (by, least_known) in [
            (Affine::translation(Point::new(3.0, -1.0)), 20),
            (Affine::rotation(0.03, Point::new(5.0, 5.0)), 10),
            (Affine::mirror(Point::new(0.0, 1.0), axis), 20),
            // Where it lies in the slanted box has to be looked at.
            (Affine::mirror(axis, Point::new(1.0, 0.2)), 0),
            (Affine::scale(1.5, 0.5, Point::new(-3.0, 2.0)), 20),
        ] {
            let mut at = points.clone();
            let mut extent = Extent::new(hull(&at));
            let mut known = 0;
            for _ in 0..20 {
                at.iter_mut().for_each(|p| *p = by.apply(*p));
                let corners = extent.bounds.corners().map(|p| by.apply(p));
                let mapped = extent.mapped(by, hull(&corners));
                known += u32::from(mapped.is_some());
                extent = mapped.unwrap_or_else(|| extent.changed(hull(&at)));
                let (most, least) = (extent.bounds.inflated(1e-9), hull(&at));
                assert!(most.contains(least.min) && most.contains(least.max));
                let size = most.size() - least.size();
                assert!(size.x.max(size.y) <= 2.0 * extent.slack_m + 1e-6, "{by:?}");
            }
            assert!(known >= least_known, "{by:?}: {known}");
        }
    }
}
