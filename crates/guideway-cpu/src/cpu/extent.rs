//! Where clusters lie.

use guideway_scene::{PathState, Scene};
use guideway_spline::{Bounds, Point};

/// Where a cluster lies, in metres.
#[derive(Clone, Copy, Debug)]
pub(super) struct Extent {
    /// Where its control points lie.
    pub(super) bounds: Bounds<f64>,
    /// What its lines are measured from. It stays where it is while paths move a little, and so do their lines.
    pub(super) middle: Point<f64>,
}

impl Extent {
    pub(super) fn new(bounds: Bounds<f64>) -> Self {
        Self {
            bounds,
            middle: bounds.center(),
        }
    }

    /// After its paths have changed.
    pub(super) fn changed(self, bounds: Bounds<f64>) -> Self {
        let size = bounds.size();
        let off = self.middle - bounds.center();
        if off.x.abs() <= size.x / 4.0 && off.y.abs() <= size.y / 4.0 {
            Self { bounds, ..self }
        } else {
            Self::new(bounds)
        }
    }

    /// Farthest that it reaches from its middle, to the side or up and down.
    pub(super) fn reach_m(&self) -> f64 {
        let [a, b] = [self.middle - self.bounds.min, self.bounds.max - self.middle];
        a.x.max(a.y).max(b.x).max(b.y)
    }
}

/// Where the control points of a path lie, in metres; none if it has none.
pub(super) type Hull = Option<Bounds<f64>>;

/// The hull of a row.
pub(super) fn hull(scene: &Scene, row: u32) -> Hull {
    scene.layout().paths.get(row as usize).hull_bounds()
}

/// Where the control points of those paths lie that are shown, in metres, by the hulls of all.
pub(super) fn shown_bounds(scene: &Scene, paths: &[u32], hulls: &[Hull]) -> Hull {
    let hulls = shown(scene, paths).filter_map(|path| hulls[path as usize]);
    hulls.reduce(Bounds::union)
}

/// The same from the control points.
pub(super) fn bounds_anew(scene: &Scene, paths: &[u32]) -> Hull {
    let rows = shown(scene, paths).map(|path| path as usize);
    scene.layout().paths.geometry().hull_bounds(rows)
}

fn shown(scene: &Scene, paths: &[u32]) -> impl Iterator<Item = u32> {
    let paths = paths.iter().copied();
    paths.filter(|&path| scene.state(path) == PathState::Shown)
}
