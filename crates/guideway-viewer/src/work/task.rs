use std::sync::mpsc::{self, Receiver, RecvTimeoutError};
use std::thread;
use std::time::Duration;

use super::Wake;
use crate::host::Trouble;

/// Something that is done once, beside the window.
pub(crate) struct Task<T> {
    outcome: Receiver<T>,
}

impl<T: Send + 'static> Task<T> {
    pub(crate) fn start(wake: &Wake, work: impl FnOnce() -> T + Send + 'static) -> Self {
        let (sender, outcome) = mpsc::channel();
        let wake = wake.clone();
        thread::spawn(move || {
            // Nobody hears it if the question was dropped in the meantime.
            let _ = sender.send(work());
            wake();
        });
        Self { outcome }
    }

    /// What came of it, once it is done.
    ///
    /// # Errors
    /// When it broke down.
    pub(crate) fn outcome(&self) -> Option<Result<T, Trouble>> {
        self.outcome_within(Duration::ZERO)
    }

    /// What came of it, if it is done within so long.
    ///
    /// # Errors
    /// When it broke down.
    pub(crate) fn outcome_within(&self, patience: Duration) -> Option<Result<T, Trouble>> {
        match self.outcome.recv_timeout(patience) {
            Ok(outcome) => Some(Ok(outcome)),
            Err(RecvTimeoutError::Timeout) => None,
            Err(RecvTimeoutError::Disconnected) => Some(Err(Trouble {
                message: "what was asked for came to no end".into(),
                remedy: "Try again, with less or by another way".into(),
            })),
        }
    }
}
