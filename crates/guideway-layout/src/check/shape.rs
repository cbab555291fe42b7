use guideway_spline::{Point, uniform};

use super::CheckOptions;
use super::cubic::{Cubic, greatest_curvature};
use super::place::{At, place};
use super::worst::Worst;
use crate::{Code, Diagnostics, Layout, PathRef, RunPoints};

/// A path whose control points all lie in a box of this size is a dot.
const DOT_M: f64 = 1e-9;

/// Runs that end at a radius of exactly the limit may come out below it by rounding.
const RADIUS_SLACK: f64 = 1e-6;

/// What the curve of each path looks like.
pub(super) fn check(layout: &Layout, options: &CheckOptions, found: &mut Diagnostics) {
    for path in layout.paths.iter() {
        match path.hull_bounds() {
            None => {}
            Some(hull) if hull.size().x.max(hull.size().y) <= DOT_M => zero_length(path, found),
            Some(_) => Shape::of(path, options).report(path, found),
        }
    }
}

/// The worst of each kind on one path.
#[derive(Default)]
struct Shape {
    gap_m: Option<Worst>,
    kink_rad: Option<Worst>,
    curvature: Option<Worst>,
}

impl Shape {
    fn of(path: PathRef<'_>, options: &CheckOptions) -> Self {
        let mut shape = Self::default();
        let mut before = Before::default();
        for run in path.runs() {
            let rounding = rounding(run);
            for segment in run.segments() {
                let cubic = Cubic::new(&segment, rounding);
                shape.join(&mut before, &cubic, options);
                for parts in cubic.parts_at_stops(rounding) {
                    shape.turn(
                        (parts[0].end_direction(), parts[1].start_direction()),
                        parts[1].points[0],
                        options,
                    );
                }
                if let Some(radius_m) = options.min_radius_m {
                    shape.bend(&segment, rounding, radius_m);
                }
            }
        }
        shape
    }

    /// Compares the beginning of a segment with what came before it.
    fn join(&mut self, before: &mut Before, cubic: &Cubic, options: &CheckOptions) {
        let start = cubic.points[0];
        if let Some(end) = before.end {
            let gap_m = end.distance(start);
            if gap_m > options.gap_tolerance_m {
                Worst::add(&mut self.gap_m, gap_m, end);
                before.direction = None;
            }
        }
        self.turn((before.direction, cubic.start_direction()), start, options);
        before.end = Some(cubic.points[3]);
        // A segment of no length has no direction: that of the one before holds.
        before.direction = cubic.end_direction().or(before.direction);
    }

    fn turn(
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

    fn bend(&mut self, segment: &[Point<f64>; 4], rounding: f64, least_radius_m: f64) {
        let (curvature, at) = greatest_curvature(segment, rounding);
        if curvature * least_radius_m > 1.0 + RADIUS_SLACK {
            Worst::add(&mut self.curvature, curvature, at);
        }
    }

    fn report(&self, path: PathRef<'_>, found: &mut Diagnostics) {
        let place = || place("path", path.row(), path.id());
        if let Some(worst) = self.gap_m {
            found.push(
                Code::BrokenPath,
                place,
                || {
                    format!(
                        "gap of {:.3} m at {}{}",
                        worst.value,
                        At(worst.at),
                        worst.others()
                    )
                },
                "Let each part begin where the last one ends, or make them paths of their own",
            );
        }
        if let Some(worst) = self.kink_rad {
            found.push(
                Code::Kink,
                place,
                || {
                    let (degrees, at) = (worst.value.to_degrees(), At(worst.at));
                    let others = worst.others();
                    format!("the direction jumps by {degrees:.1} degrees at {at}{others}")
                },
                "Round the corner; nothing, if the vehicle stops and turns there",
            );
        }
        if let Some(worst) = self.curvature {
            found.push(
                Code::Curvature,
                place,
                || {
                    let (radius_m, at) = (1.0 / worst.value, At(worst.at));
                    format!("the radius is {radius_m:.3} m at {at}{}", worst.others())
                },
                "Widen the bend, or check another least radius",
            );
        }
    }
}

/// Where the curve has got to.
#[derive(Default)]
struct Before {
    end: Option<Point<f64>>,
    direction: Option<Point<f64>>,
}

fn zero_length(path: PathRef<'_>, found: &mut Diagnostics) {
    found.push(
        Code::ZeroLength,
        || place("path", path.row(), path.id()),
        || {
            let at = path.runs().flat_map(|run| run.segments()).next();
            let at = at.map_or_else(Point::default, |segment| uniform::start(&segment));
            format!("all of it is at {}", At(at))
        },
        "Take it out, or give its ends different places",
    );
}

/// Relative error of coordinates after a few operations in the precision in which they are held.
fn rounding(run: RunPoints<'_>) -> f64 {
    match run {
        RunPoints::F64(_) => 32.0 * f64::EPSILON,
        RunPoints::F32(_) => 8.0 * f64::from(f32::EPSILON),
    }
}
