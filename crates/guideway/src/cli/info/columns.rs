//! Statistics of attribute columns: counts, range, unit and most frequent values.

use std::borrow::Cow;
use std::collections::HashMap;
use std::hash::Hash;

use guideway::layout::{Attribute, Attributes, Quantity, TypeEntries, Value, Values};
use rayon::prelude::*;
use serde::Serialize;

use crate::cli::text::number;

/// Values listed per column.
const TOP: usize = 5;

/// Statistics of a column.
#[derive(Debug, Serialize)]
pub(super) struct Column {
    pub(super) name: String,
    /// Symbol of the SI unit of the numbers, if it is known.
    pub(super) unit: Option<&'static str>,
    #[serde(rename = "type")]
    pub(super) kind: &'static str,
    /// Rows with a value.
    pub(super) values: u64,
    /// Rows without a value.
    pub(super) missing: u64,
    /// Rows whose values differ between vehicle types.
    pub(super) per_type: u64,
    /// Distinct values, of all rows and vehicle types.
    pub(super) distinct: u64,
    /// Minimum of the finite numbers.
    pub(super) min: Option<f64>,
    /// Maximum of the finite numbers.
    pub(super) max: Option<f64>,
    /// The most frequent values, the most frequent first; empty if every value is unique. A row
    /// counts once for each vehicle type that has a value of its own.
    pub(super) top: Vec<FrequentValue>,
}

/// A value with the number of its rows.
#[derive(Debug, Serialize)]
pub(super) struct FrequentValue {
    pub(super) value: String,
    pub(super) count: u64,
}

impl Column {
    /// Name with the unit.
    pub(super) fn label(&self) -> String {
        match self.unit {
            Some(unit) => format!("{} ({unit})", self.name),
            None => self.name.clone(),
        }
    }
}

/// The columns of a table.
pub(super) fn of_table(attributes: &Attributes, rows: usize) -> Vec<Column> {
    let columns: Vec<&Attribute> = attributes.iter().collect();
    let statistics = |column: &Attribute| {
        let statistics = of(column, None);
        Column {
            missing: (rows as u64).saturating_sub(statistics.values),
            ..statistics
        }
    };
    columns.into_par_iter().map(statistics).collect()
}

/// The columns of a table whose elements have properties per vehicle type.
pub(super) fn of_typed(attributes: &Attributes, types: &TypeEntries) -> Vec<Column> {
    let only_per_type = types.attributes.iter();
    let only_per_type = only_per_type.filter(|column| attributes.get(&column.name).is_none());
    let columns: Vec<&Attribute> = attributes.iter().chain(only_per_type).collect();
    let statistics = |column: &Attribute| {
        let per_type = types.attributes.get(&column.name);
        let own = attributes.get(&column.name);
        let rows = 0..types.len();
        let has_entry = |row: usize| {
            let has_value = |entry| per_type.is_some_and(|c| c.values.get(entry).is_some());
            types.entries(row).any(has_value)
        };
        let has_own = |row: usize| own.is_some_and(|c| c.values.get(row).is_some());
        let count = |is_counted: &dyn Fn(usize) -> bool| {
            rows.clone().filter(|&row| is_counted(row)).count() as u64
        };
        let values = count(&|row| has_own(row) || has_entry(row));
        Column {
            values,
            missing: types.len() as u64 - values,
            per_type: per_type.map_or(0, |_| count(&has_entry)),
            ..of(column, per_type.filter(|_| own.is_some()))
        }
    };
    columns.into_par_iter().map(statistics).collect()
}

/// Statistics of the values of a column, and of another one with the same name.
fn of(column: &Attribute, other: Option<&Attribute>) -> Column {
    let quantity = other.and_then(|other| other.quantity);
    let statistics = match (&column.values, other.map(|other| &other.values)) {
        (Values::Bool(a), None) => tally("yes/no", a.values(), bool::to_string),
        (Values::Bool(a), Some(Values::Bool(b))) => {
            tally("yes/no", a.values().chain(b.values()), bool::to_string)
        }
        (Values::Int(a), None) => whole_numbers(|| a.values()),
        (Values::Int(a), Some(Values::Int(b))) => whole_numbers(|| a.values().chain(b.values())),
        (Values::Float(a), None) => numbers(|| a.values()),
        (Values::Float(a), Some(Values::Float(b))) => numbers(|| a.values().chain(b.values())),
        (Values::Json(a), None) => tally("JSON", a.iter().flatten(), |text| (*text).to_owned()),
        (a, b) => {
            let all = texts(a).chain(b.into_iter().flat_map(texts));
            tally("text", all, |text| text.clone().into_owned())
        }
    };
    Column {
        name: column.name.clone(),
        unit: column.quantity.or(quantity).map(Quantity::unit),
        ..statistics
    }
}

