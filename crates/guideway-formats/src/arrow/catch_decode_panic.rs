//! Panic guard around the Arrow library: converts a panic on damaged bytes to a problem.

use std::panic::{AssertUnwindSafe, catch_unwind};

use super::problems::damaged;
use crate::Problem;

/// Runs a part of the Arrow library over untrusted bytes.
///
/// The library checks most of its input, and the checks here cover what it is known to trust. If it
/// panics nevertheless, the file is refused as damaged. No other place catches a panic; after one,
/// nothing that the closure changed is used.
pub(super) fn catch_decode_panic<T>(
    place: &str,
    run: impl FnOnce() -> Result<T, Problem>,
) -> Result<T, Problem> {
    catch_unwind(AssertUnwindSafe(run)).unwrap_or_else(|_| {
        Err(damaged(
            place,
            "the Arrow library cannot decode its content",
        ))
    })
}
