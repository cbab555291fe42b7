//! Redraws the window after a delay, such as that of a tooltip.

use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

/// The next time at which to redraw, shared with the thread that waits for it.
#[derive(Clone)]
pub(crate) struct RedrawTimer(Arc<(Mutex<Option<Instant>>, Condvar)>);

impl RedrawTimer {
    /// Starts the thread, which calls `redraw`. Without a thread nothing is redrawn by time.
    pub(crate) fn start(redraw: impl Fn() + Send + 'static) -> Self {
        let timer = Self(Arc::default());
        let waiting = timer.clone();
        let _ = thread::Builder::new().spawn(move || {
            loop {
                waiting.wait();
                redraw();
            }
        });
        timer
    }

    /// Redraws after `delay`, or sooner if that was asked for since the last [`Self::clear`].
    pub(crate) fn after(&self, delay: Duration) {
        // A delay without an end is no request.
        let Some(at) = Instant::now().checked_add(delay) else {
            return;
        };
        let (next, changed) = &*self.0;
        let mut next = next.lock().unwrap_or_else(PoisonError::into_inner);
        if next.is_none_or(|next| at < next) {
            *next = Some(at);
            changed.notify_one();
        }
    }

    /// Forgets all delays: a frame is being shown, whose parts ask anew.
    pub(crate) fn clear(&self) {
        let (next, _) = &*self.0;
        *next.lock().unwrap_or_else(PoisonError::into_inner) = None;
    }

    /// Blocks until the next time has come.
    fn wait(&self) {
        let (next, changed) = &*self.0;
        let mut next = next.lock().unwrap_or_else(PoisonError::into_inner);
        loop {
            let now = Instant::now();
            next = match *next {
                Some(at) if at <= now => {
                    *next = None;
                    return;
                }
                Some(at) => {
                    let waited = changed.wait_timeout(next, at - now);
                    waited.unwrap_or_else(PoisonError::into_inner).0
                }
                None => changed.wait(next).unwrap_or_else(PoisonError::into_inner),
            };
        }
    }
}

#[cfg(test)]
mod tests {
    use std::sync::mpsc;

    use super::*;

    #[test]
    fn redraws_once_at_the_earliest_delay_unless_cleared() {
        let (sender, redrawn) = mpsc::channel();
        let timer = RedrawTimer::start(move || {
            let _ = sender.send(());
        });
        timer.after(Duration::MAX);
        timer.after(Duration::from_secs(600));
        timer.after(Duration::from_millis(1));
        redrawn.recv_timeout(Duration::from_secs(60)).unwrap();
        timer.after(Duration::from_millis(300));
        timer.clear();
        let wait = Duration::from_millis(600);
        assert!(redrawn.recv_timeout(wait).is_err());
    }
}
