//! The table of paths.
//!
//! | file | defines |
//! |---|---|
//! | `table` | the columns, and how a path is appended and read |
//! | `path_ref` | one path with its curve and properties |
//! | `edit` | changes of columns and single paths |
//! | `rows` | selections of rows, and joined tables |

mod edit;
mod path_ref;
mod rows;
mod table;

pub use self::path_ref::PathRef;
pub use self::table::Paths;
