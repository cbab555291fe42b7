//! A deadline limits a part of a run, and divides its remaining time among pieces of work.

use std::time::{Duration, Instant};

/// Most even shares of the remaining time that one piece may take. Chosen: a few slow pieces then
/// borrow from many fast ones, and no piece takes all.
const MAX_SHARES: u32 = 4;

/// The time at which a part of the run must end; `None` for no limit.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Deadline(Option<Instant>);

impl Deadline {
    /// The deadline `seconds` from now.
    pub(crate) fn after(seconds: f64) -> Self {
        let wait = Duration::try_from_secs_f64(seconds.max(0.0)).ok();
        Self(wait.and_then(|wait| Instant::now().checked_add(wait)))
    }

    /// Deadline of the next of `pieces` remaining pieces: up to [`MAX_SHARES`] even shares of the
    /// remaining time, because most pieces take less than one.
    pub(crate) fn share(self, pieces: usize) -> Self {
        let now = Instant::now();
        Self(self.0.map(|end| {
            let left = end.saturating_duration_since(now);
            now + (left * MAX_SHARES / u32::try_from(pieces.max(1)).unwrap_or(u32::MAX)).min(left)
        }))
    }

    /// No time limit.
    pub(crate) fn never() -> Self {
        Self(None)
    }

    /// Returns `true` if the time is over.
    pub(crate) fn is_over(self) -> bool {
        self.0.is_some_and(|end| Instant::now() >= end)
    }
}
