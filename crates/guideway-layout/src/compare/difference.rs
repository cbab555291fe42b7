//! [`Difference`]: a kind of difference between two layouts, with its count and an example.

/// Tolerances of a comparison.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CompareOptions {
    /// Greatest distance of curves and positions that count as equal, in meters.
    pub tolerance_m: f64,
    /// Greatest relative difference of numbers in columns that count as equal.
    pub relative_tolerance: f64,
}

impl Default for CompareOptions {
    /// One micrometer, and the rounding of a few operations.
    fn default() -> Self {
        Self {
            tolerance_m: 1e-6,
            relative_tolerance: 1e-12,
        }
    }
}

/// A kind of difference between two layouts.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Difference {
    /// Kind, such as `directions` or `column maxSpeed`: the names that losses of writers have. What
    /// the first layout lacks begins with `new`, such as `new nodes`.
    pub what: String,
    /// Number of elements that differ.
    pub count: u64,
    /// First element that differs, with both values.
    pub example: String,
}

/// Differences by kind, in the order of their detection.
#[derive(Default)]
pub(super) struct Differences(Vec<Difference>);

impl Differences {
    /// Counts a difference. Calls `example` only for the first one of its kind.
    pub(super) fn add(&mut self, what: &str, example: impl FnOnce() -> String) {
        match self.0.iter_mut().find(|known| known.what == what) {
            Some(known) => known.count += 1,
            None => self.0.push(Difference {
                what: what.to_owned(),
                count: 1,
                example: example(),
            }),
        }
    }

    pub(super) fn into_vec(self) -> Vec<Difference> {
        self.0
    }
}
