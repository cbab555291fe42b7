//! Pools of threads, of which there are none.

use std::convert::Infallible;
use std::fmt;

/// A pool of threads: there is none.
#[derive(Debug)]
pub struct ThreadPool(Infallible);

impl ThreadPool {
    /// Runs a task in the pool.
    pub fn install<R>(&self, _task: impl FnOnce() -> R) -> R {
        match self.0 {}
    }
}

/// Asks for a pool.
#[derive(Debug, Default)]
pub struct ThreadPoolBuilder(());

impl ThreadPoolBuilder {
    /// A pool of default size.
    pub fn new() -> Self {
        Self::default()
    }

    /// A pool of this many threads.
    #[must_use]
    pub fn num_threads(self, _count: usize) -> Self {
        self
    }

    /// Starts the threads.
    ///
    /// # Errors
    /// Always: the system has no threads.
    pub fn build(self) -> Result<ThreadPool, ThreadPoolBuildError> {
        Err(ThreadPoolBuildError(()))
    }
}

/// The system has no threads.
#[derive(Debug)]
pub struct ThreadPoolBuildError(());

impl fmt::Display for ThreadPoolBuildError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("the system has no threads")
    }
}

impl std::error::Error for ThreadPoolBuildError {}
