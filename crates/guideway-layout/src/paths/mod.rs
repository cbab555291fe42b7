//! The table of paths.
//!
//! | file | defines |
//! |---|---|
//! | `table` | the columns, and how a path is appended and read |
//! | `edit` | changes of columns and single paths |
//! | `rows` | selections of rows, and joined tables |
//! | `samples` | points along a path |

mod edit;
mod rows;
mod samples;
mod table;

pub use self::samples::Sample;
pub use self::table::{PathRef, Paths};
