use std::f64::consts::{FRAC_PI_2, TAU};

use crate::{Conversion, Point, Runs};

/// The most cubics that [`arc_to_runs`] makes of an arc.
pub const MAX_ARC_PIECES: u32 = 4096;

/// Appends an arc of a circle: `center` and `radius` in meters, `start_angle` and `sweep` in radians
/// counter-clockwise from the x axis; a negative sweep goes clockwise, and one beyond a full turn is
/// a full turn. All must be finite.
///
/// It is as many equal cubics as the tolerance asks for, up to [`MAX_ARC_PIECES`]. Each has its ends and its middle
/// on the circle: inner Bezier points at k = 4/3 tan(a/4) along the end tangents, a being its angle.
/// On the unit circle such a cubic has
///
/// ```text
/// x^2 + y^2 - 1 = 16 sin^6(a/4) / cos^2(a/4) t^2 (1 - t)^2 (1 - 2t)^2
/// ```
///
/// and the polynomial in t is at most 1/108, so it is never inside, and outside by at most
/// 2/27 sin^6(a/4) / cos^2(a/4) (Goldapp 1991).
pub fn arc_to_runs(
    center: Point<f64>,
    radius: f64,
    start_angle: f64,
    sweep: f64,
    tolerance_m: f64,
    out: &mut Runs,
) -> Conversion {
    let sweep = sweep.clamp(-TAU, TAU);
    let error = |pieces: u32| {
        let (sin, cos) = (sweep / f64::from(4 * pieces)).sin_cos();
        radius.abs() * 2.0 / 27.0 * sin.powi(6) / (cos * cos)
    };
    // At most a quarter turn each: 1 to 4, to begin with.
    let least = (1..4).find(|&n| sweep.abs() <= FRAC_PI_2 * f64::from(n));
    let pieces = (least.unwrap_or(4)..MAX_ARC_PIECES)
        .find(|&n| error(n) <= tolerance_m)
        .unwrap_or(MAX_ARC_PIECES);
    let angle = sweep / f64::from(pieces);
    let k = 4.0 / 3.0 * (angle / 4.0).tan();
    let arm = |i: u32| {
        let (sin, cos) = (start_angle + angle * f64::from(i)).sin_cos();
        Point::new(cos, sin) * radius
    };
    let tangent = |arm: Point<f64>| Point::new(-arm.y, arm.x) * k;
    for i in 0..pieces {
        let (a, b) = (arm(i), arm(i + 1));
        let bezier = [a, a + tangent(a), b - tangent(b), b];
        out.push_bezier(&bezier.map(|p| center + p));
    }
    Conversion {
        exact: false,
        error_bound_m: error(pieces),
        pieces: pieces as usize,
    }
}
