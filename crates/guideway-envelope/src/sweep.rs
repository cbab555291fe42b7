use guideway_layout::{PathRef, RunPoints};
use guideway_spline::{Bounds, Point, uniform};

use crate::follow::Follow;
use crate::step::{Drive, Hull, Step};
use crate::{Body, ConvexPolygon, Heading};

/// The area that a body sweeps along a path.
///
/// It is held as pieces of the curve, not as an area: convex polygons come out of it as finely as they are
/// asked for, where they are asked for.
#[derive(Clone, Debug)]
pub struct Sweep {
    pub(crate) body: Body,
    pub(crate) steps: Vec<Step>,
    reach_m: f64,
}

/// An area that is given is not cut finer than this share of its reach: of areas that overlap, parts beyond counting
/// would.
const FINEST_CUT: f64 = 1.0 / 16.0;

/// Least tolerance of polygons.
pub const MIN_TOLERANCE_M: f64 = 1e-4;

impl Sweep {
    /// The area swept along a path at any one of some headings; none if the path has no direction that a heading
    /// could follow, for it is shorter than a hundredth of a millimeter.
    ///
    /// At a cusp the vehicle goes on the other way, without turning. At a kink it turns on the spot, by the smaller
    /// angle. Nothing is swept between parts that do not meet.
    pub fn new(path: PathRef<'_>, body: Body, headings: &[Heading]) -> Option<Self> {
        let mut steps = Vec::new();
        for &heading in headings {
            let mut follow = Follow::new(heading, &mut steps);
            for run in path.runs() {
                let rounding = match run {
                    RunPoints::F64(_) => 0.0,
                    RunPoints::F32(_) => 16.0 * f64::from(f32::EPSILON),
                };
                for segment in run.segments() {
                    follow.segment(&uniform::to_bezier(&segment), rounding);
                }
            }
            follow.end();
        }
        let steps: Vec<Step> = steps.into_iter().map(Step::Drive).collect();
        (!steps.is_empty()).then_some(Self {
            body,
            steps,
            reach_m: body.reach_m(),
        })
    }

    /// An area that is known, as convex parts, and how far it reaches from the path; none if there are no parts.
    pub fn of_areas(areas: impl IntoIterator<Item = ConvexPolygon>, reach_m: f64) -> Option<Self> {
        let steps: Vec<Step> = areas.into_iter().map(Step::Still).collect();
        (!steps.is_empty()).then_some(Self {
            body: Body::vehicle(0.0, 0.0, 0.0),
            steps,
            reach_m,
        })
    }

    /// How far it reaches from the path, or from the reference point of a body.
    pub fn reach_m(&self) -> f64 {
        self.reach_m
    }

    /// The extent below which stretches are not told apart by where they are, if a question may be answered so closely.
    pub(crate) fn finest_m(&self, tolerance_m: f64) -> f64 {
        match self.steps[0] {
            Step::Drive(_) => tolerance_m,
            Step::Still(_) => tolerance_m.max(FINEST_CUT * self.reach_m),
        }
    }

    /// A box that holds all of it.
    pub fn bounds(&self) -> Bounds<f64> {
        Stretch::whole(self).hull.bounds
    }

    /// ConvexPolygon polygons that hold what of the area lies within a box (all, without one): no point of them is farther
    /// than `tolerance_m` from the area, apart from rounding. A tolerance below [`MIN_TOLERANCE_M`] is raised to
    /// it.
    ///
    /// The error of a polygon grows with the angle that the vehicle turns by in it: its number for a path is about
    /// that angle times the reach of the body over the tolerance. Straight stretches are one each.
    pub fn polygons(
        &self,
        tolerance_m: f64,
        within: Option<Bounds<f64>>,
        visit: &mut impl FnMut(&ConvexPolygon),
    ) {
        let tolerance_m = tolerance_m.max(MIN_TOLERANCE_M);
        let mut open = vec![Stretch::whole(self)];
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

/// A stretch of a sweep.
#[derive(Clone, Debug)]
pub(crate) struct Stretch {
    extent: Extent,
    pub(crate) hull: Hull,
}

#[derive(Clone, Debug)]
enum Extent {
    /// Several whole steps.
    Steps(usize, usize),
    /// One, or a piece of it.
    Piece(Drive),
    /// An area that is given, or a part of it.
    Area,
}

impl Stretch {
    pub(crate) fn whole(sweep: &Sweep) -> Self {
        Self::of_steps(sweep, 0, sweep.steps.len())
    }

    fn of_steps(sweep: &Sweep, from: usize, to: usize) -> Self {
        let (mut drives, mut areas): (Vec<Drive>, Vec<&ConvexPolygon>) = (Vec::new(), Vec::new());
        for step in &sweep.steps[from..to] {
            match step {
                Step::Drive(drive) => drives.push(*drive),
                Step::Still(area) => areas.push(area),
            }
        }
        let hull = Hull::of_drives(&sweep.body, &drives).or_else(|| Hull::of_areas(&areas));
        let extent = match (drives.as_slice(), areas.as_slice()) {
            ([drive], []) => Extent::Piece(*drive),
            ([], [_]) => Extent::Area,
            _ => Extent::Steps(from, to),
        };
        Self {
            extent,
            hull: hull.expect("a sweep has steps, of one kind"),
        }
    }

    fn of_piece(sweep: &Sweep, piece: Drive) -> Self {
        let hull = Hull::of_drives(&sweep.body, &[piece]);
        Self {
            extent: Extent::Piece(piece),
            hull: hull.expect("there is a drive"),
        }
    }

    /// Its two halves.
    pub(crate) fn halves(&self, sweep: &Sweep) -> [Self; 2] {
        let piece = match self.extent {
            Extent::Steps(from, to) => {
                let middle = from.midpoint(to);
                return [(from, middle), (middle, to)]
                    .map(|(from, to)| Self::of_steps(sweep, from, to));
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

    /// The diagonal of the box of its places.
    pub(crate) fn extent_m(&self) -> f64 {
        self.hull.places.size().norm()
    }

    /// The middle of its places.
    pub(crate) fn place(&self) -> Point<f64> {
        self.hull.places.center()
    }
}
