//! The record of a soak: counts of actions and steps, and memory over time.

use std::collections::BTreeMap;
use std::fmt::Write;

use super::memory;

/// Counts of actions, and memory over time.
#[derive(Default)]
pub(super) struct Record {
    pub(super) counts: BTreeMap<&'static str, u64>,
    /// Counts of the steps that can be undone, by name.
    pub(super) steps: BTreeMap<&'static str, u64>,
    /// Minutes since the start, and resident megabytes, at the end of each chapter.
    pub(super) rests: Vec<(f64, f64)>,
}

impl Record {
    pub(super) fn count(&mut self, what: &'static str) {
        *self.counts.entry(what).or_default() += 1;
    }

    pub(super) fn at_rest_mb(&self) -> Vec<f64> {
        self.rests.iter().map(|&(_, mb)| mb).collect()
    }

    /// The record as text.
    pub(super) fn text(&self, seed: u64, minutes: f64) -> String {
        let mut text = format!("seed {seed}, {minutes:.1} minutes\n");
        for (what, count) in &self.counts {
            let _ = writeln!(text, "{count:>9}  {what}");
        }
        let _ = writeln!(
            text,
            "{:>9}  events in all",
            self.counts.values().sum::<u64>()
        );
        for (what, count) in &self.steps {
            let _ = writeln!(text, "{count:>9}  step: {what}");
        }
        let growth_mb = memory::growth_mb(&self.at_rest_mb());
        let _ = writeln!(
            text,
            "memory at rest grew by {growth_mb:.1} MB\n\nminute  MB at rest"
        );
        let step = self.rests.len().div_ceil(60).max(1);
        for (minute, mb) in self.rests.iter().step_by(step) {
            let _ = writeln!(text, "{minute:>6.1}  {mb:.1}");
        }
        text
    }
}
