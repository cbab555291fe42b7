//! LIF edge properties from columns: selects the columns that a version has a property for, and
//! converts their values to JSON.

use guideway_layout::{Attribute, Layout, Values};
use serde_json::{Map, Value, json};

use super::version::Version;
use crate::Losses;

/// Type of the value of a property.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Number,
    Bool,
    /// A boolean that the other version negates.
    Negated,
    Text,
    /// An array of strings, stored as one text with commas.
    TextArray,
    /// A number in 1.0, an array of numbers in 2.0.
    Angles,
}

/// Names of the properties in 1.0 and 2.0; `None` if a version lacks the property. Actions are
/// missing: a layout stores their number only.
const PROPERTIES: &[(Option<&str>, Option<&str>, Kind)] = &[
    same("orientationType", Kind::Text),
    both(
        "vehicleOrientation",
        "mobileRobotOrientations",
        Kind::Angles,
    ),
    both(
        "rotationAllowed",
        "reachOrientationBeforeEntering",
        Kind::Negated,
    ),
    same("rotationAtStartNodeAllowed", Kind::Text),
    same("rotationAtEndNodeAllowed", Kind::Text),
    both("maxSpeed", "maximumSpeed", Kind::Number),
    both("maxRotationSpeed", "maximumRotationSpeed", Kind::Number),
    both("minHeight", "minimumLoadHandlingDeviceHeight", Kind::Number),
    both("maxHeight", "maximumMobileRobotHeight", Kind::Number),
    same("loadRestriction.unloaded", Kind::Bool),
    same("loadRestriction.loaded", Kind::Bool),
    same("loadRestriction.loadSetNames", Kind::TextArray),
    same("reentryAllowed", Kind::Bool),
    (None, Some("forbiddenActionTypes"), Kind::TextArray),
    (None, Some("corridor.maximumLeftWidth"), Kind::Number),
    (None, Some("corridor.maximumRightWidth"), Kind::Number),
    (None, Some("corridor.corridorReferencePoint"), Kind::Text),
];

const fn both(
    in_1: &'static str,
    in_2: &'static str,
    kind: Kind,
) -> (Option<&'static str>, Option<&'static str>, Kind) {
    (Some(in_1), Some(in_2), kind)
}

const fn same(
    name: &'static str,
    kind: Kind,
) -> (Option<&'static str>, Option<&'static str>, Kind) {
    both(name, name, kind)
}

/// Path columns that a version has a property for.
pub(super) struct PropertyColumns<'a> {
    version: Version,
    columns: Vec<Column<'a>>,
}

struct Column<'a> {
    attribute: &'a Attribute,
    /// Name of the property, and of the nested object that contains it.
    name: &'static str,
    group: Option<&'static str>,
    kind: Kind,
    is_renamed: bool,
}

impl<'a> PropertyColumns<'a> {
    /// Selects the columns of a layout; adds all others, and values that do not convert, to the
    /// losses.
    pub(super) fn select(layout: &'a Layout, version: Version, losses: &mut Losses) -> Self {
        let mut columns: Vec<Column<'a>> = Vec::new();
        for &(in_1, in_2, kind) in PROPERTIES {
            let Some(target) = version.pick(in_1, in_2) else {
                continue;
            };
            // The name of this version has precedence: a merged layout may have columns of both.
            let other = version.pick(in_2, in_1).filter(|&other| other != target);
            let column = |name| layout.paths.attributes.get(name);
            let Some(attribute) = column(target).or_else(|| column(other?)) else {
                continue;
            };
            let (group, name) = match target.split_once('.') {
                Some((group, name)) => (Some(group), name),
                None => (None, target),
            };
            columns.push(Column {
                attribute,
                name,
                group,
                kind,
                is_renamed: attribute.name != target,
            });
        }
        losses.add_columns(&layout.paths.attributes, "paths", |name| {
            columns.iter().any(|c| c.attribute.name == name)
        });
        for column in &columns {
            let values = &column.attribute.values;
            let rows = (0..values.len()).filter(|&row| values.get(row).is_some());
            let unfit = rows.filter(|&row| column.json(row, version).is_none());
            let what = format!("column {}", column.attribute.name);
            losses.add(what, unfit.count(), "values that the format cannot hold");
        }
        Self { version, columns }
    }

    /// Returns the properties of a path as JSON.
    pub(super) fn json(&self, path: usize) -> Map<String, Value> {
        let mut json = Map::new();
        for column in &self.columns {
            let Some(value) = column.json(path, self.version) else {
                continue;
            };
            let object = match column.group {
                None => &mut json,
                Some(group) => match json.entry(group).or_insert_with(|| json!({})) {
                    Value::Object(object) => object,
                    _ => continue,
                },
            };
            object.insert(column.name.to_owned(), value);
        }
        json
    }
}

impl Column<'_> {
    fn json(&self, path: usize, version: Version) -> Option<Value> {
        let value = column_json(&self.attribute.values, path)?;
        let is_array = version == Version::V2;
        match self.kind {
            Kind::Number => number(&value),
            Kind::Bool => Some(boolean(&value)?.into()),
            Kind::Negated => Some((boolean(&value)? != self.is_renamed).into()),
            Kind::Text => Some(text(&value).into()),
            Kind::TextArray => Some(text(&value).split(", ").collect()),
            Kind::Angles => {
                let text = text(&value);
                let numbers = text.split(", ").map(|part| number(&part.into()));
                let numbers: Vec<Value> = numbers.collect::<Option<_>>()?;
                match &numbers[..] {
                    [one] if !is_array => Some(one.clone()),
                    _ => is_array.then_some(Value::Array(numbers)),
                }
            }
        }
    }
}

/// Converts a value of a column to JSON, which has no infinities and no NaN.
pub(super) fn column_json(values: &Values, row: usize) -> Option<Value> {
    use guideway_layout::Value as Cell;
    match values.get(row)? {
        Cell::Bool(value) => Some(value.into()),
        Cell::Int(value) => Some(value.into()),
        Cell::Float(value) => value.is_finite().then(|| value.into()),
        Cell::Text(value) => Some(value.into()),
        Cell::Json(value) => serde_json::from_str(value).ok(),
    }
}

fn number(value: &Value) -> Option<Value> {
    match value {
        Value::Number(_) => Some(value.clone()),
        Value::String(text) => {
            let number: f64 = text.parse().ok()?;
            number.is_finite().then(|| number.into())
        }
        _ => None,
    }
}

fn boolean(value: &Value) -> Option<bool> {
    match value {
        Value::Bool(value) => Some(*value),
        Value::String(text) => text.parse().ok(),
        _ => None,
    }
}

fn text(value: &Value) -> String {
    match value {
        Value::String(text) => text.clone(),
        other => other.to_string(),
    }
}
