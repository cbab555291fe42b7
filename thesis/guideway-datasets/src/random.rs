//! Seeded random numbers, equal on every machine: from a seed and a stream number to a sequence.

use rand_core::Rng;
use rand_pcg::Pcg32;

/// A seeded stream of random numbers (PCG 32).
pub(crate) struct Random(Pcg32);

impl Random {
    /// Stream number `stream` of the seed; streams of one seed are independent.
    pub(crate) fn new(seed: u64, stream: u64) -> Self {
        Self(Pcg32::new(seed, stream))
    }

    /// Uniform in `low..high`.
    pub(crate) fn between(&mut self, low: f64, high: f64) -> f64 {
        let unit = f64::from(self.0.next_u32()) / 4_294_967_296.0;
        low + (high - low) * unit
    }

    /// Uniform in `0..count`.
    pub(crate) fn below(&mut self, count: u32) -> u32 {
        // The multiplication keeps the result below `count`.
        ((u64::from(self.0.next_u32()) * u64::from(count)) >> 32) as u32
    }

    /// True with a probability of `chance` percent.
    pub(crate) fn percent(&mut self, chance: u32) -> bool {
        self.below(100) < chance
    }
}
