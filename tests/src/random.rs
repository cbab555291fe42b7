//! Seeded pseudo-random numbers, equal on every machine.

/// A linear congruential generator with Knuth's MMIX constants.
#[derive(Clone, Debug)]
pub struct Lcg(u64);

impl Lcg {
    /// The sequence of a seed.
    pub fn new(seed: u64) -> Self {
        let mut lcg = Self(seed);
        // The first numbers of neighboring seeds are correlated.
        for _ in 0..4 {
            lcg.unit();
        }
        lcg
    }

    /// Uniform in `0..1`.
    pub fn unit(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 32) as f64 / (1_u64 << 32) as f64
    }

    /// Uniform in `low..high`.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// Uniform in `0..count`.
    pub fn below(&mut self, count: usize) -> usize {
        (self.unit() * count as f64) as usize
    }
}
