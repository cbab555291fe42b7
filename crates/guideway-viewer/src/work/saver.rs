use std::sync::mpsc::{self, Receiver};
use std::thread;

use super::Wake;
use crate::host::Trouble;

/// Something being written beside the window. Says what was done, in a sentence.
pub(crate) struct Saver {
    outcome: Receiver<Result<String, Trouble>>,
}

impl Saver {
    pub(crate) fn start(
        wake: Wake,
        work: impl FnOnce() -> Result<String, Trouble> + Send + 'static,
    ) -> Self {
        let (sender, outcome) = mpsc::channel();
        thread::spawn(move || {
            // Nobody hears it if the window was closed in the meantime.
            let _ = sender.send(work());
            wake();
        });
        Self { outcome }
    }

    /// What came of it, once it is done.
    pub(crate) fn outcome(&self) -> Option<Result<String, Trouble>> {
        match self.outcome.try_recv() {
            Ok(outcome) => Some(outcome),
            Err(mpsc::TryRecvError::Empty) => None,
            Err(mpsc::TryRecvError::Disconnected) => Some(Err(Trouble {
                message: "what was being written came to no end".into(),
                remedy: "Try again, or save to another place".into(),
            })),
        }
    }
}
