//! Query language that selects paths by their columns: `maxSpeed > 1.5 and not level = "1"`.
//!
//! | file | input | output |
//! |---|---|---|
//! | `parse` | text, layout | condition tree, or an error with its position |
//! | `condition` | condition tree, path | true or false |
//! | `column` | column name, path | value |

mod column;
mod condition;
mod error;
mod parse;

use guideway_layout::Layout;

use self::condition::Condition;
pub use self::error::QueryError;
use crate::PathSet;

/// A condition on the paths of one layout.
///
/// ```text
/// condition = term { "or" term }            term = factor { "and" factor }
/// factor    = "not" factor | "(" condition ")" | column operator value
/// operator  = "=" | "!=" | "<" | "<=" | ">" | ">=" | "~"
/// ```
///
/// A column is `id`, `level`, `direction`, `vehicle_type`, `length_m` or an attribute of the file.
/// `~` tests whether the column's text contains the value, ignoring case. Quote names and values
/// that contain spaces. Numbers compare as numbers, everything else as text. A path without a value
/// fulfills only `!=`.
#[derive(Clone, Debug)]
pub struct Query(Condition);

impl Query {
    /// Parses a query about the paths of a layout.
    ///
    /// # Errors
    /// When the text does not follow the grammar or names an unknown column.
    pub fn parse(text: &str, layout: &Layout) -> Result<Self, QueryError> {
        parse::parse(text, layout).map(Self)
    }

    /// Rows of the paths that fulfill the condition.
    pub fn rows(&self, layout: &Layout) -> PathSet {
        let all = 0..layout.paths.len() as u32;
        all.filter(|&path| self.0.holds(layout, path)).collect()
    }
}
