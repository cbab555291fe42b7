//! The area that a body sweeps along a path, as a hierarchy of convex polygons.

use guideway_layout::{PathRef, RunPoints};
use guideway_spline::{Bounds, Point, uniform};

use crate::curve_piece::{CurvePiece, SweepElement};
use crate::hull::Hull;
use crate::path_follower::PathFollower;
use crate::{Body, ConvexPolygon, Heading};

/// The area that a body sweeps along a path.
///
/// It stores curve pieces, not polygons. Polygons are computed on demand, to the requested
/// tolerance and within the requested box.
#[derive(Clone, Debug)]
pub struct Sweep {
    pub(crate) body: Body,
    pub(crate) elements: Vec<SweepElement>,
    reach_m: f64,
}

/// Finest cut of a given area, as a fraction of its reach. Without this bound, overlapping areas
/// would be cut into far too many parts.
const FINEST_CUT: f64 = 1.0 / 16.0;

/// Smallest tolerance of polygons, in meters.
pub const MIN_TOLERANCE_M: f64 = 1e-4;

impl Sweep {
    /// The area swept along a path at one or more headings. `None` if the path is shorter than 0.01
    /// mm and all headings are tangential, because it has no direction.
    ///
    /// At a cusp the vehicle reverses without turning. At a kink it pivots by the smaller angle.
    /// Gaps between parts of the path are not swept.
    pub fn new(path: PathRef<'_>, body: Body, headings: &[Heading]) -> Option<Self> {
        let mut pieces = Vec::new();
        for &heading in headings {
            let mut follower = PathFollower::new(heading, &mut pieces);
            for run in path.runs() {
                let rounding = match run {
                    RunPoints::F64(_) => 0.0,
                    RunPoints::F32(_) => 16.0 * f64::from(f32::EPSILON),
                };
                for segment in run.segments() {
                    follower.segment(&uniform::to_bezier(&segment), rounding);
                }
            }
            follower.end();
        }
        let elements: Vec<SweepElement> = pieces.into_iter().map(SweepElement::Moving).collect();
        (!elements.is_empty()).then_some(Self {
            body,
            elements,
            reach_m: body.reach_m(),
        })
    }

    /// A given area of convex parts that reaches `reach_m` from the path; `None` without parts.
    pub fn of_areas(areas: impl IntoIterator<Item = ConvexPolygon>, reach_m: f64) -> Option<Self> {
        let elements: Vec<SweepElement> = areas.into_iter().map(SweepElement::Area).collect();
        (!elements.is_empty()).then_some(Self {
            body: Body::vehicle(0.0, 0.0, 0.0),
            elements,
            reach_m,
        })
    }

    /// Largest distance of the area from the reference point or the path, in meters.
    pub fn reach_m(&self) -> f64 {
        self.reach_m
    }

    /// Extent below which parts are not cut further to locate them, in meters.
    pub(crate) fn finest_m(&self, tolerance_m: f64) -> f64 {
        match self.elements[0] {
            SweepElement::Moving(_) => tolerance_m,
            SweepElement::Area(_) => tolerance_m.max(FINEST_CUT * self.reach_m),
        }
    }

    /// A box that contains the area; not always the smallest.
    pub fn bounds(&self) -> Bounds<f64> {
        SweepPart::whole(self).hull.bounds
    }

    /// Visits convex polygons that cover the area inside a box, or all of it. Except for rounding,
    /// each point of the polygons is within `tolerance_m` of the area; the tolerance is at least
    /// [`MIN_TOLERANCE_M`].
    ///
    /// Cost: about (turning angle) * (reach of the body) / tolerance polygons per path; one polygon
    /// per straight segment.
    pub fn polygons(
        &self,
        tolerance_m: f64,
        within: Option<Bounds<f64>>,
        visit: &mut impl FnMut(&ConvexPolygon),
    ) {
        let tolerance_m = tolerance_m.max(MIN_TOLERANCE_M);
        let mut open = vec![SweepPart::whole(self)];
        while let Some(stretch) = open.pop() {
            let hull = &stretch.hull;
            if within.is_some_and(|within| !within.intersects(hull.bounds)) {
                continue;
            }
            if hull.error_m <= tolerance_m {
                visit(&hull.outer);
            } else {
                let [first, second] = stretch.halves(self);
                open.extend([second, first]);
            }
        }
    }
}

/// A part of a sweep with its hull: a node of the hierarchy.
#[derive(Clone, Debug)]
pub(crate) struct SweepPart {
    extent: Extent,
    pub(crate) hull: Hull,
}

#[derive(Clone, Debug)]
enum Extent {
    /// A range of elements.
    Elements(usize, usize),
    /// One curve piece, or a part of it.
    Piece(CurvePiece),
    /// A given area, or a part of it.
    Area,
}

impl SweepPart {
    /// The root of the hierarchy.
    pub(crate) fn whole(sweep: &Sweep) -> Self {
        Self::of_elements(sweep, 0, sweep.elements.len())
    }

    fn of_elements(sweep: &Sweep, from: usize, to: usize) -> Self {
        let (mut pieces, mut areas): (Vec<CurvePiece>, Vec<&ConvexPolygon>) =
            (Vec::new(), Vec::new());
        for element in &sweep.elements[from..to] {
            match element {
                SweepElement::Moving(piece) => pieces.push(*piece),
                SweepElement::Area(area) => areas.push(area),
            }
        }
        let hull = Hull::of_pieces(&sweep.body, &pieces).or_else(|| Hull::of_areas(&areas));
        let extent = match (pieces.as_slice(), areas.as_slice()) {
            ([piece], []) => Extent::Piece(*piece),
            ([], [_]) => Extent::Area,
            _ => Extent::Elements(from, to),
        };
        Self {
            extent,
            hull: hull.expect("a sweep has elements, all of one kind"),
        }
    }

    fn of_piece(sweep: &Sweep, piece: CurvePiece) -> Self {
        let hull = Hull::of_pieces(&sweep.body, &[piece]);
        Self {
            extent: Extent::Piece(piece),
            hull: hull.expect("there is a piece"),
        }
    }

    /// Its two children in the hierarchy.
    pub(crate) fn halves(&self, sweep: &Sweep) -> [Self; 2] {
        let piece = match self.extent {
            Extent::Elements(from, to) => {
                let middle = from.midpoint(to);
                return [(from, middle), (middle, to)]
                    .map(|(from, to)| Self::of_elements(sweep, from, to));
            }
            Extent::Piece(piece) => piece,
            Extent::Area => {
                let halves = self.hull.outer.halves();
                return halves.map(|half| Self {
                    extent: Extent::Area,
                    hull: Hull::of_area(half),
                });
            }
        };
        let halves = piece.halves(&sweep.body);
        halves.map(|half| Self::of_piece(sweep, half))
    }

    /// Diagonal of the bounds of the reference point, in meters.
    pub(crate) fn extent_m(&self) -> f64 {
        self.hull.reference_bounds.size().norm()
    }

    /// Center of the bounds of the reference point.
    pub(crate) fn position(&self) -> Point<f64> {
        self.hull.reference_bounds.center()
    }
}
