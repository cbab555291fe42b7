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

impl WrittenCurve {
    /// The curve under an affine map: that of its control points, because NURBS are invariant.
    #[must_use]
    pub fn mapped(&self, by: Affine) -> Self {
        Self {
            degree: self.degree,
            knots: self.knots.clone(),
            points_m: self.points_m.iter().map(|p| by.apply(*p)).collect(),
            weights: self.weights.clone(),
        }
    }

    /// Heap bytes in use, with those of the curve itself.
    pub fn heap_bytes(&self) -> usize {
        let weights = self.weights.as_ref().map_or(0, Vec::len);
        size_of::<Self>()
            + (self.knots.len() + weights) * size_of::<f64>()
            + self.points_m.len() * size_of::<Point<f64>>()
    }

    /// The same curve from its end to its start.
    #[must_use]
    pub fn reversed(&self) -> Self {
        let ends = self.knots.first().zip(self.knots.last());
        let sum = ends.map_or(0.0, |(first, last)| first + last);
        let backward = |numbers: &Vec<f64>| numbers.iter().rev().copied().collect();
        Self {
            degree: self.degree,
            knots: self.knots.iter().rev().map(|knot| sum - knot).collect(),
            points_m: self.points_m.iter().rev().copied().collect(),
            weights: self.weights.as_ref().map(backward),
        }
    }
}

/// The written curves of some paths. The runs of a path without one are its whole curve.
///
/// A reader adds a curve where the runs only approximate it, or need more points than the file had.
/// An edit of the runs replaces or removes it; an affine map, under which NURBS are invariant, maps
/// it too.
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

    /// The paths with a written curve, in increasing order, and their curves.
    pub fn iter(&self) -> impl Iterator<Item = (usize, &WrittenCurve)> {
        let curves = self.0.iter();
        curves.map(|(&path, curve)| (path as usize, curve.as_ref()))
    }

    /// Sets or removes the written curve of a path.
    pub fn set(&mut self, path: usize, curve: Option<Arc<WrittenCurve>>) {
        match curve {
            Some(curve) => drop(self.0.insert(path as u32, curve)),
            None => drop(self.0.remove(&(path as u32))),
        }
    }

    /// The written curve of a path, shared.
    pub fn shared(&self, path: usize) -> Option<Arc<WrittenCurve>> {
        self.0.get(&(path as u32)).cloned()
    }

    pub(crate) fn transform(&mut self, path: usize, by: Affine) {
        if let Some(curve) = self.0.get_mut(&(path as u32)) {
            let points_m = &mut Arc::make_mut(curve).points_m;
            points_m.iter_mut().for_each(|p| *p = by.apply(*p));
        }
    }

    /// The curves of the given paths, in this order.
    #[must_use]
    pub fn select(&self, paths: &[usize]) -> Self {
        if self.0.is_empty() {
            return Self::default();
        }
        let curves = paths.iter().enumerate();
        let curve = |(row, &path): (usize, &usize)| Some((row as u32, self.shared(path)?));
        Self(curves.filter_map(curve).collect())
    }

    /// Heap bytes in use.
    pub fn heap_bytes(&self) -> usize {
        self.0.values().map(|curve| curve.heap_bytes()).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_reversed_curve_has_its_knots_from_the_other_end() {
        let points_m: Vec<_> = (0..3).map(|x| Point::new(f64::from(x), 0.0)).collect();
        let curve = WrittenCurve {
            degree: 1,
            knots: vec![1.0, 1.0, 2.0, 5.0, 5.0],
            points_m: points_m.clone(),
            weights: Some(vec![1.0, 2.0, 3.0]),
        };
        let reversed = curve.reversed();
        assert_eq!(reversed.knots, [1.0, 1.0, 4.0, 5.0, 5.0]);
        assert_eq!(reversed.weights, Some(vec![3.0, 2.0, 1.0]));
        assert_eq!(reversed.points_m[0], points_m[2]);
        assert_eq!(reversed.reversed(), curve);
    }
}
