//! A thread that owns a value which cannot leave it, such as an OpenGL context.
//!
//! Input: closures. Output: their results, sent back to the caller.

use std::sync::mpsc::{Sender, channel, sync_channel};
use std::thread::{self, JoinHandle};

type Job<T> = Box<dyn FnOnce(&mut T) + Send>;

/// A thread that owns a value. Callers send work to it, and keep their own OpenGL context.
pub(crate) struct Worker<T> {
    /// `None` once the worker is being dropped.
    jobs: Option<Sender<Job<T>>>,
    thread: Option<JoinHandle<()>>,
}

impl<T: 'static> Worker<T> {
    /// Starts a thread and makes its value there. Returns `None` when the thread does not start or
    /// `make` panics.
    pub(crate) fn start<R, E>(
        make: impl FnOnce() -> Result<(T, R), E> + Send + 'static,
    ) -> Option<Result<(Self, R), E>>
    where
        R: Send + 'static,
        E: Send + 'static,
    {
        let (jobs, queue) = channel::<Job<T>>();
        let (made, outcome) = sync_channel(1);
        let work = move || {
            let mut value = match make() {
                Ok((value, extra)) => {
                    let _ = made.send(Ok(extra));
                    value
                }
                Err(error) => {
                    let _ = made.send(Err(error));
                    return;
                }
            };
            for job in queue {
                job(&mut value);
            }
        };
        let thread = thread::Builder::new().name("opengl".to_owned()).spawn(work);
        let worker = Self {
            jobs: Some(jobs),
            thread: Some(thread.ok()?),
        };
        Some(outcome.recv().ok()?.map(|extra| (worker, extra)))
    }

    /// Runs `work` on the thread and waits for it. Returns `None` when this or earlier work
    /// panicked.
    pub(crate) fn call<R: Send + 'static>(
        &self,
        work: impl FnOnce(&mut T) -> R + Send + 'static,
    ) -> Option<R> {
        let (done, outcome) = sync_channel(1);
        let job = move |value: &mut T| {
            let _ = done.send(work(value));
        };
        self.jobs.as_ref()?.send(Box::new(job)).ok()?;
        outcome.recv().ok()
    }
}

impl<T> Drop for Worker<T> {
    fn drop(&mut self) {
        self.jobs = None;
        if let Some(thread) = self.thread.take() {
            // The last call already reported a panic.
            let _ = thread.join();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_all_work_on_the_same_other_thread() {
        let here = thread::current().id();
        let make = || Ok::<_, ()>((thread::current().id(), ()));
        let (worker, ()) = Worker::start(make).unwrap().unwrap();
        let same = worker.call(|home| *home == thread::current().id());
        assert_eq!(same, Some(true));
        assert_eq!(worker.call(move |home| *home != here), Some(true));
    }

    #[test]
    fn returns_errors_and_panics_to_the_caller() {
        let outcome = Worker::<()>::start(|| Err::<((), ()), _>("no")).unwrap();
        assert_eq!(outcome.err(), Some("no"));
        let (worker, ()) = Worker::start(|| Ok::<_, ()>((7, ()))).unwrap().unwrap();
        assert_eq!(worker.call(|_| panic!("a panic for the test")), None::<()>);
        assert_eq!(worker.call(|n| *n), None);
    }
}
