//! The fields of a selection: what its elements have in common, column by column.

use std::collections::BTreeSet;

use guideway_document::PathSet;
use guideway_layout::{Attributes, Layout, Property, PropertyKind, TypeEntries, Value, Values};
use guideway_scene::Table;

use crate::units::shown_value;

/// Most elements whose values are compared: a field of more shows those of the first.
pub(super) const MAX_COMPARED: usize = 10_000;

/// The value of several elements.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Common {
    /// None of them has one.
    None,
    /// All have this one.
    Same(String),
    /// They differ.
    Several,
}

/// Kind of the values that a field takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::panels) enum FieldKind {
    Flag,
    Integer,
    Number,
    Text,
    Choice(&'static [&'static str]),
    Json,
}

/// One property of a selection.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Field {
    pub(super) name: String,
    /// Unit of its numbers.
    pub(super) unit: Option<&'static str>,
    pub(super) kind: FieldKind,
    /// The value for all vehicle types.
    pub(super) shared: Common,
    /// Vehicle types with values of their own.
    pub(super) per_type: Vec<(String, Common)>,
}

/// The properties that elements of a table have, in the order of the columns.
pub(super) fn fields(layout: &Layout, of: Table, rows: &PathSet) -> Vec<Field> {
    let rows: Vec<usize> = rows
        .iter()
        .take(MAX_COMPARED)
        .map(|row| row as usize)
        .collect();
    let (shared, entries) = (of.attributes(layout), of.entries(layout));
    let own = entries.map(|entries| &entries.attributes);
    let mut names: Vec<&str> = shared.iter().map(|column| &*column.name).collect();
    let more = own.into_iter().flat_map(Attributes::iter);
    names.extend(
        more.map(|column| &*column.name)
            .filter(|name| shared.get(name).is_none()),
    );
    let types = entries.map_or_else(Vec::new, |entries| types_of(entries, &rows));
    let field = |name: &str| {
        let column = shared.get(name).or_else(|| own?.get(name))?;
        let unit = column.quantity.map(|quantity| quantity.unit());
        let of_type = |vehicle_type: &String| {
            let values = rows.iter().filter_map(|&row| {
                let entry = entries?.entry_for(row, vehicle_type)?;
                Some(own?.value(entry, name))
            });
            let value = common(values, unit);
            (value != Common::None).then(|| (vehicle_type.clone(), value))
        };
        let field = Field {
            name: name.to_owned(),
            unit,
            kind: kind_of(name, &column.values),
            shared: common(rows.iter().map(|&row| shared.value(row, name)), unit),
            per_type: types.iter().filter_map(of_type).collect(),
        };
        (field.shared != Common::None || !field.per_type.is_empty()).then_some(field)
    };
    names.into_iter().filter_map(field).collect()
}

/// The vehicle types that elements have entries for, by name.
pub(super) fn types_of(entries: &TypeEntries, rows: &[usize]) -> Vec<String> {
    let types = rows.iter().flat_map(|&row| entries.of(row));
    let types: BTreeSet<&str> = types.collect();
    types.into_iter().map(str::to_owned).collect()
}

/// The value that all have, if they have the same, as it is shown.
pub(super) fn common<'a>(
    mut values: impl Iterator<Item = Option<Value<'a>>>,
    unit: Option<&str>,
) -> Common {
    let Some(first) = values.next() else {
        return Common::None;
    };
    match (first, values.all(|value| value == first)) {
        (_, false) => Common::Several,
        (None, true) => Common::None,
        (Some(value), true) => Common::Same(shown_value(value, unit)),
    }
}

/// Kind of the field of a column. A column may have another type than the known property of its
/// name; then the column decides.
pub(in crate::panels) fn kind_of(name: &str, values: &Values) -> FieldKind {
    let known = Property::named(name).map(|property| property.kind);
    match (values, known) {
        (Values::Bool(_), _) => FieldKind::Flag,
        (Values::Int(_), Some(PropertyKind::Number(_))) => FieldKind::Number,
        (Values::Int(_), _) => FieldKind::Integer,
        (Values::Float(_), _) => FieldKind::Number,
        (Values::Text(_), Some(PropertyKind::Choice(words))) => FieldKind::Choice(words),
        (Values::Text(_), _) => FieldKind::Text,
        (Values::Json(_), _) => FieldKind::Json,
    }
}

/// Kind of the field of a known property that no element has yet.
fn kind_of_property(property: &Property) -> FieldKind {
    match property.kind {
        PropertyKind::Number(_) => FieldKind::Number,
        PropertyKind::Integer => FieldKind::Integer,
        PropertyKind::Flag => FieldKind::Flag,
        PropertyKind::Text => FieldKind::Text,
        PropertyKind::Choice(words) => FieldKind::Choice(words),
        PropertyKind::List | PropertyKind::Json => FieldKind::Json,
    }
}

/// The field of a property without a value.
pub(super) fn empty_field(property: &Property) -> Field {
    Field {
        name: property.name.to_owned(),
        unit: property.quantity().map(|quantity| quantity.unit()),
        kind: kind_of_property(property),
        shared: Common::None,
        per_type: Vec::new(),
    }
}

#[cfg(test)]
mod tests {
    use guideway_layout::{NewPath, Quantity};

    use super::*;

    /// Two paths for two vehicle types; `tug` has a speed of its own at both.
    fn layout() -> Layout {
        let mut layout = Layout::default();
        for (row, speed) in [(0, 1.5), (1, 2.0)] {
            layout.paths.push(&NewPath {
                vehicle_types: &["tug", "fork"],
                ..NewPath::default()
            });
            let attributes = &mut layout.paths.attributes;
            attributes.set_quantity(row, "maxHeight", 2.5, Quantity::Length);
            attributes.set(row, "name", Value::Text(["a", "b"][row]));
            let types = layout.paths.vehicle_types_mut();
            let entry = types.entry_for(row, "tug").unwrap();
            types
                .attributes
                .set_quantity(entry, "maxSpeed", speed, Quantity::Speed);
        }
        layout
    }

    #[test]
    fn fields_have_units_and_values_in_common() {
        let layout = layout();
        let fields = fields(&layout, Table::Paths, &[0, 1].into_iter().collect());
        let names: Vec<&str> = fields.iter().map(|field| &*field.name).collect();
        assert_eq!(names, ["maxHeight", "name", "maxSpeed"]);
        assert_eq!(fields[0].shared, Common::Same("2.5".into()));
        assert_eq!(
            (fields[0].unit, fields[0].kind),
            (Some("m"), FieldKind::Number)
        );
        assert_eq!(fields[1].shared, Common::Several);
        assert_eq!(fields[2].shared, Common::None);
        assert_eq!(fields[2].per_type, [("tug".to_owned(), Common::Several)]);
    }

    #[test]
    fn single_element_has_one_value() {
        let layout = layout();
        let fields = fields(&layout, Table::Paths, &[1].into_iter().collect());
        assert_eq!(fields[1].shared, Common::Same("b".into()));
        let speed = ("tug".to_owned(), Common::Same("2".into()));
        assert_eq!(fields[2].per_type, [speed]);
    }
}
