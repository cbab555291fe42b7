//! Shapes of paths in openTCS: curves of any format in, connection type and control points out.

use guideway_layout::{PathRef, RunPoints};
use guideway_spline::{Point, flatten_run, uniform};

use super::fit_cubic::fit_cubic;
use crate::clamped::{JOIN_TOLERANCE_M, POSITION_STEP_M, is_straight};

/// Largest distance of a drawn curve from that of the layout, in meters, where openTCS cannot draw
/// the same one. Derived: a fifth of the unit in which the editor places control points.
pub(super) const CURVE_TOLERANCE_M: f64 = 0.01;

/// Points per segment through which a curve is fitted.
const SAMPLES_PER_SEGMENT: u32 = 8;

/// Segments of a curve that may still be two cubic curves; longer ones are not tried, for time.
const MAX_FITTED_SEGMENTS: usize = 64;

/// Shares of a curve at which it is split in two, in the order in which they are tried.
const SPLITS: [f64; 5] = [0.5, 1.0 / 3.0, 2.0 / 3.0, 0.25, 0.75];

pub(super) type Bezier = [Point<f64>; 4];

/// The ways in which openTCS draws a path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Connection {
    /// A straight line.
    Direct,
    /// A line with bends that the file does not store.
    Elbow,
    /// The same.
    Slanted,
    /// Straight lines through the control points.
    Polypath,
    /// A cubic curve with two control points.
    Bezier,
    /// Two cubic curves, with two control points each and the point where they meet.
    Bezier3,
}

impl Connection {
    const ALL: [Self; 6] = [
        Self::Direct,
        Self::Elbow,
        Self::Slanted,
        Self::Polypath,
        Self::Bezier,
        Self::Bezier3,
    ];

    /// Name in a file.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Direct => "DIRECT",
            Self::Elbow => "ELBOW",
            Self::Slanted => "SLANTED",
            Self::Polypath => "POLYPATH",
            Self::Bezier => "BEZIER",
            Self::Bezier3 => "BEZIER_3",
        }
    }

    fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.name() == name)
    }

    /// The connection type that a curve has unless a file states another one; `None` for a curve
    /// that openTCS cannot draw exactly.
    pub(super) fn of_curve(beziers: &[Bezier]) -> Option<Self> {
        if has_gap(beziers) {
            return None;
        }
        let is_straight = are_straight(beziers);
        match beziers.len() {
            1 if is_straight => Some(Self::Direct),
            _ if is_straight => Some(Self::Polypath),
            1 => Some(Self::Bezier),
            2 => Some(Self::Bezier3),
            _ => None,
        }
    }

    /// Tells if a path of this type can have a curve.
    fn can_draw(self, beziers: &[Bezier]) -> bool {
        let is_straight = || are_straight(beziers);
        !has_gap(beziers)
            && match self {
                Self::Direct | Self::Elbow | Self::Slanted => beziers.len() == 1 && is_straight(),
                Self::Polypath => is_straight(),
                Self::Bezier => beziers.len() == 1,
                Self::Bezier3 => beziers.len() == 2,
            }
    }
}

impl Connection {
    /// The curve of this type between two points.
    pub(super) fn beziers(
        self,
        control: &[Point<f64>],
        [start, end]: [Point<f64>; 2],
    ) -> Vec<Bezier> {
        match (self, control) {
            (Self::Bezier, &[a, b]) => vec![[start, a, b, end]],
            (Self::Bezier3, &[a, b, middle, c, d]) => {
                vec![[start, a, b, middle], [middle, c, d, end]]
            }
            (_, control) => {
                let corners = [start].into_iter().chain(control.iter().copied());
                let corners: Vec<_> = corners.chain([end]).collect();
                let line =
                    |&[a, b]: &[Point<f64>; 2]| [a, a.lerp(b, 1.0 / 3.0), a.lerp(b, 2.0 / 3.0), b];
                corners.array_windows().map(line).collect()
            }
        }
    }
}

