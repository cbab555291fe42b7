use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError};
use std::thread;
use std::time::Duration;

use super::Wake;
use crate::services::WINDOW_ERROR;
use guideway_layout::UserError;

/// Something that is done once, beside the window.
pub(crate) struct Task<T> {
    outcome: Receiver<T>,
    /// Whether the window waits for it just now, and so need not be woken: each frame costs.
    is_awaited: Arc<AtomicBool>,
}

impl<T: Send + 'static> Task<T> {
    pub(crate) fn start(wake: &Wake, work: impl FnOnce() -> T + Send + 'static) -> Self {
        let (sender, outcome) = mpsc::channel();
        let is_awaited = Arc::<AtomicBool>::default();
        let (wake, is_heard) = (Arc::clone(wake), Arc::clone(&is_awaited));
        thread::spawn(move || {
            // Nobody hears it if the question was dropped in the meantime.
            let _ = sender.send(work());
            if !is_heard.load(Ordering::SeqCst) {
                wake();
            }
        });
        Self {
            outcome,
            is_awaited,
        }
    }

    /// What came of it, once it is done.
    ///
    /// # Errors
    /// When it broke down.
    pub(crate) fn outcome(&self) -> Option<Result<T, UserError>> {
        self.outcome_within(Duration::ZERO)
    }

    /// What came of it, for which it waits.
    ///
    /// # Errors
    /// When it broke down.
    pub(crate) fn wait(self) -> Result<T, UserError> {
        self.outcome.recv().map_err(|_| broken_down())
    }

    /// What came of it, if it is done within so long.
    ///
    /// # Errors
    /// When it broke down.
    pub(crate) fn outcome_within(&self, patience: Duration) -> Option<Result<T, UserError>> {
        self.is_awaited.store(true, Ordering::SeqCst);
        let outcome = self.outcome.recv_timeout(patience);
        self.is_awaited.store(false, Ordering::SeqCst);
        let outcome = match outcome {
            // It may have come since, and have woken nobody.
            Err(RecvTimeoutError::Timeout) => self.outcome.recv_timeout(Duration::ZERO),
            outcome => outcome,
        };
        match outcome {
            Ok(outcome) => Some(Ok(outcome)),
            Err(RecvTimeoutError::Timeout) => None,
            Err(RecvTimeoutError::Disconnected) => Some(Err(broken_down())),
        }
    }
}

fn broken_down() -> UserError {
    UserError {
        code: WINDOW_ERROR,
        message: "what was asked for came to no end".into(),
        remedy: "Try again, with less or by another way".into(),
    }
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::AtomicUsize;
    use std::time::Instant;

    use super::*;

    #[test]
    fn the_window_is_woken_unless_it_waits_and_never_misses_anything() {
        let wakes = Arc::<AtomicUsize>::default();
        let counted = Arc::clone(&wakes);
        let wake: Wake = Arc::new(move || {
            counted.fetch_add(1, Ordering::SeqCst);
        });
        let long = Duration::from_secs(60);
        let task = Task::start(&wake, || 7);
        assert_eq!(task.outcome_within(long), Some(Ok(7)));
        for round in 0..2_000_u64 {
            let before = wakes.load(Ordering::SeqCst);
            let task = Task::start(&wake, move || round);
            let mut outcome = task.outcome_within(Duration::from_micros(round % 64));
            let since = Instant::now();
            while outcome.is_none() && since.elapsed() < long {
                // Only what wakes it has it look again.
                if wakes.load(Ordering::SeqCst) > before {
                    outcome = task.outcome();
                }
            }
            assert_eq!(outcome, Some(Ok(round)));
        }
    }

    #[test]
    fn what_breaks_down_is_told_of() {
        let wake: Wake = Arc::new(|| {});
        // Unlike `panic!` it is not counted as a fault by the test that counts those of all threads.
        let break_down = || std::panic::resume_unwind(Box::new("on purpose"));
        let task: Task<()> = Task::start(&wake, break_down);
        let outcome = task.outcome_within(Duration::from_secs(60));
        assert!(outcome.is_some_and(|outcome| outcome.is_err()));
    }
}
