//! The table of paths.
//!
//! | file | defines |
//! |---|---|
//! | `table` | the columns, and how a path is appended and read |
//! | `edit` | changes of columns and single paths |
//! | `rows` | selections of rows, and joined tables |

mod edit;
mod rows;
mod table;

pub use self::table::{PathRef, Paths};
