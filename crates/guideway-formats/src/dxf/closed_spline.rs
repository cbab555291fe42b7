//! Closed splines: turns the one period that a file states into the whole knots and control points,
//! and finds flags that contradict the curve.
//!
//! | flag | knots for n control points of degree p | curve |
//! |---|---|---|
//! | closed | n + m, where the first knot occurs m times | closed, one period |
//! | closed | none | closed and uniform, unless the ends are one point |
//! | closed | n + p + 1 | as the knots state; open ends are reported |
//! | none | n + 1, for degree 3 and above | closed, one period; reported |
//!
//! The third row is the reading of ezdxf and of Open CASCADE, which build the curve of whole knots
//! without looking at the flag.

use guideway_layout::Code;
use guideway_spline::{Runs, knots};

use crate::builder::{Builder, PlaceFn};
use crate::spline::Spline;

/// Completes the knots and the control points of a closed curve.
pub(super) fn close(
    builder: &mut Builder<'_>,
    is_closed: bool,
    spline: &mut Spline,
    at: PlaceFn<'_>,
) {
    let (count, points, degree) = (spline.knots.len(), spline.points.len(), spline.degree);
    if is_closed && count == 0 && points > degree && spline.points[0] != spline.points[points - 1] {
        if spline.points[..degree] != spline.points[points - degree..] {
            repeat(spline, points + degree);
        }
        spline.knots = knots::uniform_closed(degree, spline.points.len() - degree);
        let message = || "the knots of a closed spline are missing".to_owned();
        builder.report(Code::MissingKnots, at, message, "Uniform knots are used");
    } else if is_closed {
        unroll(spline);
    } else if degree > 2
        && points > degree
        && count == points + 1
        && spline.knots[0] < spline.knots[1]
    {
        // With fewer knots, the degrees 1 and 2 have other mistakes.
        if unroll(spline) {
            let message = || {
                let expected = points + degree + 1;
                format!(
                    "{count} knots; {points} control points of degree {degree} need {expected}: \
                     probably one period of a closed curve, without the flag of one"
                )
            };
            let remedy = "The closed curve is drawn; set the flag, or correct the knots";
            builder.report(Code::BadKnots, at, message, remedy);
        }
    }
}

/// Reports a curve with the flag of closed ones whose ends are apart.
pub(super) fn report_open(builder: &mut Builder<'_>, runs: &Runs, at: PlaceFn<'_>) {
    let apart = runs.start().zip(runs.end());
    let apart_m = apart.map_or(0.0, |(start, end)| start.distance(end));
    if apart_m > builder.source.options.limits.conversion_tolerance_m {
        let message =
            || format!("the spline is marked as closed, but its ends are {apart_m:.4} m apart");
        let remedy = "It is drawn open, as its knots state; close it in the tool that drew it";
        builder.report(Code::Implausible, at, message, remedy);
    }
}

/// Unrolls a periodic curve: its knots cover one period, and its n control points are listed once.
/// Returns `false` for other curves.
///
/// If the first knot occurs m times, there are n + m knots, of which the last m end the period.
/// Degree p needs p + 1 - m further knots before and after, each a period away from one that is
/// listed, and as many repeated control points, less one. Source: Open CASCADE, `BSplCLib`.
fn unroll(spline: &mut Spline) -> bool {
    let (degree, knots, count) = (spline.degree, &spline.knots, spline.points.len());
    let Some((first, last)) = knots.first().zip(knots.last()) else {
        return false;
    };
    let multiplicity = knots.iter().take_while(|knot| *knot == first).count();
    let missing = degree + 1 - multiplicity.min(degree + 1);
    let is_unrolled = missing == 0 || count < missing || count < multiplicity;
    if is_unrolled || knots.len() != count + multiplicity {
        return false;
    }
    let period = last - first;
    // The knots of one period, without its end.
    let within = &knots[..count];
    let before = within[count - missing..].iter().map(|knot| knot - period);
    let after = within[multiplicity..].iter().map(|knot| knot + period);
    let unrolled = before
        .chain(knots.iter().copied())
        .chain(after.take(missing));
    let unrolled: Vec<f64> = unrolled.collect();
    let points = count + missing;
    if unrolled.len() != points + degree + 1 {
        return false;
    }
    spline.knots = unrolled;
    repeat(spline, points);
    true
}

/// Repeats the control points and their weights from the first one on, up to a number.
fn repeat(spline: &mut Spline, points: usize) {
    let repeated = spline.points.iter().copied().cycle().take(points);
    spline.points = repeated.collect();
    if !spline.weights.is_empty() {
        let repeated = spline.weights.iter().copied().cycle().take(points);
        spline.weights = repeated.collect();
    }
}
