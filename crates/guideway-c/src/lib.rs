//! The C interface: layouts and drawings behind opaque pointers. `include/guideway.h`, made by
//! cbindgen from this crate, is its reference.
//!
//! | module | input | output |
//! |---|---|---|
//! | `border` | a call of C | its result, or the status of its failure: errors and panics |
//! | `error` | failures | the last one per thread |
//! | `arguments` | pointers of C | texts, bytes and references of Rust, none of them NULL |
//! | `layout` | files, bytes | layouts, files, facts |
//! | `check` | a layout | findings, one call each |
//! | `route` | a layout, two places | the fastest route |
//! | `arrow` | layouts, Arrow C streams | Arrow C streams, layouts |
//! | `drawing` | a layout, views | pixels in memory of the caller, elements under a pointer |

#![expect(
    unsafe_code,
    reason = "callers in C hand over pointers, and find functions by their names"
)]
#![expect(
    clippy::missing_safety_doc,
    reason = "the head of the header has the rules, once for all functions"
)]

mod arguments;
mod arrow;
mod border;
mod check;
mod drawing;
mod error;
mod layout;
mod route;

pub use arrow::{guideway_layout_from_arrow, guideway_layout_to_arrow};
pub use border::GuidewayStatus;
pub use check::{
    GuidewayFinding, GuidewayFindingCallback, GuidewaySeverity, guideway_layout_check,
};
pub use drawing::{
    GuidewayDrawing, GuidewayElement, GuidewayElementKind, GuidewayReport, GuidewayView,
    guideway_drawing_fit, guideway_drawing_free, guideway_drawing_hit_test, guideway_drawing_new,
    guideway_drawing_render,
};
pub use error::{GuidewayError, guideway_last_error};
pub use layout::{
    GuidewayLayout, GuidewayWriteCallback, guideway_layout_free, guideway_layout_from_bytes,
    guideway_layout_info, guideway_layout_open, guideway_layout_save, guideway_layout_write,
    guideway_text_free, guideway_version,
};
pub use route::{GuidewayRouteOptions, guideway_layout_route};
