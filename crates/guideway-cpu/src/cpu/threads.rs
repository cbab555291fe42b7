//! What each thread has for itself.

use std::sync::{Mutex, MutexGuard, PoisonError};

/// What the calling thread has, of one for each.
///
/// # Panics
/// Where there is none.
pub(super) fn own<T>(of_threads: &[Mutex<T>]) -> MutexGuard<'_, T> {
    let thread = rayon::current_thread_index().unwrap_or(0);
    locked(&of_threads[thread % of_threads.len()])
}

/// A sum over all threads.
pub(super) fn sum<T>(of_threads: &[Mutex<T>], of_one: impl Fn(&T) -> u64) -> u64 {
    of_threads.iter().map(|one| of_one(&locked(one))).sum()
}

fn locked<T>(one: &Mutex<T>) -> MutexGuard<'_, T> {
    one.lock().unwrap_or_else(PoisonError::into_inner)
}