/// The values as texts, without copies of those that are texts.
fn texts(values: &Values) -> impl Iterator<Item = Cow<'_, str>> {
    let text = |value| match value {
        Value::Text(text) => Cow::Borrowed(text),
        other => Cow::Owned(other.to_string()),
    };
    (0..values.len()).filter_map(move |row| values.get(row).map(text))
}

fn whole_numbers<I: Iterator<Item = i64>>(values: impl Fn() -> I) -> Column {
    Column {
        min: values().min().map(|n| n as f64),
        max: values().max().map(|n| n as f64),
        ..tally("whole number", values(), i64::to_string)
    }
}

fn numbers<I: Iterator<Item = f64>>(values: impl Fn() -> I) -> Column {
    let finite = || values().filter(|n| n.is_finite());
    // Zero and minus zero count as one value.
    let bits = values().map(|n| (n + 0.0).to_bits());
    Column {
        min: finite().reduce(f64::min),
        max: finite().reduce(f64::max),
        ..tally("number", bits, |&b| number(f64::from_bits(b)))
    }
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
    let top = top.iter().map(|(value, count)| FrequentValue {
        value: shown(value),
        count: *count,
    });
    Column {
        name: String::new(),
        unit: None,
        kind,
        values: total,
        missing: 0,
        per_type: 0,
        distinct,
        min: None,
        max: None,
        top: top.collect(),
    }
}

#[cfg(test)]
mod tests {
    use guideway::layout::{NewPath, Paths};

    use super::*;

    #[test]
    fn counts_values_and_finds_their_range() {
        let mut attributes = Attributes::default();
        for (row, speed) in [1.5, 0.5, 1.5, -0.0, 0.0].into_iter().enumerate() {
            attributes.set_quantity(row, "speed", speed, Quantity::Speed);
        }
        for row in 0..20 {
            attributes.set(row, "name", Value::Text(&format!("n{row}")));
        }
        let columns = of_table(&attributes, 20);
        let speed = &columns[0];
        assert_eq!((speed.values, speed.missing, speed.distinct), (5, 15, 3));
        assert_eq!((speed.min, speed.max), (Some(0.0), Some(1.5)));
        assert_eq!((speed.top[0].value.as_str(), speed.top[0].count), ("0", 2));
        assert_eq!(
            (speed.unit, speed.label().as_str()),
            (Some("m/s"), "speed (m/s)")
        );
        assert_eq!((columns[1].distinct, columns[1].unit), (20, None));
        assert!(columns[1].top.is_empty());
    }

    #[test]
    fn columns_include_values_per_vehicle_type() {
        let mut paths = Paths::default();
        for types in [&["tug", "fork"][..], &["tug"], &["tug"]] {
            paths.push(&NewPath {
                vehicle_types: types,
                ..NewPath::default()
            });
        }
        paths.attributes.set(1, "maxSpeed", Value::Float(3.0));
        let per_type = &mut paths.vehicle_types_mut().attributes;
        for (entry, speed) in [(0, 1.0), (1, 2.0)] {
            per_type.set_quantity(entry, "maxSpeed", speed, Quantity::Speed);
            per_type.set(entry, "layer", Value::Int(7));
        }
        let columns = of_typed(&paths.attributes, paths.vehicle_types());
        let [speed, layer] = columns.as_slice() else {
            panic!("{columns:?}");
        };
        assert_eq!((speed.name.as_str(), speed.unit), ("maxSpeed", Some("m/s")));
        assert_eq!((speed.values, speed.missing, speed.per_type), (2, 1, 1));
        assert_eq!(
            (speed.distinct, speed.min, speed.max),
            (3, Some(1.0), Some(3.0))
        );
        assert_eq!((layer.values, layer.per_type, layer.distinct), (1, 1, 1));
    }
}
