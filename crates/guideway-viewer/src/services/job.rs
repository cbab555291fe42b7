//! A long operation as both threads see it: one reports progress, the other may cancel.

use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

/// Progress and cancellation of a long operation, shared between the window and a worker thread.
#[derive(Debug, Default)]
pub struct Job {
    done: AtomicU64,
    total: AtomicU64,
    is_cancelled: AtomicBool,
}

impl Job {
    /// Reports that `done` of `total` steps are complete.
    pub fn advance(&self, done: u64, total: u64) {
        self.done.store(done, Ordering::Relaxed);
        self.total.store(total, Ordering::Relaxed);
    }

    /// Progress from 0 to 1; `None` until a total is reported.
    pub fn fraction(&self) -> Option<f32> {
        let total = self.total.load(Ordering::Relaxed);
        let done = self.done.load(Ordering::Relaxed);
        (total > 0).then(|| (done as f32 / total as f32).min(1.0))
    }

    /// Requests that the operation stop; it stops at its next check of [`Self::is_cancelled`].
    pub fn cancel(&self) {
        self.is_cancelled.store(true, Ordering::Relaxed);
    }

    /// Returns `true` if [`Self::cancel`] was called.
    pub fn is_cancelled(&self) -> bool {
        self.is_cancelled.load(Ordering::Relaxed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fraction_is_unknown_without_total_and_at_most_one() {
        let job = Job::default();
        assert_eq!(job.fraction(), None);
        job.advance(1, 4);
        assert_eq!(job.fraction(), Some(0.25));
        job.advance(5, 4);
        assert_eq!(job.fraction(), Some(1.0));
    }
}
