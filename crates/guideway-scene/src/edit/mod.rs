//! Edits of a scene. An edit costs time proportional to what it touches, plus one pass over the
//! rows where the draw order changes.
//!
//! | file | input | output |
//! |---|---|---|
//! | `operation` | | [`Edit`], [`Insertion`]: edits as data |
//! | `check` | edit, scene | accepts the edit or returns an [`EditError`] |
//! | `apply` | checked edit, scene | the changed scene and the inverse edit |
//! | `gesture` | paths, a map | [`Gesture`]: what an edit would leave, shown before it |
//! | `tables` | | the same for what no picture shows: [`TableEdit`] |

mod apply;
mod check;
mod error;
mod gesture;
mod operation;
mod tables;

pub use error::EditError;
pub use gesture::{Gesture, GesturePaths};
pub use operation::{Edit, Insertion};
pub use tables::{NewNode, NewStation, TableEdit};
