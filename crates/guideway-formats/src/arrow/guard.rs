use std::panic::{AssertUnwindSafe, catch_unwind};

use guideway_layout::Place;

use crate::Problem;

/// Runs a part of the Arrow library over bytes that are not trusted.
///
/// The library checks most of what it reads, and the checks here cover what it is known to take on
/// trust. Should it panic all the same, the file is refused like any other damaged one. This is the
/// only place where a panic is caught; nothing that the closure changes is used after one.
pub(super) fn guarded<T>(
    place: &str,
    run: impl FnOnce() -> Result<T, Problem>,
) -> Result<T, Problem> {
    catch_unwind(AssertUnwindSafe(run))
        .unwrap_or_else(|_| Err(damaged(place, "the Arrow library gave up on its content")))
}

/// The problem of bytes that are not sound Arrow.
pub(super) fn damaged(place: impl Into<String>, detail: impl Into<String>) -> Problem {
    Problem::Damaged {
        place: Place::element(place),
        detail: detail.into(),
    }
}
