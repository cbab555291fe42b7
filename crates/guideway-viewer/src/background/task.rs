//! Runs one closure on its own thread and hands its result to the window.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError};
use std::time::Duration;

use guideway_layout::UserError;

use crate::language::{start_thread, t};
use crate::services::WINDOW_ERROR;

/// Requests a frame from the window; callable from any thread.
pub(crate) type RepaintHandle = Arc<dyn Fn() + Send + Sync>;

/// A closure that runs once on its own thread.
pub(crate) struct BackgroundTask<T> {
    result: Receiver<T>,
    /// True if the window blocks on the result now. The task then skips the repaint: on a software
    /// renderer every frame costs a tenth of a second.
    is_awaited: Arc<AtomicBool>,
}

impl<T: Send + 'static> BackgroundTask<T> {
    /// Starts `work`; the window repaints when it ends.
    pub(crate) fn start(
        repaint: &RepaintHandle,
        work: impl FnOnce() -> T + Send + 'static,
    ) -> Self {
        let (sender, result) = mpsc::channel();
        let is_awaited = Arc::<AtomicBool>::default();
        let (repaint, skips_repaint) = (Arc::clone(repaint), Arc::clone(&is_awaited));
        // Without a thread the sender is dropped, and the result is an error.
        let _ = start_thread(move || {
            // The receiver is gone if the task was dropped in the meantime.
            let _ = sender.send(work());
            if !skips_repaint.load(Ordering::SeqCst) {
                repaint();
            }
        });
        Self { result, is_awaited }
    }

    /// The result, once the task is complete.
    ///
    /// # Errors
    /// When the task panicked.
    pub(crate) fn result(&self) -> Option<Result<T, UserError>> {
        self.result_within(Duration::ZERO)
    }

    /// Blocks until the task is complete.
    ///
    /// # Errors
    /// When the task panicked.
    pub(crate) fn wait(self) -> Result<T, UserError> {
        self.result.recv().map_err(|_| panicked())
    }

    /// The result, if the task completes within `timeout`.
    ///
    /// # Errors
    /// When the task panicked.
    pub(crate) fn result_within(&self, timeout: Duration) -> Option<Result<T, UserError>> {
        self.is_awaited.store(true, Ordering::SeqCst);
        let result = self.result.recv_timeout(timeout);
        self.is_awaited.store(false, Ordering::SeqCst);
        let result = match result {
            // The task may have ended between the timeout and the store, without a repaint.
            Err(RecvTimeoutError::Timeout) => self.result.recv_timeout(Duration::ZERO),
            result => result,
        };
        match result {
            Ok(result) => Some(Ok(result)),
            Err(RecvTimeoutError::Timeout) => None,
            Err(RecvTimeoutError::Disconnected) => Some(Err(panicked())),
        }
    }
}

fn panicked() -> UserError {
    UserError::new(
        WINDOW_ERROR,
        t("the operation was stopped by an internal error, or for want of threads"),
        t("Try again with a smaller selection, another render method, or fewer programs"),
    )
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::AtomicUsize;
    use std::time::Instant;

    use super::*;

    #[test]
    fn repaints_unless_awaited_and_loses_no_result() {
        let repaints = Arc::<AtomicUsize>::default();
        let counted = Arc::clone(&repaints);
        let repaint: RepaintHandle = Arc::new(move || {
            counted.fetch_add(1, Ordering::SeqCst);
        });
        let long = Duration::from_secs(60);
        let task = BackgroundTask::start(&repaint, || 7);
        assert_eq!(task.result_within(long), Some(Ok(7)));
        for round in 0..2_000_u64 {
            let before = repaints.load(Ordering::SeqCst);
            let task = BackgroundTask::start(&repaint, move || round);
            let mut result = task.result_within(Duration::from_micros(round % 64));
            let since = Instant::now();
            while result.is_none() && since.elapsed() < long {
                // As the window does, look again only after a repaint.
                if repaints.load(Ordering::SeqCst) > before {
                    result = task.result();
                }
            }
            assert_eq!(result, Some(Ok(round)));
        }
    }

    #[test]
    fn reports_a_panic_as_error() {
        let repaint: RepaintHandle = Arc::new(|| {});
        // Unlike `panic!`, this bypasses the hook by which the soak test counts panics.
        let panic = || std::panic::resume_unwind(Box::new("on purpose"));
        let task: BackgroundTask<()> = BackgroundTask::start(&repaint, panic);
        let result = task.result_within(Duration::from_secs(60));
        assert!(result.is_some_and(|result| result.is_err()));
    }
}
