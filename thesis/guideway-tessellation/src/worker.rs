use std::sync::mpsc::{Sender, channel, sync_channel};
use std::thread::{self, JoinHandle};

type Job<T> = Box<dyn FnOnce(&mut T) + Send>;

/// A thread with a value that cannot leave it, such as whatever belongs to an OpenGL context. Work is sent
/// there; the threads that ask keep their own context, if they have one.
pub(crate) struct Worker<T> {
    /// None while it ends.
    jobs: Option<Sender<Job<T>>>,
    thread: Option<JoinHandle<()>>,
}

impl<T: 'static> Worker<T> {
    /// Starts a thread and makes its value there; none if the thread does not start or `make` panics.
    pub(crate) fn start<R, E>(
        make: impl FnOnce() -> Result<(T, R), E> + Send + 'static,
    ) -> Option<Result<(Self, R), E>>
    where
        R: Send + 'static,
        E: Send + 'static,
    {
        let (jobs, to_do) = channel::<Job<T>>();
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
            for job in to_do {
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

    /// Does `work` there and waits for it; none if it panicked, now or earlier.
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
            // If it panicked, that was told when it was last called.
            let _ = thread.join();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn work_is_done_on_one_other_thread() {
        let here = thread::current().id();
        let make = || Ok::<_, String>((thread::current().id(), ()));
        let (worker, ()) = Worker::start(make).unwrap().unwrap();
        let same = worker.call(|home| *home == thread::current().id());
        assert_eq!(same, Some(true));
        assert_eq!(worker.call(move |home| *home != here), Some(true));
    }

    #[test]
    fn failures_and_panics_come_back() {
        let refused = Worker::<()>::start(|| Err::<((), ()), _>("no")).unwrap();
        assert_eq!(refused.err(), Some("no"));
        let (worker, ()) = Worker::start(|| Ok::<_, String>((7, ()))).unwrap().unwrap();
        assert_eq!(worker.call(|_| panic!("a panic for the test")), None::<()>);
        assert_eq!(worker.call(|n| *n), None);
    }
}
