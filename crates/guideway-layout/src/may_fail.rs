//! Marks allocations whose failure the caller handles.

use std::cell::Cell;
use std::collections::TryReserveError;

thread_local! {
    static MAY_FAIL: Cell<bool> = const { Cell::new(false) };
}

/// Returns `true` while [`try_reserve`] runs on this thread. An allocator that ends the process
/// where there is no memory lets that allocation fail instead.
pub fn may_fail() -> bool {
    MAY_FAIL.get()
}

/// Reserves room for more items.
///
/// # Errors
/// When there is not enough memory.
pub fn try_reserve<T>(items: &mut Vec<T>, more: usize) -> Result<(), TryReserveError> {
    MAY_FAIL.set(true);
    let reserved = items.try_reserve_exact(more);
    MAY_FAIL.set(false);
    reserved
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_reservation_may_fail() {
        let mut items: Vec<u8> = Vec::new();
        assert!(!may_fail() && try_reserve(&mut items, 10).is_ok());
        assert!(try_reserve(&mut items, usize::MAX).is_err() && !may_fail());
    }
}
