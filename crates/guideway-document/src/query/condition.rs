//! Condition tree of a query, and its evaluation for an element.

use std::cmp::Ordering;

use guideway_layout::{Layout, Value};
use guideway_scene::Table;

use super::column::Column;

/// A node of the condition tree.
#[derive(Clone, Debug)]
pub(super) enum Condition {
    All(Vec<Self>),
    Any(Vec<Self>),
    Not(Box<Self>),
    Compare(Comparison),
}

/// A comparison of a column with a constant.
#[derive(Clone, Debug)]
pub(super) struct Comparison {
    pub(super) column: Column,
    pub(super) operator: Operator,
    pub(super) text: String,
    /// `text` as a number, if it is one.
    pub(super) number: Option<f64>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Operator {
    Equal,
    NotEqual,
    Less,
    AtMost,
    Greater,
    AtLeast,
    Contains,
}

impl Condition {
    /// Returns `true` if an element fulfills the condition.
    pub(super) fn holds(&self, layout: &Layout, of: Table, row: u32) -> bool {
        match self {
            Self::All(parts) => parts.iter().all(|part| part.holds(layout, of, row)),
            Self::Any(parts) => parts.iter().any(|part| part.holds(layout, of, row)),
            Self::Not(part) => !part.holds(layout, of, row),
            Self::Compare(comparison) => comparison.holds(layout, of, row),
        }
    }
}

impl Comparison {
    fn holds(&self, layout: &Layout, of: Table, row: u32) -> bool {
        if let (Column::VehicleType, Some(entries)) = (&self.column, of.entries(layout)) {
            return self.holds_for_types(entries.of(row as usize));
        }
        let result = self
            .column
            .with_value(layout, of, row, |value| self.holds_for(value));
        result.unwrap_or(self.operator == Operator::NotEqual)
    }

    /// An element has any number of vehicle types; one that fulfills the comparison is enough.
    fn holds_for_types<'a>(&self, mut types: impl Iterator<Item = &'a str>) -> bool {
        if self.operator == Operator::NotEqual {
            return types.all(|name| name != self.text);
        }
        types.any(|name| self.holds_for(Value::Text(name)))
    }

    fn holds_for(&self, value: Value<'_>) -> bool {
        let order = || match (value.number(), self.number, value) {
            (Some(left), Some(right), _) => left.partial_cmp(&right),
            (_, _, Value::Text(left)) => Some(left.cmp(&self.text)),
            _ => Some(value.to_string().cmp(&self.text)),
        };
        match self.operator {
            Operator::Equal => order() == Some(Ordering::Equal),
            Operator::NotEqual => order() != Some(Ordering::Equal),
            Operator::Less => order() == Some(Ordering::Less),
            Operator::AtMost => order().is_some_and(Ordering::is_le),
            Operator::Greater => order() == Some(Ordering::Greater),
            Operator::AtLeast => order().is_some_and(Ordering::is_ge),
            Operator::Contains => {
                let value = value.to_string().to_lowercase();
                value.contains(&self.text.to_lowercase())
            }
        }
    }
}
