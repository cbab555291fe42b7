//! Edits of the tables of a layout: identifiers, references, properties, nodes and stations. No
//! picture shows them.
//!
//! | file | input | output |
//! |---|---|---|
//! | `operation` | | [`TableEdit`] and its parts: edits as data |
//! | `check` | edit, scene | accepts the edit or returns an error |
//! | `inverse` | edit that is not applied yet, scene | the edit that reverts it |
//! | `apply` | checked edit, scene | the changed scene |

mod apply;
mod check;
mod inverse;
mod operation;

pub use operation::{NewNode, NewStation, TableEdit};
