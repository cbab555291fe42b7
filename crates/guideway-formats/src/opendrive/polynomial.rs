//! Cubic polynomials, and piecewise cubic functions along a road.

/// a + b x + c x^2 + d x^3.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Cubic {
    pub(super) a: f64,
    pub(super) b: f64,
    pub(super) c: f64,
    pub(super) d: f64,
}

impl Cubic {
    /// The value and the first derivative at x.
    pub(super) fn at(self, x: f64) -> [f64; 2] {
        let Self { a, b, c, d } = self;
        [
            a + x * (b + x * (c + x * d)),
            b + x * (2.0 * c + x * 3.0 * d),
        ]
    }

    /// The second derivative at x.
    pub(super) fn second(self, x: f64) -> f64 {
        2.0 * self.c + 6.0 * self.d * x
    }

    /// The same function as a polynomial in x - x0.
    pub(super) fn about(self, x0: f64) -> Self {
        let [a, b] = self.at(x0);
        Self {
            a,
            b,
            c: self.c + 3.0 * self.d * x0,
            d: self.d,
        }
    }

    /// `self + other * factor`.
    pub(super) fn plus(self, other: Self, factor: f64) -> Self {
        Self {
            a: self.a + other.a * factor,
            b: self.b + other.b * factor,
            c: self.c + other.c * factor,
            d: self.d + other.d * factor,
        }
    }

    /// The place and the value of the minimum on `0..=length`.
    pub(super) fn minimum(self, length: f64) -> [f64; 2] {
        // The derivative is b + 2 c x + 3 d x^2.
        let (a, half_b, c) = (3.0 * self.d, self.c, self.b);
        let root = (half_b * half_b - a * c).max(0.0).sqrt();
        let q = -half_b - root.copysign(half_b);
        let places = [0.0, length, q / a, c / q];
        let inside = places.into_iter().filter(|x| (0.0..=length).contains(x));
        let values = inside.map(|x| [x, self.at(x)[0]]);
        values
            .min_by(|x, y| x[1].total_cmp(&y[1]))
            .unwrap_or([0.0, self.a])
    }

    /// Bounds of the absolute values of the function and its first four derivatives on
    /// `0..=length`.
    pub(super) fn bounds(self, length: f64) -> [f64; 5] {
        let [a, b, c, d] = [self.a, self.b, self.c, self.d].map(f64::abs);
        [
            a + length * (b + length * (c + length * d)),
            b + length * (2.0 * c + length * 3.0 * d),
            2.0 * c + 6.0 * d * length,
            6.0 * d,
            0.0,
        ]
    }

    /// Tells if all coefficients are finite.
    pub(super) fn is_finite(self) -> bool {
        (self.a + self.b + self.c + self.d).is_finite()
    }
}

/// A piecewise cubic function: each polynomial is about its start and holds until the next one; 0
/// before the first.
#[derive(Clone, Debug, Default)]
pub(super) struct Piecewise {
    /// Start and polynomial, sorted by start.
    pieces: Vec<(f64, Cubic)>,
}

impl Piecewise {
    pub(super) fn new(mut pieces: Vec<(f64, Cubic)>) -> Self {
        pieces.sort_by(|a, b| a.0.total_cmp(&b.0));
        Self { pieces }
    }

    /// The start of every polynomial.
    pub(super) fn starts(&self) -> impl Iterator<Item = f64> {
        self.pieces.iter().map(|(start, _)| *start)
    }

    pub(super) fn is_empty(&self) -> bool {
        self.pieces.is_empty()
    }

    /// The polynomial that is valid between two places without a start between them, about the
    /// first place.
    pub(super) fn between(&self, [from, to]: [f64; 2]) -> Cubic {
        // Starts may differ from the places by rounding.
        let middle = 0.5 * (from + to);
        let after = self.pieces.partition_point(|(start, _)| *start <= middle);
        match after.checked_sub(1).map(|i| self.pieces[i]) {
            Some((start, cubic)) => cubic.about(from - start),
            None => Cubic::default(),
        }
    }

    /// The place and the value of the minimum up to a place; `None` without a polynomial.
    pub(super) fn minimum(&self, end: f64) -> Option<[f64; 2]> {
        let starts = self.starts().skip(1).chain([end]);
        let minima = self
            .pieces
            .iter()
            .zip(starts)
            .map(|((start, cubic), next)| {
                let [x, value] = cubic.minimum((next.min(end) - start).max(0.0));
                [start + x, value]
            });
        minima.min_by(|x, y| x[1].total_cmp(&y[1]))
    }

    /// The first coefficient that is not 0, in the order of the polynomials.
    pub(super) fn sign(&self) -> f64 {
        let coefficients = self.pieces.iter().flat_map(|(_, p)| [p.a, p.b, p.c, p.d]);
        let found = coefficients.into_iter().find(|number| *number != 0.0);
        found.map_or(1.0, f64::signum)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn minimum_is_at_an_end_or_between() {
        let cubic = |a, b, c, d| Cubic { a, b, c, d };
        for (cubic, length, expected) in [
            (cubic(1.0, -0.1, 0.0, 0.0), 50.0, [50.0, -4.0]),
            (cubic(1.0, 0.0, 0.0, 0.0), 50.0, [0.0, 1.0]),
            (cubic(1.0, -2.0, 1.0, 0.0), 9.0, [1.0, 0.0]),
            (cubic(0.0, -3.0, 0.0, 1.0), 9.0, [1.0, -2.0]),
            (
                cubic(0.0, 3.0, -6.0, 1.0),
                9.0,
                [3.732_050_807_568_877, -20.392_304_845_413_264],
            ),
        ] {
            let [x, value] = cubic.minimum(length);
            let [expected_x, expected_value] = expected;
            assert!((x - expected_x).abs() < 1e-9, "{cubic:?} at {x}");
            assert!((value - expected_value).abs() < 1e-9, "{cubic:?}: {value}");
        }
    }

    #[test]
    fn a_start_one_rounding_after_a_place_counts() {
        let constant = |a| Cubic {
            a,
            ..Cubic::default()
        };
        let start = 2.406_657_433_403_103;
        let widths = Piecewise::new(vec![(0.0, constant(3.0)), (start, constant(6.0))]);
        assert_eq!(widths.between([start.next_down(), 9.0]).a, 6.0);
        assert_eq!(widths.between([0.0, start.next_up()]).a, 3.0);
    }
}
