//! [`ClassBreaks`]: the numbers that divide the numbers of a column into classes, and the names of
//! these classes.

/// Most breaks. Derived: colors of more than 16 classes are hard to tell apart.
const MAX_BREAKS: usize = 15;
/// Magnitudes of numbers that are written without an exponent, besides 0.
const PLAIN: std::ops::Range<f64> = 1e-6..1e15;

/// Ascending finite numbers, 1 to 15, that divide all numbers into one class more. A number that
/// equals a break is in the class above it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClassBreaks {
    /// The breaks, then zeros.
    numbers: [f64; MAX_BREAKS],
    count: usize,
}

/// Numbers that are no class breaks.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum ClassBreaksError {
    /// There are none.
    #[error("there are no class breaks; write at least one number, such as 0.5")]
    Empty,
    /// There are more than 15.
    #[error("there are {count} class breaks; write at most {MAX_BREAKS}")]
    TooMany {
        /// Their number.
        count: usize,
    },
    /// A break is infinite or no number.
    #[error("the class break {number} is not finite; write finite numbers")]
    NotFinite {
        /// The break.
        number: f64,
    },
    /// A break is not above the one before it.
    #[error(
        "the class break {number} comes after {before}; write the breaks in ascending order, each \
         one once"
    )]
    NotAscending {
        /// The break before it.
        before: f64,
        /// The break.
        number: f64,
    },
}

impl ClassBreaks {
    /// Class breaks at these numbers.
    ///
    /// # Errors
    /// When there are none or more than 15, or when they are not finite or not ascending.
    pub fn new(numbers: &[f64]) -> Result<Self, ClassBreaksError> {
        let count = numbers.len();
        match count {
            0 => return Err(ClassBreaksError::Empty),
            1..=MAX_BREAKS => {}
            _ => return Err(ClassBreaksError::TooMany { count }),
        }
        if let Some(&number) = numbers.iter().find(|number| !number.is_finite()) {
            return Err(ClassBreaksError::NotFinite { number });
        }
        if let Some(&[before, number]) = numbers.array_windows().find(|[a, b]| a >= b) {
            return Err(ClassBreaksError::NotAscending { before, number });
        }
        let mut breaks = Self {
            numbers: [0.0; MAX_BREAKS],
            count,
        };
        breaks.numbers[..count].copy_from_slice(numbers);
        Ok(breaks)
    }

    /// The breaks, lowest first.
    pub fn numbers(&self) -> &[f64] {
        &self.numbers[..self.count]
    }

    /// Index of the class of a number, the lowest class first.
    pub(crate) fn class(&self, number: f64) -> usize {
        self.numbers().partition_point(|&start| start <= number)
    }

    /// Names of the classes, lowest first.
    pub(crate) fn labels(&self) -> Vec<String> {
        let texts: Vec<String> = self.numbers().iter().map(|&number| text(number)).collect();
        let first = texts.first().map(|end| format!("below {end}"));
        let between = texts
            .array_windows()
            .map(|[start, end]| format!("{start} to {end}"));
        let last = texts.last().map(|start| format!("{start} and more"));
        first.into_iter().chain(between).chain(last).collect()
    }
}

/// A break as it is read in a legend.
fn text(number: f64) -> String {
    // Adding 0 turns -0 into 0.
    let number = number + 0.0;
    match number == 0.0 || PLAIN.contains(&number.abs()) {
        true => number.to_string(),
        false => format!("{number:e}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn breaks_are_few_finite_and_ascending() {
        let error = |numbers: &[f64]| ClassBreaks::new(numbers).unwrap_err().to_string();
        assert!(error(&[]).contains("at least one number"));
        let sixteen: Vec<f64> = (0..16).map(f64::from).collect();
        assert!(error(&sixteen).contains("there are 16 class breaks; write at most 15"));
        assert!(error(&[1.0, f64::NAN]).contains("NaN is not finite"));
        assert!(error(&[f64::NEG_INFINITY]).contains("-inf is not finite"));
        assert!(error(&[1.0, 2.0, 0.5]).contains("0.5 comes after 2"));
        assert!(error(&[0.0, 2.0, 2.0]).contains("2 comes after 2"));
        let breaks = ClassBreaks::new(&sixteen[1..]).unwrap();
        assert_eq!(breaks.numbers(), &sixteen[1..]);
    }

    #[test]
    fn a_number_that_equals_a_break_is_above_it() {
        let breaks = ClassBreaks::new(&[-1.0, 0.5, 2.0]).unwrap();
        let classes = [-9.0, -1.0, 0.4, 0.5, 1.9, 2.0, 1e9].map(|number| breaks.class(number));
        assert_eq!(classes, [0, 1, 1, 2, 2, 3, 3]);
    }

    #[test]
    fn labels_say_the_ends_of_each_class() {
        let labels = |numbers: &[f64]| ClassBreaks::new(numbers).unwrap().labels();
        assert_eq!(
            labels(&[0.3, 0.6, 1.0]),
            ["below 0.3", "0.3 to 0.6", "0.6 to 1", "1 and more"]
        );
        assert_eq!(labels(&[-0.0]), ["below 0", "0 and more"]);
        assert_eq!(
            labels(&[-2e-9, 12_500.0, 3e20]),
            [
                "below -2e-9",
                "-2e-9 to 12500",
                "12500 to 3e20",
                "3e20 and more"
            ]
        );
    }
}