/// The cubic curves of a path.
pub(super) fn beziers_of(path: PathRef<'_>) -> Vec<Bezier> {
    let segments = path.runs().flat_map(RunPoints::segments);
    segments.map(|s| uniform::to_bezier(&s)).collect()
}

/// Tells if a curve is a chain of straight lines.
pub(super) fn are_straight(beziers: &[Bezier]) -> bool {
    beziers.iter().all(|b| is_straight(b, POSITION_STEP_M))
}

fn has_gap(beziers: &[Bezier]) -> bool {
    let is_gap = |pair: &[Bezier; 2]| pair[0][3].distance(pair[1][0]) > JOIN_TOLERANCE_M;
    beziers.array_windows().any(is_gap)
}

/// A path as openTCS draws it, between its end points.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Shape {
    pub(super) connection: Connection,
    /// Control points in meters, in the order of the file.
    pub(super) control: Vec<Point<f64>>,
    /// Upper bound of the distance from the curve of the layout, in meters.
    pub(super) error_m: f64,
}

impl Shape {
    /// The shape of a path: of the stated connection type if that can draw its curve, else of the
    /// type that draws it exactly, else the simplest one within [`CURVE_TOLERANCE_M`].
    pub(super) fn of_path(path: PathRef<'_>, beziers: &[Bezier], stated: Option<&str>) -> Self {
        let stated = stated.and_then(Connection::named);
        let stated = stated.filter(|connection| connection.can_draw(beziers));
        match stated.or_else(|| Connection::of_curve(beziers)) {
            Some(connection) => Self::exact(connection, beziers),
            None => Self::fitted(beziers).unwrap_or_else(|| Self::flattened(path)),
        }
    }

    fn exact(connection: Connection, beziers: &[Bezier]) -> Self {
        let control = match connection {
            Connection::Direct | Connection::Elbow | Connection::Slanted => Vec::new(),
            Connection::Polypath => beziers.iter().skip(1).map(|b| b[0]).collect(),
            Connection::Bezier | Connection::Bezier3 => {
                let control = beziers.iter().flat_map(|b| [b[1], b[2], b[3]]);
                control.take(3 * beziers.len() - 1).collect()
            }
        };
        Self {
            connection,
            control,
            error_m: 0.0,
        }
    }

    /// One or two cubic curves near a curve without gaps.
    fn fitted(beziers: &[Bezier]) -> Option<Self> {
        if beziers.len() > MAX_FITTED_SEGMENTS || has_gap(beziers) {
            return None;
        }
        let samples = samples(beziers);
        if let Some((one, error_m)) = fit_cubic(&samples, CURVE_TOLERANCE_M) {
            let shape = Self::exact(Connection::Bezier, &[one]);
            return Some(Self { error_m, ..shape });
        }
        SPLITS.into_iter().find_map(|share| {
            let middle = (samples.len() as f64 * share) as usize;
            let (first, first_m) = fit_cubic(samples.get(..=middle)?, CURVE_TOLERANCE_M)?;
            let (second, second_m) = fit_cubic(samples.get(middle..)?, CURVE_TOLERANCE_M)?;
            let shape = Self::exact(Connection::Bezier3, &[first, second]);
            let error_m = first_m.max(second_m);
            Some(Self { error_m, ..shape })
        })
    }

    /// Straight lines near a curve, across its gaps.
    fn flattened(path: PathRef<'_>) -> Self {
        let mut points = Vec::new();
        for run in path.runs() {
            let run: Vec<_> = run.iter().collect();
            flatten_run(&run, CURVE_TOLERANCE_M, &mut |p| {
                if points.last() != Some(&p) {
                    points.push(p);
                }
            });
        }
        points.pop();
        Self {
            connection: Connection::Polypath,
            control: points.into_iter().skip(1).collect(),
            error_m: CURVE_TOLERANCE_M,
        }
    }
}

