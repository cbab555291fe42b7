//! Panic guard around the Arrow library: converts a panic on damaged bytes to a problem.

#[cfg(panic = "abort")]
use std::cell::Cell;
use std::panic::{AssertUnwindSafe, catch_unwind};

use super::problems::damaged;
use crate::Problem;
#[cfg(panic = "abort")]
use crate::ReadError;

/// Runs a part of the Arrow library over untrusted bytes.
///
/// The library checks most of its input, and the checks here cover what it is known to trust. If it
/// panics nevertheless, the file is refused as damaged. No other place catches a panic; after one,
/// nothing that the closure changed is used.
pub(super) fn catch_decode_panic<T>(
    place: &str,
    run: impl FnOnce() -> Result<T, Problem>,
) -> Result<T, Problem> {
    #[cfg(panic = "abort")]
    let outer = IS_DECODING.replace(true);
    let outcome = catch_unwind(AssertUnwindSafe(run));
    #[cfg(panic = "abort")]
    IS_DECODING.set(outer);
    outcome.unwrap_or_else(|_| Err(undecodable(place)))
}

fn undecodable(place: &str) -> Problem {
    damaged(place, "the Arrow library cannot decode its content")
}

#[cfg(panic = "abort")]
thread_local! {
    static IS_DECODING: Cell<bool> = const { Cell::new(false) };
}

/// The error of a file if the library panics on this thread, for the hook of a program that cannot
/// unwind. `None` if other code panics.
#[cfg(panic = "abort")]
pub fn decode_panic() -> Option<ReadError> {
    let is_decoding = IS_DECODING.try_with(Cell::get).unwrap_or_default();
    is_decoding.then(|| ReadError::new("the Arrow file", undecodable("content")))
}
