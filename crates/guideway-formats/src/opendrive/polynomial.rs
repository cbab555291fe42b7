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

    /// The same function as a polynomial in x / factor.
    pub(super) fn stretched(self, factor: f64) -> Self {
        Self {
            a: self.a,
            b: self.b * factor,
            c: self.c * factor * factor,
            d: self.d * factor.powi(3),
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

    /// Whether all coefficients are finite.
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

    /// The polynomial valid from s on, about s.
    pub(super) fn from(&self, s: f64) -> Cubic {
        let after = self.pieces.partition_point(|(start, _)| *start <= s);
        match after.checked_sub(1).map(|i| self.pieces[i]) {
            Some((start, cubic)) => cubic.about(s - start),
            None => Cubic::default(),
        }
    }
}
