//! Constructors of the problems of Arrow files.

use guideway_layout::Place;

use crate::Problem;

/// Makes the problem of bytes that are not valid Arrow.
pub(super) fn damaged(place: impl Into<String>, detail: impl Into<String>) -> Problem {
    Problem::Damaged {
        place: Place::element(place),
        detail: detail.into(),
    }
}

/// Makes the problem of a table whose structure is not that of a layout.
pub(super) fn wrong_structure(place: &str, expected: &str, found: &str) -> Problem {
    Problem::Structure {
        place: Place::element(place),
        expected: expected.into(),
        found: found.into(),
    }
}
