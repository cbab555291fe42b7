//! Query language that selects paths, nodes or stations by their columns:
//! `maxSpeed > 1.5 and not level = "1"`.
//!
//! | file | input | output |
//! |---|---|---|
//! | `parse` | text, layout | condition tree, or an error with its position |
//! | `condition` | condition tree, element | true or false |
//! | `column` | column name, element | value, order of rows |
//! | `natural` | two texts | their order |

mod column;
mod condition;
mod natural;
mod parse;

use guideway_layout::Layout;
use guideway_scene::Table;

pub use self::column::Column;
use self::condition::Condition;
pub(crate) use self::natural::natural_order;
pub use self::parse::QueryError;
use crate::PathSet;

/// A condition on the paths, nodes or stations of one layout.
///
/// ```text
/// condition = term { "or" term }            term = factor { "and" factor }
/// factor    = "not" factor | "(" condition ")" | column operator value
/// operator  = "=" | "!=" | "<" | "<=" | ">" | ">=" | "~"
/// ```
///
/// A column is an attribute of the file, or `id`, `level`, `vehicle_type`; of paths `direction`,
/// `length_m`, `start_node`, `end_node`; of nodes and stations `x`, `y`; of stations `nodes`. `~`
/// tests whether the column's text contains the value, ignoring case. Quote names and values that
/// contain spaces. Numbers compare as numbers, everything else as text. An element without a value
/// fulfills only `!=`.
#[derive(Clone, Debug)]
pub struct Query {
    condition: Condition,
    of: Table,
}

impl Query {
    /// Parses a query about the paths of a layout.
    ///
    /// # Errors
    /// When the text does not follow the grammar or names an unknown column.
    pub fn parse(text: &str, layout: &Layout) -> Result<Self, QueryError> {
        Self::parse_for(text, layout, Table::Paths)
    }

    /// Parses a query about the elements of a table.
    ///
    /// # Errors
    /// When the text does not follow the grammar or names an unknown column.
    pub fn parse_for(text: &str, layout: &Layout, of: Table) -> Result<Self, QueryError> {
        let condition = parse::parse(text, layout, of)?;
        Ok(Self { condition, of })
    }

    /// Rows of the elements that fulfill the condition.
    pub fn rows(&self, layout: &Layout) -> PathSet {
        let all = 0..self.of.row_count(layout) as u32;
        all.filter(|&row| self.condition.holds(layout, self.of, row))
            .collect()
    }
}
