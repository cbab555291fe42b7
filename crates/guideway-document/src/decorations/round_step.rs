//! Round numbers for grids and scale bars.

/// The smallest of 1, 2 and 5 times a power of ten that is not less than `min`, which is positive.
pub fn round_step(min: f64) -> f64 {
    let magnitude = 10f64.powf(min.log10().floor());
    let steps = [1.0, 2.0, 5.0, 10.0].map(|factor| factor * magnitude);
    // The logarithm may round down so that `min` exceeds even the last step slightly.
    steps
        .into_iter()
        .find(|&step| step >= min)
        .unwrap_or(20.0 * magnitude)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_round_and_not_less_than_the_minimum() {
        for (min, step) in [
            (1.0, 1.0),
            (1.1, 2.0),
            (3.0, 5.0),
            (6.0, 10.0),
            (0.03, 0.05),
        ] {
            assert!((round_step(min) - step).abs() < 1e-12 * step, "{min}");
        }
        for power in -9..9 {
            let min = 10f64.powi(power) * 1.0001;
            assert!((1.0..2.01).contains(&(round_step(min) / min)), "{min}");
        }
    }
}
