//! Edits of a document.
//!
//! | file | input | output |
//! |---|---|---|
//! | `operations`, `points` | selection, positions | [`Change`](crate::Change)s |
//! | `curves` | control points | new control points |
//! | `perform` | changes | the changed document and an undoable step |

mod curves;
mod operations;
mod perform;
mod points;

pub use operations::drawn_path;
pub use points::PointRef;
