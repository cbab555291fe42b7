//! Statistics of attribute columns: counts, range and most frequent values.

use std::collections::HashMap;
use std::hash::Hash;

use guideway::layout::{Attribute, Attributes, Values};
use rayon::prelude::*;
use serde::Serialize;

use crate::cli::text::number;

/// Values listed per column.
const TOP: usize = 5;

/// Statistics of a column.
#[derive(Debug, Serialize)]
pub(super) struct Column {
    pub(super) name: String,
    #[serde(rename = "type")]
    pub(super) kind: &'static str,
    /// Rows with a value.
    pub(super) values: u64,
    /// Rows without a value.
    pub(super) missing: u64,
    /// Distinct values.
    pub(super) distinct: u64,
    /// Minimum of the finite numbers.
    pub(super) min: Option<f64>,
    /// Maximum of the finite numbers.
    pub(super) max: Option<f64>,
    /// The most frequent values, the most frequent first; empty if every value is unique.
    pub(super) top: Vec<FrequentValue>,
}

/// A value with the number of its rows.
#[derive(Debug, Serialize)]
pub(super) struct FrequentValue {
    pub(super) value: String,
    pub(super) count: u64,
}

pub(super) fn of_table(attributes: &Attributes, rows: usize) -> Vec<Column> {
    let columns: Vec<&Attribute> = attributes.iter().collect();
    columns
        .into_par_iter()
        .map(|c| of(c, rows as u64))
        .collect()
}

fn of(attribute: &Attribute, rows: u64) -> Column {
    let mut column = match &attribute.values {
        Values::Bool(v) => tally("yes/no", v.values(), bool::to_string),
        Values::Int(v) => Column {
            min: v.values().min().map(|n| n as f64),
            max: v.values().max().map(|n| n as f64),
            ..tally("whole number", v.values(), i64::to_string)
        },
        Values::Float(v) => {
            let finite = || v.values().filter(|n| n.is_finite());
            // Zero and minus zero count as one value.
            let bits = v.values().map(|n| (n + 0.0).to_bits());
            Column {
                min: finite().reduce(f64::min),
                max: finite().reduce(f64::max),
                ..tally("number", bits, |&b| number(f64::from_bits(b)))
            }
        }
        Values::Text(v) => tally("text", v.iter().flatten(), |text| (*text).to_owned()),
        Values::Json(v) => tally("JSON", v.iter().flatten(), |text| (*text).to_owned()),
    };
    column.name.clone_from(&attribute.name);
    column.missing = rows.saturating_sub(column.values);
    column
}

fn tally<T: Eq + Hash + Ord>(
    kind: &'static str,
    values: impl Iterator<Item = T>,
    shown: impl Fn(&T) -> String,
) -> Column {
    let mut counts: HashMap<T, u64> = HashMap::new();
    for value in values {
        *counts.entry(value).or_insert(0) += 1;
    }
    let total = counts.values().sum();
    let distinct = counts.len() as u64;
    let mut top: Vec<(T, u64)> = counts.into_iter().collect();
    let order = |a: &(T, u64), b: &(T, u64)| b.1.cmp(&a.1).then_with(|| a.0.cmp(&b.0));
    if top.len() > TOP {
        top.select_nth_unstable_by(TOP, order);
        top.truncate(TOP);
    }
    top.sort_by(order);
    top.retain(|(_, count)| *count > 1 || distinct <= TOP as u64);
    Column {
        name: String::new(),
        kind,
        values: total,
        missing: 0,
        distinct,
        min: None,
        max: None,
        top: top
            .iter()
            .map(|(value, count)| FrequentValue {
                value: shown(value),
                count: *count,
            })
            .collect(),
    }
}

#[cfg(test)]
mod tests {
    use guideway::layout::Value;

    use super::*;

    #[test]
    fn counts_values_and_finds_their_range() {
        let mut attributes = Attributes::default();
        for (row, speed) in [1.5, 0.5, 1.5, -0.0, 0.0].into_iter().enumerate() {
            attributes.set(row, "speed", Value::Float(speed));
        }
        for row in 0..20 {
            attributes.set(row, "name", Value::Text(&format!("n{row}")));
        }
        let columns = of_table(&attributes, 20);
        let speed = &columns[0];
        assert_eq!((speed.values, speed.missing, speed.distinct), (5, 15, 3));
        assert_eq!((speed.min, speed.max), (Some(0.0), Some(1.5)));
        assert_eq!((speed.top[0].value.as_str(), speed.top[0].count), ("0", 2));
        assert_eq!(columns[1].distinct, 20);
        assert!(columns[1].top.is_empty());
    }
}
