//! Edits of a scene. An edit costs time proportional to what it touches, plus one pass over the
//! rows where the draw order changes.
//!
//! | file | input | output |
//! |---|---|---|
//! | `operation` | | [`Edit`], [`Insertion`]: edits as data |
//! | `check` | edit, scene | accepts the edit or returns an [`EditError`] |
//! | `apply` | checked edit, scene | the changed scene and the inverse edit |
//! | `tables` | | the same for what no picture shows: [`TableEdit`] |

mod apply;
mod check;
mod error;
mod operation;
mod tables;

pub use error::EditError;
pub use operation::{Edit, Insertion};
pub use tables::{NewNode, NewStation, TableEdit};
