//! Values of properties: whether a property takes a value, and in which type and unit.

use guideway_layout::{
    Attribute, Attributes, ElementKind, Property, PropertyKind, Quantity, Value, Values,
};
use guideway_scene::Table;

use super::error::OperationError;

/// The value as the property stores it, and the quantity of its column.
///
/// # Errors
/// When elements of the kind do not have the property, or it takes other values.
pub(super) fn accepted<'a>(
    of: ElementKind,
    name: &str,
    column: Option<&Attribute>,
    value: Option<Value<'a>>,
) -> Result<(Option<Value<'a>>, Option<Quantity>), OperationError> {
    let wrong = |expected: String, value: Value<'_>| OperationError::WrongValue {
        property: name.to_owned(),
        expected,
        value: value.to_string(),
    };
    let known = Property::named(name);
    if let (Some(property), None) = (known, column)
        && !property.of.contains(&of)
    {
        return Err(OperationError::WrongElement {
            property: name.to_owned(),
            what: kind_name(of),
            of: element_names(property.of),
        });
    }
    let quantity = known.and_then(Property::quantity);
    let Some(value) = value else {
        return Ok((None, column.map_or(quantity, |column| column.quantity)));
    };
    // The column of a file may have another type than the property: then the column decides.
    let of_property = known.filter(|property| fits_column(column, property.kind));
    let value = match of_property {
        Some(property) => {
            let fits = |value: &Value<'_>| is_signed(property) || value.number() >= Some(0.0);
            let fitting = of_kind(property.kind, value).filter(fits);
            fitting.ok_or_else(|| wrong(expected_by(property), value))?
        }
        None => value,
    };
    match column {
        Some(column) if !takes(&column.values, value) => {
            Err(wrong(type_name(&column.values).to_owned(), value))
        }
        Some(column) => Ok((Some(value), column.quantity.or(quantity))),
        None => Ok((Some(value), quantity)),
    }
}

/// Sets the properties of a table of one row; one without a value loses its column.
///
/// # Errors
/// As [`accepted`].
pub(super) fn set_all(
    of: ElementKind,
    attributes: &mut Attributes,
    properties: &[(&str, Option<Value<'_>>)],
) -> Result<(), OperationError> {
    for &(name, value) in properties {
        match accepted(of, name, attributes.get(name), value)? {
            (None, _) => drop(attributes.remove(name)),
            (value, quantity) => {
                let values = [value].into_iter().collect();
                attributes.set_rows(name, quantity, [0], &values);
            }
        }
    }
    Ok(())
}

/// Name of the type of a column, with its unit.
pub(super) fn column_type(column: &Attribute) -> String {
    let name = type_name(&column.values);
    match column.quantity {
        Some(quantity) => format!("{name} in {}", quantity.unit()),
        None => name.to_owned(),
    }
}

/// Returns `true` if a column takes a value without turning other values into text.
pub(super) fn takes(values: &Values, value: Value<'_>) -> bool {
    match values {
        Values::Text(_) => matches!(value, Value::Text(_)),
        Values::Int(_) => matches!(value, Value::Int(_) | Value::Float(_)),
        _ => values.holds(value),
    }
}

fn fits_column(column: Option<&Attribute>, kind: PropertyKind) -> bool {
    let Some(column) = column else { return true };
    matches!(
        (&column.values, kind),
        (Values::Float(_) | Values::Int(_), PropertyKind::Number(_))
            | (Values::Int(_), PropertyKind::Integer)
            | (Values::Bool(_), PropertyKind::Flag)
            | (
                Values::Text(_),
                PropertyKind::Text | PropertyKind::Choice(_)
            )
            | (Values::Json(_), PropertyKind::List | PropertyKind::Json)
    )
}

/// The value in the type of a kind of property, if it fits.
fn of_kind(kind: PropertyKind, value: Value<'_>) -> Option<Value<'_>> {
    match (kind, value) {
        (PropertyKind::Number(_), Value::Int(v)) => Some(Value::Float(v as f64)),
        (PropertyKind::Number(_), Value::Float(v)) => v.is_finite().then_some(value),
        (PropertyKind::Integer, Value::Int(_))
        | (PropertyKind::Flag, Value::Bool(_))
        | (PropertyKind::Text, Value::Text(_))
        | (PropertyKind::Json, Value::Json(_)) => Some(value),
        (PropertyKind::List, Value::Json(text)) => text.starts_with('[').then_some(value),
        (PropertyKind::Choice(words), Value::Text(word)) => words.contains(&word).then_some(value),
        _ => None,
    }
}

/// Returns `true` if numbers below 0 have a meaning: angles, heights below the floor, and all that
/// is no quantity. Speeds, widths and distances have none.
fn is_signed(property: &Property) -> bool {
    match property.quantity() {
        Some(Quantity::Speed | Quantity::RotationSpeed | Quantity::Mass | Quantity::Time) => false,
        Some(Quantity::Length) => ["height", "minHeight"].contains(&property.name),
        Some(Quantity::Angle) | None => true,
    }
}

fn expected_by(property: &Property) -> String {
    match property.kind {
        PropertyKind::Number(quantity) if !is_signed(property) => {
            format!("a number of at least 0 in {}", quantity.unit())
        }
        PropertyKind::Number(quantity) => format!("a number in {}", quantity.unit()),
        PropertyKind::Integer => "a whole number".into(),
        PropertyKind::Flag => "true or false".into(),
        PropertyKind::Text => "a text".into(),
        PropertyKind::Choice(words) => format!("one of {}", words.join(", ")),
        PropertyKind::List => "a list".into(),
        PropertyKind::Json => "a list or an object".into(),
    }
}

fn type_name(values: &Values) -> &'static str {
    match values {
        Values::Bool(_) => "true or false",
        Values::Int(_) => "whole numbers",
        Values::Float(_) => "numbers",
        Values::Text(_) => "texts",
        Values::Json(_) => "lists and objects",
    }
}

/// The kind of the elements of a table.
pub(super) fn kind_of(of: Table) -> ElementKind {
    match of {
        Table::Paths => ElementKind::Path,
        Table::Nodes => ElementKind::Node,
        Table::Stations => ElementKind::Station,
    }
}

fn element_names(kinds: &[ElementKind]) -> String {
    let names: Vec<&str> = kinds.iter().map(|&kind| kind_name(kind)).collect();
    names.join(" or a ")
}

fn kind_name(kind: ElementKind) -> &'static str {
    match kind {
        ElementKind::Path => "path",
        ElementKind::Node => "node",
        ElementKind::Station => "station",
        ElementKind::Level => "level",
        ElementKind::VehicleType => "vehicle type",
        ElementKind::Block => "block",
        ElementKind::Zone => "zone",
    }
}
