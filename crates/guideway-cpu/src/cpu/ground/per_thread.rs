//! One value per thread of the pool, without sharing.

use std::sync::{Mutex, MutexGuard, PoisonError};

/// The slot of the calling thread; `slots` holds one value per thread.
///
/// # Panics
/// If `slots` is empty.
pub(crate) fn thread_slot<T>(slots: &[Mutex<T>]) -> MutexGuard<'_, T> {
    let thread = rayon::current_thread_index().unwrap_or(0);
    locked(&slots[thread % slots.len()])
}

/// Sums a number over all slots.
pub(crate) fn sum<T>(slots: &[Mutex<T>], number: impl Fn(&T) -> u64) -> u64 {
    slots.iter().map(|slot| number(&locked(slot))).sum()
}

fn locked<T>(slot: &Mutex<T>) -> MutexGuard<'_, T> {
    slot.lock().unwrap_or_else(PoisonError::into_inner)
}
