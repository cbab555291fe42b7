//! [`WrittenCurves`]: NURBS curves as their file wrote them, beside the runs that are drawn.

use std::collections::BTreeMap;
use std::sync::Arc;

use guideway_spline::{Affine, Point};

/// A NURBS curve as a file wrote it.
#[derive(Clone, Debug, PartialEq)]
pub struct WrittenCurve {
    /// Degree, 1 or more.
    pub degree: u32,
    /// Knots, as written; empty if the file had none.
    pub knots: Vec<f64>,
    /// Control points, in meters.
    pub points_m: Vec<Point<f64>>,
    /// One weight per control point; `None` if the file had none.
    pub weights: Option<Vec<f64>>,
}

/// The written curves of some paths. The runs of a path without one are its whole curve.
///
/// A reader adds a curve where the runs only approximate it, or need more points than the file had.
/// An edit of the runs removes it; an affine map, under which NURBS are invariant, maps it too.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct WrittenCurves(BTreeMap<u32, Arc<WrittenCurve>>);

impl WrittenCurves {
    /// The written curve of a path.
    pub fn get(&self, path: usize) -> Option<&WrittenCurve> {
        self.0.get(&(path as u32)).map(Arc::as_ref)
    }

    /// Number of paths with a written curve.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// Returns `true` if no path has a written curve.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    pub(crate) fn set(&mut self, path: usize, curve: Option<Arc<WrittenCurve>>) {
        match curve {
            Some(curve) => drop(self.0.insert(path as u32, curve)),
            None => drop(self.0.remove(&(path as u32))),
        }
    }

    pub(crate) fn shared(&self, path: usize) -> Option<Arc<WrittenCurve>> {
        self.0.get(&(path as u32)).cloned()
    }

    pub(crate) fn transform(&mut self, path: usize, by: Affine) {
        if let Some(curve) = self.0.get_mut(&(path as u32)) {
            let points_m = &mut Arc::make_mut(curve).points_m;
            points_m.iter_mut().for_each(|p| *p = by.apply(*p));
        }
    }

    /// The curves of the given paths, in this order.
    pub(crate) fn select(&self, paths: &[usize]) -> Self {
        if self.0.is_empty() {
            return Self::default();
        }
        let curves = paths.iter().enumerate();
        let curve = |(row, &path): (usize, &usize)| Some((row as u32, self.shared(path)?));
        Self(curves.filter_map(curve).collect())
    }

    pub(crate) fn heap_bytes(&self) -> usize {
        let bytes = |curve: &Arc<WrittenCurve>| {
            let weights = curve.weights.as_ref().map_or(0, Vec::len);
            size_of::<WrittenCurve>()
                + (curve.knots.len() + weights) * size_of::<f64>()
                + curve.points_m.len() * size_of::<Point<f64>>()
        };
        self.0.values().map(bytes).sum()
    }
}