/// Points on a curve, in order, with its ends.
fn samples(beziers: &[Bezier]) -> Vec<Point<f64>> {
    let steps = f64::from(SAMPLES_PER_SEGMENT);
    let on = |b: &Bezier| {
        let segment = uniform::from_bezier(b);
        (1..=SAMPLES_PER_SEGMENT).map(move |i| uniform::point(&segment, f64::from(i) / steps))
    };
    let start = beziers.iter().take(1).map(|b| b[0]);
    start.chain(beziers.iter().flat_map(on)).collect()
}

#[cfg(test)]
mod tests {
    use guideway_layout::{Layout, NewPath};
    use guideway_spline::{Runs, arc_to_runs};

    use super::*;

    fn shape_of(runs: &Runs, stated: Option<&str>) -> Shape {
        let mut layout = Layout::default();
        layout.paths.push(&NewPath {
            runs,
            ..NewPath::default()
        });
        let path = layout.paths.get(0);
        Shape::of_path(path, &beziers_of(path), stated)
    }

    fn line(points: &[(f64, f64)]) -> Runs {
        let points: Vec<_> = points.iter().map(|&(x, y)| Point::new(x, y)).collect();
        let mut runs = Runs::default();
        guideway_spline::polyline_to_runs(&points, &mut runs);
        runs
    }

    #[test]
    fn exact_shapes_keep_their_control_points() {
        let direct = shape_of(&line(&[(0.0, 0.0), (4.0, 1.0)]), None);
        assert_eq!(
            (direct.connection, direct.control.len()),
            (Connection::Direct, 0)
        );
        let corner = line(&[(0.0, 0.0), (4.0, 1.0), (4.0, 9.0)]);
        let corner = shape_of(&corner, None);
        assert_eq!(corner.connection, Connection::Polypath);
        assert!(corner.control[0].distance(Point::new(4.0, 1.0)) < 1e-9);
        let mut runs = Runs::default();
        let handles = [(0.0, 0.0), (3.0, 0.0), (4.0, 1.0), (4.0, 4.0)];
        runs.push_bezier(&handles.map(|(x, y)| Point::new(x, y)));
        let bezier = shape_of(&runs, None);
        assert_eq!(bezier.connection, Connection::Bezier);
        assert!(bezier.control[1].distance(Point::new(4.0, 1.0)) < 1e-9);
    }

    #[test]
    fn stated_types_hold_only_while_they_can_draw_the_curve() {
        let straight = line(&[(0.0, 0.0), (4.0, 1.0)]);
        let bent = line(&[(0.0, 0.0), (4.0, 1.0), (4.0, 9.0)]);
        for (runs, stated, expected) in [
            (&straight, "ELBOW", Connection::Elbow),
            (&straight, "BEZIER", Connection::Bezier),
            (&bent, "ELBOW", Connection::Polypath),
            (&bent, "SPIRAL", Connection::Polypath),
        ] {
            assert_eq!(
                shape_of(runs, Some(stated)).connection,
                expected,
                "{stated}"
            );
        }
    }

    #[test]
    fn other_curves_are_drawn_within_the_tolerance() {
        let arc = |angle: f64| {
            let mut runs = Runs::default();
            let center = Point::new(10.0, -5.0);
            arc_to_runs(center, 3.0, 0.0, angle, 1e-7, &mut runs);
            runs
        };
        for (runs, expected) in [
            (arc(1.57), Connection::Bezier),
            (arc(3.1), Connection::Bezier3),
            (arc(6.2), Connection::Polypath),
        ] {
            let shape = shape_of(&runs, None);
            assert_eq!(shape.connection, expected);
            assert!(shape.error_m > 0.0 && shape.error_m <= CURVE_TOLERANCE_M);
            let off = |p: &Point<f64>| p.distance(Point::new(10.0, -5.0)) - 3.0;
            let is_on_arc = |p: &Point<f64>| off(p).abs() <= CURVE_TOLERANCE_M;
            match expected {
                // The middle of two curves and the corners of lines lie on the arc.
                Connection::Bezier3 => assert!(is_on_arc(&shape.control[2])),
                Connection::Polypath => assert!(shape.control.iter().all(is_on_arc)),
                _ => assert!(shape.control.iter().all(|p| off(p) > 0.0)),
            }
        }
    }
}
