//! Lets Python handle signals, such as that of Ctrl-C, and receive progress while Rust works
//! without the interpreter's lock.

use std::sync::Mutex;
use std::time::{Duration, Instant};

use guideway::formats::Progress;
use pyo3::prelude::*;

/// Time between two looks at signals: short enough for a person, rare enough to cost nothing.
const EVERY: Duration = Duration::from_millis(50);

/// A progress observer that calls back into Python, and cancels when Python raises.
pub(crate) struct Watch {
    /// Receives the finished share, from 0 to 1.
    callback: Option<Py<PyAny>>,
    state: Mutex<State>,
}

struct State {
    last: Instant,
    raised: Option<PyErr>,
    share: f64,
}

impl Watch {
    pub(crate) fn new(callback: Option<Py<PyAny>>) -> Self {
        Self {
            callback,
            state: Mutex::new(State {
                last: Instant::now(),
                raised: None,
                share: 0.0,
            }),
        }
    }

    /// The exception that Python raised meanwhile, such as `KeyboardInterrupt`, else the result.
    pub(crate) fn result<T>(self, result: PyResult<T>) -> PyResult<T> {
        let state = self.state.into_inner().unwrap_or_else(|e| e.into_inner());
        match state.raised {
            Some(raised) => Err(raised),
            None => result,
        }
    }

    /// Returns whether to stop.
    fn look(&self) -> bool {
        // A thread that finds the state in use leaves the look to the one that holds it: waiting
        // here for a thread that waits for the interpreter would be a deadlock.
        let Ok(mut state) = self.state.try_lock() else {
            return false;
        };
        if state.raised.is_none() && state.last.elapsed() >= EVERY {
            let share = state.share;
            let looked = Python::attach(|py| {
                py.check_signals()?;
                match &self.callback {
                    Some(callback) => callback.call1(py, (share,)).map(drop),
                    None => Ok(()),
                }
            });
            state.raised = looked.err();
            state.last = Instant::now();
        }
        state.raised.is_some()
    }
}

impl Progress for Watch {
    fn advance(&self, done: u64, total: u64) {
        if let Ok(mut state) = self.state.try_lock() {
            state.share = (done as f64 / total.max(1) as f64).min(1.0);
        }
    }

    fn cancelled(&self) -> bool {
        self.look()
    }
}
