//! Numbers that look random and are the same on every machine.

/// A linear congruential generator with Knuth's MMIX constants.
#[derive(Clone, Debug)]
pub struct Lcg(u64);

impl Lcg {
    /// A sequence of its own for each seed.
    pub fn new(seed: u64) -> Self {
        let mut lcg = Self(seed);
        // The first numbers of neighboring seeds are alike.
        for _ in 0..4 {
            lcg.unit();
        }
        lcg
    }

    /// From 0 up to but not including 1.
    pub fn unit(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 32) as f64 / (1_u64 << 32) as f64
    }

    /// From `low` up to but not including `high`.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// One of 0 to `count` - 1.
    pub fn below(&mut self, count: usize) -> usize {
        (self.unit() * count as f64) as usize
    }
}
