//! The border between C and Rust: runs the work of a call, and makes of its errors and panics the
//! last error of the thread.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::ptr;

use guideway::layout::UserError;

use crate::error::remember;

/// The outcome of a call.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(C)]
#[must_use]
pub enum GuidewayStatus {
    /// It succeeded.
    Ok = 0,
    /// It failed: see `guideway_last_error`.
    Failed = 1,
}

/// Runs a call that returns a status.
pub(crate) fn status(work: impl FnOnce() -> Result<(), UserError>) -> GuidewayStatus {
    match guarded(work) {
        Some(()) => GuidewayStatus::Ok,
        None => GuidewayStatus::Failed,
    }
}

/// Runs a call that returns what the caller owns; NULL when it fails.
pub(crate) fn owned<T>(work: impl FnOnce() -> Result<T, UserError>) -> *mut T {
    guarded(work).map_or(ptr::null_mut(), |made| Box::into_raw(Box::new(made)))
}

/// Runs a call; `None` when it fails.
pub(crate) fn guarded<T>(work: impl FnOnce() -> Result<T, UserError>) -> Option<T> {
    // A layout never changes, and a drawing is prepared anew after a panic: nothing half-done is
    // seen later.
    let outcome = catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(|panic| Err(fault(&*panic)));
    outcome.map_err(remember).ok()
}

fn fault(panic: &(dyn Any + Send)) -> UserError {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    let text = text.or_else(|| panic.downcast_ref::<&str>().copied());
    let text = text.unwrap_or("it left no message");
    UserError::new(
        "internal",
        format!("a fault in Guideway stopped the call: {text}"),
        "Report it with the file and the call",
    )
}

#[cfg(test)]
mod tests {
    use std::ffi::CStr;

    use super::*;
    use crate::error::guideway_last_error;

    #[test]
    fn a_panic_is_an_error_of_its_thread() {
        assert_eq!(status(|| panic!("row {}", 7)), GuidewayStatus::Failed);
        let last = guideway_last_error();
        // SAFETY: a call failed on this thread, and none did since.
        let message = unsafe { CStr::from_ptr((*last).message) };
        assert!(message.to_string_lossy().ends_with("call: row 7"));
        let other = std::thread::spawn(|| guideway_last_error().is_null());
        assert!(other.join().is_ok_and(|is_null| is_null));
    }
}
