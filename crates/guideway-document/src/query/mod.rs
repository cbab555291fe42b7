//! Choosing paths by what is known of them: `maxSpeed > 1.5 and not level = "1"`.

mod column;
mod parse;

use std::cmp::Ordering;

use guideway_layout::{Layout, Value};

use self::column::Column;
use crate::PathSet;

/// A condition on the paths of one layout.
///
/// ```text
/// condition = term { "or" term }            term = factor { "and" factor }
/// factor    = "not" factor | "(" condition ")" | column operator value
/// operator  = "=" | "!=" | "<" | "<=" | ">" | ">=" | "~"
/// ```
///
/// A column is `id`, `level`, `direction`, `vehicle_type`, `length_m` or an attribute of the file; `~` asks
/// whether its text contains the value, whatever the case. Names and values with spaces are put in quotes.
/// Numbers compare as numbers, anything else as text. A path without a value meets no comparison but `!=`.
#[derive(Clone, Debug)]
pub struct Query(Condition);

#[derive(Clone, Debug)]
enum Condition {
    All(Vec<Self>),
    Any(Vec<Self>),
    Not(Box<Self>),
    Is(Comparison),
}

#[derive(Clone, Debug)]
struct Comparison {
    column: Column,
    operator: Operator,
    text: String,
    number: Option<f64>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Operator {
    Equal,
    NotEqual,
    Less,
    AtMost,
    Greater,
    AtLeast,
    Contains,
}

/// Why a query cannot be understood.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("at character {at}: {what}")]
pub struct QueryError {
    /// Where, in characters from 1.
    pub at: usize,
    /// What is wrong, and what would do.
    pub what: String,
}

impl Query {
    /// Understands a query about the paths of a layout.
    ///
    /// # Errors
    /// When it does not follow the grammar or names a column that the layout has not.
    pub fn parse(text: &str, layout: &Layout) -> Result<Self, QueryError> {
        parse::parse(text, layout).map(Self)
    }

    /// The paths that meet it.
    pub fn rows(&self, layout: &Layout) -> PathSet {
        let all = 0..layout.paths.len() as u32;
        all.filter(|&path| self.0.holds(layout, path)).collect()
    }
}

impl Condition {
    fn holds(&self, layout: &Layout, path: u32) -> bool {
        match self {
            Self::All(parts) => parts.iter().all(|part| part.holds(layout, path)),
            Self::Any(parts) => parts.iter().any(|part| part.holds(layout, path)),
            Self::Not(part) => !part.holds(layout, path),
            Self::Is(comparison) => comparison.holds(layout, path),
        }
    }
}

impl Comparison {
    fn holds(&self, layout: &Layout, path: u32) -> bool {
        if let Column::VehicleType = self.column {
            return self.holds_for_types(layout.paths.vehicle_types().of(path as usize));
        }
        let held = self
            .column
            .with_value(layout, path, |value| self.holds_for(value));
        held.unwrap_or(self.operator == Operator::NotEqual)
    }

    /// A path has any number of vehicle types: one that meets the comparison is enough.
    fn holds_for_types<'a>(&self, mut types: impl Iterator<Item = &'a str>) -> bool {
        if self.operator == Operator::NotEqual {
            return types.all(|name| name != self.text);
        }
        types.any(|name| self.holds_for(Value::Text(name)))
    }

    fn holds_for(&self, value: Value<'_>) -> bool {
        if self.operator == Operator::Contains {
            let held = value.to_string().to_lowercase();
            return held.contains(&self.text.to_lowercase());
        }
        let number = match value {
            Value::Int(v) => Some(v as f64),
            Value::Float(v) => Some(v),
            Value::Bool(_) | Value::Text(_) => None,
        };
        let order = match (number, self.number, value) {
            (Some(held), Some(asked), _) => held.partial_cmp(&asked),
            (_, _, Value::Text(held)) => Some(held.cmp(&self.text)),
            _ => Some(value.to_string().cmp(&self.text)),
        };
        match self.operator {
            Operator::Equal => order == Some(Ordering::Equal),
            Operator::NotEqual => order != Some(Ordering::Equal),
            Operator::Less => order == Some(Ordering::Less),
            Operator::AtMost => order.is_some_and(Ordering::is_le),
            Operator::Greater => order == Some(Ordering::Greater),
            Operator::AtLeast => order.is_some_and(Ordering::is_ge),
            Operator::Contains => unreachable!("answered above"),
        }
    }
}
