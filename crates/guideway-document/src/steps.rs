//! Round numbers for a grid and a scale bar.

/// The least of 1, 2 and 5 times a power of ten that is at least `least`, which is above zero.
pub fn round_step(least: f64) -> f64 {
    let magnitude = 10f64.powf(least.log10().floor());
    let steps = [1.0, 2.0, 5.0, 10.0].map(|factor| factor * magnitude);
    // Rounding of the logarithm may put `least` a little above the last one.
    steps
        .into_iter()
        .find(|&step| step >= least)
        .unwrap_or(20.0 * magnitude)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_round_and_never_too_small() {
        for (least, step) in [
            (1.0, 1.0),
            (1.1, 2.0),
            (3.0, 5.0),
            (6.0, 10.0),
            (0.03, 0.05),
        ] {
            assert!((round_step(least) - step).abs() < 1e-12 * step, "{least}");
        }
        for power in -9..9 {
            let least = 10f64.powi(power) * 1.0001;
            assert!(
                (1.0..2.01).contains(&(round_step(least) / least)),
                "{least}"
            );
        }
    }
}
