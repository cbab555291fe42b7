//! Arcs of circles: converts them to cubic segments with a proven error bound.

use std::f64::consts::{FRAC_PI_2, TAU};

use crate::{Conversion, Point, Runs};

/// Most cubics per arc that [`arc_to_runs`] emits.
pub const MAX_ARC_PIECES: u32 = 4096;

/// Appends an arc of a circle: `center` and `radius` in meters, `start_angle` and `sweep` in
/// radians counter-clockwise from the x axis. A negative sweep goes clockwise; a sweep beyond a
/// full turn counts as a full turn. All numbers must be finite.
///
/// The arc consists of equal cubics, as many as `tolerance_m` requires, up to [`MAX_ARC_PIECES`].
/// Each has its ends and its middle on the circle: its inner Bezier points lie at k = 4/3 tan(a/4)
/// along the end tangents, a being its angle.
///
/// ```text
///        b1 ------ b2
///      k /  . --- .  \ k      a: angle of one cubic
///       / .         . \       k: length of the handles, radius 1
///      A ..... a ..... E
/// ```
///
/// On the unit circle such a cubic has
///
/// ```text
/// x^2 + y^2 - 1 = 16 sin^6(a/4) / cos^2(a/4) t^2 (1 - t)^2 (1 - 2t)^2
/// ```
///
/// The polynomial in t is at most 1/108, so the cubic never runs inside of the circle, and outside
/// by at most 2/27 sin^6(a/4) / cos^2(a/4). Source: Goldapp 1991.
pub fn arc_to_runs(
    center: Point<f64>,
    radius: f64,
    start_angle: f64,
    sweep: f64,
    tolerance_m: f64,
    out: &mut Runs,
) -> Conversion {
    let sweep = sweep.clamp(-TAU, TAU);
    let (pieces, error_bound_m) = pieces_of_arc(radius, sweep, tolerance_m);
    let angle = sweep / f64::from(pieces);
    let k = 4.0 / 3.0 * (angle / 4.0).tan();
    let radius_vector = |i: u32| {
        let (sin, cos) = (start_angle + angle * f64::from(i)).sin_cos();
        Point::new(cos, sin) * radius
    };
    let handle = |radius: Point<f64>| Point::new(-radius.y, radius.x) * k;
    for i in 0..pieces {
        let (a, b) = (radius_vector(i), radius_vector(i + 1));
        let bezier = [a, a + handle(a), b - handle(b), b];
        out.push_bezier(&bezier.map(|p| center + p));
    }
    Conversion {
        exact: false,
        error_bound_m,
        pieces: pieces as usize,
    }
}

/// Number of equal cubics that an arc requires, and the bound of their error in meters.
pub(crate) fn pieces_of_arc(radius: f64, sweep: f64, tolerance_m: f64) -> (u32, f64) {
    let error = |pieces: u32| {
        let (sin, cos) = (sweep / f64::from(4 * pieces)).sin_cos();
        radius.abs() * 2.0 / 27.0 * sin.powi(6) / (cos * cos)
    };
    // A cubic covers at most a quarter turn, so the search starts at 1 to 4 pieces.
    let least = (1..4).find(|&n| sweep.abs() <= FRAC_PI_2 * f64::from(n));
    let pieces = (least.unwrap_or(4)..MAX_ARC_PIECES)
        .find(|&n| error(n) <= tolerance_m)
        .unwrap_or(MAX_ARC_PIECES);
    (pieces, error(pieces))
}
