//! The part of [rayon](https://docs.rs/rayon)'s interface that Guideway uses, on the thread that
//! calls.
//!
//! An engine for browsers without threads has nobody to share its work with, and rayon's own code
//! is a fourteenth of it. There the crates of Guideway depend on this one by the name `rayon`. A
//! call does what rayon's call of the same name does with one thread: parts run one after the
//! other, in their order.
//!
//! | module | content |
//! |---|---|
//! | [`iter`] | iterators with the methods of rayon's |
//! | [`slice`] | chunks, windows and sorting |
//! | `pool` | a pool that no system gives |

pub mod iter;
mod pool;
pub mod slice;

pub use pool::{ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder};

/// All traits.
pub mod prelude {
    pub use crate::iter::{
        IntoParallelIterator, IntoParallelRefIterator, IntoParallelRefMutIterator, ParallelExtend,
        ParallelIterator,
    };
    pub use crate::slice::{ParallelSlice, ParallelSliceMut};
}

/// Tells if [`yield_now`] found work.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Yield {
    /// It ran a task.
    Executed,
    /// There was none.
    Idle,
}

/// Runs two tasks, the first one first.
pub fn join<A, B>(first: impl FnOnce() -> A, second: impl FnOnce() -> B) -> (A, B) {
    (first(), second())
}

/// Runs a task that may begin others, of which there are none here.
pub fn scope<R>(task: impl FnOnce(()) -> R) -> R {
    task(())
}

/// Tasks never wait, so there is none to run.
pub fn yield_now() -> Option<Yield> {
    None
}

/// The number of threads.
pub fn current_num_threads() -> usize {
    1
}

/// The calling thread is none of a pool.
pub fn current_thread_index() -> Option<usize> {
    None
}
