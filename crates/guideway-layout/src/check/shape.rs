//! Shape of single paths: gaps between runs, kinks, tight bends, and paths without length.

use guideway_spline::{Point, uniform};

use super::cubic::{Cubic, greatest_curvature};
use super::element::{DisplayPosition, element_place};
use super::options::CheckOptions;
use super::scale::Tolerances;
use super::turns_in_place::turns_in_place;
use super::worst::Worst;
use crate::{Code, Diagnostics, Layout, Member, PathRef, RunPoints, Severity};

/// Relative tolerance of the radius: rounding may push an arc of exactly the limit below it.
const RADIUS_SLACK: f64 = 1e-6;

/// Reports the worst gap, kink and bend of each path, and paths without length; and the share of
/// the paths that are done.
pub(super) fn check(
    layout: &Layout,
    options: &CheckOptions,
    tolerances: &Tolerances,
    done: &dyn Fn(f64),
    found: &mut Diagnostics,
) {
    /// Paths between two messages of progress.
    const STEP: usize = 4096;
    for path in layout.paths.iter() {
        if path.row().is_multiple_of(STEP) {
            done(path.row() as f64 / layout.paths.len() as f64);
        }
        match path.hull_bounds() {
            None => {}
            Some(hull) if hull.size().x.max(hull.size().y) <= tolerances.dot_m => {
                zero_length(layout, path, found);
            }
            Some(_) => Shape::of(path, options, tolerances.gap_m).report(layout, path, found),
        }
    }
}

/// The worst defect of each kind on one path.
#[derive(Default)]
struct Shape {
    gap_m: Option<Worst>,
    kink_rad: Option<Worst>,
    curvature: Option<Worst>,
}

impl Shape {
    fn of(path: PathRef<'_>, options: &CheckOptions, gap_m: f64) -> Self {
        let mut shape = Self::default();
        let mut previous = Previous::default();
        for run in path.runs() {
            let rounding = rounding(run);
            for segment in run.segments() {
                let cubic = Cubic::new(&segment, rounding);
                shape.add_join(&mut previous, &cubic, options, gap_m);
                for parts in cubic.parts_at_stops(rounding) {
                    shape.add_turn(
                        (parts[0].end_direction(), parts[1].start_direction()),
                        parts[1].points[0],
                        options,
                    );
                }
                if let Some(radius_m) = options.min_radius_m {
                    shape.add_bend(&segment, rounding, radius_m);
                }
            }
        }
        shape
    }

    /// Compares the start of a segment with the end of the previous one.
    fn add_join(
        &mut self,
        previous: &mut Previous,
        cubic: &Cubic,
        options: &CheckOptions,
        tolerance_m: f64,
    ) {
        let start = cubic.points[0];
        if let Some(end) = previous.end {
            let gap_m = end.distance(start);
            if gap_m > tolerance_m {
                Worst::add(&mut self.gap_m, gap_m, end);
                previous.direction = None;
            }
        }
        let directions = (previous.direction, cubic.start_direction());
        self.add_turn(directions, start, options);
        previous.end = Some(cubic.points[3]);
        // A segment without length has no direction, so the previous direction stays in force.
        previous.direction = cubic.end_direction().or(previous.direction);
    }

    fn add_turn(
        &mut self,
        directions: (Option<Point<f64>>, Option<Point<f64>>),
        at: Point<f64>,
        options: &CheckOptions,
    ) {
        let (Some(from), Some(to)) = directions else {
            return;
        };
        let angle_rad = from.cross(to).abs().atan2(from.dot(to));
        if angle_rad > options.kink_angle_rad {
            Worst::add(&mut self.kink_rad, angle_rad, at);
        }
    }

    fn add_bend(&mut self, segment: &[Point<f64>; 4], rounding: f64, least_radius_m: f64) {
        let (curvature, at) = greatest_curvature(segment, rounding);
        if curvature * least_radius_m > 1.0 + RADIUS_SLACK {
            Worst::add(&mut self.curvature, curvature, at);
        }
    }

    fn report(&self, layout: &Layout, path: PathRef<'_>, found: &mut Diagnostics) {
        let place = || element_place(Member::Path(path.row() as u32), path.id());
        let is_drawn = path.start_node().is_none() && path.end_node().is_none();
        let severity = |code: Code, is_right: bool| match is_right {
            true => Severity::Info,
            false => code.severity(),
        };
        if let Some(worst) = self.gap_m {
            // A shape of a drawing may have several parts.
            let is_shape = matches!(layout.provenance.format.as_str(), "DXF" | "SVG");
            found.push_as(
                severity(Code::BrokenPath, is_drawn && is_shape),
                Code::BrokenPath,
                place,
                || {
                    let (gap_m, at) = (worst.value, DisplayPosition(worst.at));
                    format!("gap of {gap_m:.3} m at {at}{}", worst.others())
                },
                "Close the gap, or split the path in two",
            );
        }
        if let Some(worst) = self.kink_rad.filter(|_| layout.paths.is_driven(path.row())) {
            // Lines of a drawing are for no vehicle yet.
            found.push_as(
                severity(Code::Kink, is_drawn),
                Code::Kink,
                place,
                || {
                    let (degrees, at) = (worst.value.to_degrees(), DisplayPosition(worst.at));
                    let others = worst.others();
                    format!("the direction jumps by {degrees:.1} degrees at {at}{others}")
                },
                "Round the corner; no action needed if the vehicle stops and turns there",
            );
        }
        if let Some(worst) = self.curvature {
            found.push(
                Code::Curvature,
                place,
                || {
                    let (radius_m, at) = (1.0 / worst.value, DisplayPosition(worst.at));
                    format!("the radius is {radius_m:.3} m at {at}{}", worst.others())
                },
                "Widen the bend, or check with a smaller radius",
            );
        }
    }
}

/// End of the previous segment.
#[derive(Default)]
struct Previous {
    end: Option<Point<f64>>,
    direction: Option<Point<f64>>,
}

fn zero_length(layout: &Layout, path: PathRef<'_>, found: &mut Diagnostics) {
    if turns_in_place(layout, path) {
        return;
    }
    let remedy = match (path.start_node(), path.end_node()) {
        (Some(_), Some(_)) => {
            "Give its nodes different positions; if the vehicle turns there, state its orientations"
        }
        _ => "Remove the path, or give its ends different positions",
    };
    found.push(
        Code::ZeroLength,
        || element_place(Member::Path(path.row() as u32), path.id()),
        || {
            let at = path.runs().flat_map(|run| run.segments()).next();
            let at = at.map_or_else(Point::default, |segment| uniform::start(&segment));
            format!("the whole path is at {}", DisplayPosition(at))
        },
        remedy,
    );
}

/// Relative error of coordinates after a few operations in their stored precision.
fn rounding(run: RunPoints<'_>) -> f64 {
    match run {
        RunPoints::F64(_) => 32.0 * f64::EPSILON,
        RunPoints::F32(_) => 8.0 * f64::from(f32::EPSILON),
    }
}
