//! [`BoxIndex`]: finds the cubics whose boxes overlap another box.

use guideway_spline::bezier::{Bezier, bounds};
use guideway_spline::{Bounds, Point};
use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, RTree};

use super::drawn::Drawn;

/// A cubic of a curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Part {
    pub(super) curve: u32,
    pub(super) bezier: u32,
}

/// The boxes of all cubics in a tree.
pub(super) struct BoxIndex {
    tree: RTree<GeomWithData<Rectangle<[f64; 2]>, Part>>,
}

impl BoxIndex {
    pub(super) fn of(drawn: &Drawn) -> Self {
        let parts = drawn.curves.iter().enumerate().flat_map(|(curve, c)| {
            c.beziers.iter().enumerate().map(move |(bezier, b)| {
                let part = Part {
                    curve: curve as u32,
                    bezier: bezier as u32,
                };
                GeomWithData::new(Rectangle::from_aabb(aabb(bounds(b))), part)
            })
        });
        Self {
            tree: RTree::bulk_load(parts.collect()),
        }
    }

    /// Cubics whose box overlaps that of a cubic.
    pub(super) fn overlapping(&self, b: &Bezier) -> impl Iterator<Item = Part> {
        self.within(bounds(b))
    }

    /// Cubics whose box is within a distance of a point.
    pub(super) fn near(&self, to: Point<f64>, reach_m: f64) -> impl Iterator<Item = Part> {
        self.within(Bounds { min: to, max: to }.inflated(reach_m))
    }

    fn within(&self, bounds: Bounds<f64>) -> impl Iterator<Item = Part> {
        let found = self.tree.locate_in_envelope_intersecting(aabb(bounds));
        found.map(|entry| entry.data)
    }
}

fn aabb(bounds: Bounds<f64>) -> AABB<[f64; 2]> {
    AABB::from_corners([bounds.min.x, bounds.min.y], [bounds.max.x, bounds.max.y])
}
