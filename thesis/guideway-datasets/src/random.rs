use rand_core::Rng;
use rand_pcg::Pcg32;

/// A seeded stream of numbers, the same on every machine.
pub(crate) struct Random(Pcg32);

impl Random {
    /// The stream of this number; streams of one seed are independent.
    pub(crate) fn new(seed: u64, stream: u64) -> Self {
        Self(Pcg32::new(seed, stream))
    }

    /// Evenly spread from `low` up to, but not including, `high`.
    pub(crate) fn between(&mut self, low: f64, high: f64) -> f64 {
        let unit = f64::from(self.0.next_u32()) / 4_294_967_296.0;
        low + (high - low) * unit
    }

    /// One of the numbers from 0 up to, but not including, `count`.
    pub(crate) fn below(&mut self, count: u32) -> u32 {
        // The multiplication keeps the result below `count`.
        ((u64::from(self.0.next_u32()) * u64::from(count)) >> 32) as u32
    }

    /// True so often in a hundred.
    pub(crate) fn percent(&mut self, chance: u32) -> bool {
        self.below(100) < chance
    }
}
