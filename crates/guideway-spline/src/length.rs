use crate::{Point, Real, uniform};

/// How often a segment is halved at most. Only cusps, where the speed has a kink, come near it.
const MAX_HALVINGS: u32 = 24;

/// Abscissas above zero and weights of 8-point Gauss-Legendre quadrature on [-1, 1] (Abramowitz &
/// Stegun, table 25.4).
const GAUSS: [(f64, f64); 4] = [
    (0.183_434_642_495_649_8, 0.362_683_783_378_362),
    (0.525_532_409_916_329, 0.313_706_645_877_887_3),
    (0.796_666_477_413_626_7, 0.222_381_034_453_374_48),
    (0.960_289_856_497_536_3, 0.101_228_536_290_376_26),
];

/// Arc length of one segment, to within an estimated error of `tolerance` (both in the unit of the
/// points, as are the next).
///
/// The speed is integrated by Gauss-Legendre quadrature; what the two halves give tells the error of
/// the whole, which is halved until that is small. A tolerance below rounding is raised to it.
pub fn segment_length<T: Real>(segment: &[Point<T>; 4], tolerance: f64) -> f64 {
    let segment = segment.map(Point::to_f64);
    let whole = gauss(&segment, 0.0, 1.0);
    let tolerance = tolerance.max(1e-14 * whole);
    refine(&segment, (0.0, 1.0), whole, tolerance, MAX_HALVINGS)
}

/// Arc length of a run, to within an estimated error of `tolerance`; zero for fewer than four points.
pub fn run_length<T: Real>(points: &[Point<T>], tolerance: f64) -> f64 {
    let share = tolerance / (points.len() as f64).max(1.0);
    let lengths = points.array_windows().map(|s| segment_length(s, share));
    lengths.sum()
}

fn refine(
    segment: &[Point<f64>; 4],
    (a, b): (f64, f64),
    whole: f64,
    tolerance: f64,
    halvings_left: u32,
) -> f64 {
    let middle = 0.5 * (a + b);
    let (left, right) = (gauss(segment, a, middle), gauss(segment, middle, b));
    if halvings_left == 0 || (left + right - whole).abs() <= tolerance {
        return left + right;
    }
    let half = |ends, part| refine(segment, ends, part, 0.5 * tolerance, halvings_left - 1);
    half((a, middle), left) + half((middle, b), right)
}

/// Integral of the speed from t = a to b.
fn gauss(segment: &[Point<f64>; 4], a: f64, b: f64) -> f64 {
    let (middle, half) = (0.5 * (a + b), 0.5 * (b - a));
    let speed = |t: f64| uniform::derivative(segment, t).norm();
    let pair =
        |&(x, weight): &(f64, f64)| weight * (speed(middle - half * x) + speed(middle + half * x));
    half * GAUSS.iter().map(pair).sum::<f64>()
}
