//! Integrates functions over an interval: Gauss-Legendre quadrature with eight nodes.

/// Positive nodes and their weights on [-1, 1].
///
/// Source: Abramowitz and Stegun, table 25.4.
const GAUSS: [(f64, f64); 4] = [
    (0.183_434_642_495_649_8, 0.362_683_783_378_362),
    (0.525_532_409_916_329, 0.313_706_645_877_887_3),
    (0.796_666_477_413_626_7, 0.222_381_034_453_374_5),
    (0.960_289_856_497_536_3, 0.101_228_536_290_376_3),
];

/// The integral of f over `from..=from + length`.
pub(super) fn gauss(from: f64, length: f64, f: impl Fn(f64) -> f64) -> f64 {
    let half = 0.5 * length;
    let middle = from + half;
    let pair =
        |(node, weight): (f64, f64)| (f(middle - half * node) + f(middle + half * node)) * weight;
    half * GAUSS.into_iter().map(pair).sum::<f64>()
}
