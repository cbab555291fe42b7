//! Summarizes the samples of one quantity: mean, median, extremes and percentiles.

use serde::{Deserialize, Serialize};

/// Summary of the samples of one quantity, in their unit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Summary {
    /// Number of samples.
    pub count: usize,
    /// Arithmetic mean; the thesis reports means.
    pub mean: f64,
    /// 50th percentile.
    pub median: f64,
    /// Smallest sample.
    pub min: f64,
    /// Largest sample.
    pub max: f64,
    /// 5th percentile.
    pub p5: f64,
    /// 95th percentile.
    pub p95: f64,
    /// `(p95 - p5) / median`; 0 if the median is 0.
    pub spread: f64,
}

impl Summary {
    /// Summarizes samples; `None` when the list is empty or a sample is not finite.
    pub fn of(samples: &[f64]) -> Option<Self> {
        if samples.is_empty() || !samples.iter().all(|s| s.is_finite()) {
            return None;
        }
        let mut sorted = samples.to_vec();
        sorted.sort_by(f64::total_cmp);
        let (median, p5, p95) = (
            quantile(&sorted, 0.5),
            quantile(&sorted, 0.05),
            quantile(&sorted, 0.95),
        );
        Some(Self {
            count: sorted.len(),
            mean: sorted.iter().sum::<f64>() / sorted.len() as f64,
            median,
            min: sorted[0],
            max: sorted[sorted.len() - 1],
            p5,
            p95,
            spread: if median > 0.0 {
                (p95 - p5) / median
            } else {
                0.0
            },
        })
    }
}

/// Quantile of sorted samples, interpolated linearly between two (Hyndman and Fan's type 7).
fn quantile(sorted: &[f64], fraction: f64) -> f64 {
    let position = fraction * (sorted.len() - 1) as f64;
    let below = position as usize;
    let above = (below + 1).min(sorted.len() - 1);
    sorted[below] + (sorted[above] - sorted[below]) * (position - below as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn summarizes_unsorted_samples() {
        let samples: Vec<f64> = (0..=100).rev().map(f64::from).collect();
        let summary = Summary::of(&samples).unwrap();
        let expected = Summary {
            count: 101,
            mean: 50.0,
            median: 50.0,
            min: 0.0,
            max: 100.0,
            p5: 5.0,
            p95: 95.0,
            spread: 1.8,
        };
        assert_eq!(summary, expected);
    }

    #[test]
    fn median_interpolates_and_ignores_an_outlier() {
        assert_eq!(Summary::of(&[1.0, 2.0]).unwrap().median, 1.5);
        let summary = Summary::of(&[2.0, 900.0, 1.0]).unwrap();
        assert_eq!((summary.median, summary.mean), (2.0, 301.0));
    }

    #[test]
    fn one_sample_has_no_spread_and_no_samples_have_no_summary() {
        let summary = Summary::of(&[4.0]).unwrap();
        assert_eq!((summary.p5, summary.p95, summary.spread), (4.0, 4.0, 0.0));
        assert_eq!(Summary::of(&[]), None);
        assert_eq!(Summary::of(&[1.0, f64::NAN]), None);
        assert_eq!(Summary::of(&[0.0, 0.0]).unwrap().spread, 0.0);
    }
}
