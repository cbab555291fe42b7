//! What an edge can have for a vehicle type, and how a column becomes it.

use guideway_layout::{Attribute, Layout, Values};
use serde_json::{Map, Value, json};

use crate::Losses;

/// A version of LIF.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Version {
    /// LIF 1.0.0 of 2023.
    V1,
    /// LIF 2.0.0 of 2026.
    V2,
}

impl Version {
    /// That of the file that a layout was read from, if it is LIF.
    pub fn of_layout(layout: &Layout) -> Option<Self> {
        let provenance = &layout.provenance;
        let is_lif = provenance.format == crate::Format::Lif.name();
        let is_2 = provenance.format_version.starts_with('2');
        is_lif.then_some(if is_2 { Self::V2 } else { Self::V1 })
    }

    /// What a thing of which there is one for each version is in this one.
    pub(super) fn one_of<T>(self, [in_1, in_2]: [T; 2]) -> T {
        self.of(in_1, in_2)
    }

    /// What a thing is in this version.
    pub(super) fn of<T>(self, in_1: T, in_2: T) -> T {
        match self {
            Self::V1 => in_1,
            Self::V2 => in_2,
        }
    }
}

/// What kind of value a property has.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Number,
    Truth,
    /// True in one version is false in the other.
    Opposite,
    Text,
    /// A list of texts, held as one with commas.
    Texts,
    /// A number in 1.0, a list of numbers in 2.0.
    Angles,
}

/// The properties in 1.0 and in 2.0, none where a version has not got it. Lists of actions are missing: a
/// layout has only their number.
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
        Kind::Opposite,
    ),
    same("rotationAtStartNodeAllowed", Kind::Text),
    same("rotationAtEndNodeAllowed", Kind::Text),
    both("maxSpeed", "maximumSpeed", Kind::Number),
    both("maxRotationSpeed", "maximumRotationSpeed", Kind::Number),
    both("minHeight", "minimumLoadHandlingDeviceHeight", Kind::Number),
    both("maxHeight", "maximumMobileRobotHeight", Kind::Number),
    same("loadRestriction.unloaded", Kind::Truth),
    same("loadRestriction.loaded", Kind::Truth),
    same("loadRestriction.loadSetNames", Kind::Texts),
    same("reentryAllowed", Kind::Truth),
    (None, Some("forbiddenActionTypes"), Kind::Texts),
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

/// The columns of paths that a version has a property for.
pub(super) struct Columns<'a> {
    version: Version,
    columns: Vec<Column<'a>>,
}

struct Column<'a> {
    attribute: &'a Attribute,
    /// The property, and the object that it is in.
    name: &'static str,
    group: Option<&'static str>,
    kind: Kind,
    is_renamed: bool,
}

impl<'a> Columns<'a> {
    pub(super) fn of(layout: &'a Layout, version: Version, losses: &mut Losses) -> Self {
        let mut columns: Vec<Column<'a>> = Vec::new();
        for &(in_1, in_2, kind) in PROPERTIES {
            let Some(target) = version.of(in_1, in_2) else {
                continue;
            };
            // The name of this version comes first: a layout merged from both may have both.
            let other = version.of(in_2, in_1).filter(|&other| other != target);
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
            losses.add(what, unfit.count(), "values that the format does not take");
        }
        Self { version, columns }
    }

    /// The properties of a path.
    pub(super) fn json(&self, path: usize) -> Map<String, Value> {
        let mut json = Map::new();
        for column in &self.columns {
            let Some(value) = column.json(path, self.version) else {
                continue;
            };
            let within = match column.group {
                None => &mut json,
                Some(group) => match json.entry(group).or_insert_with(|| json!({})) {
                    Value::Object(within) => within,
                    _ => continue,
                },
            };
            within.insert(column.name.to_owned(), value);
        }
        json
    }
}

impl Column<'_> {
    fn json(&self, path: usize, version: Version) -> Option<Value> {
        let value = column_json(&self.attribute.values, path)?;
        let is_list = version == Version::V2;
        match self.kind {
            Kind::Number => number(&value),
            Kind::Truth => Some(truth(&value)?.into()),
            Kind::Opposite => Some((truth(&value)? != self.is_renamed).into()),
            Kind::Text => Some(text(&value).into()),
            Kind::Texts => Some(text(&value).split(", ").collect()),
            Kind::Angles => {
                let text = text(&value);
                let numbers = text.split(", ").map(|part| number(&part.into()));
                let numbers: Vec<Value> = numbers.collect::<Option<_>>()?;
                match &numbers[..] {
                    [one] if !is_list => Some(one.clone()),
                    _ => is_list.then_some(Value::Array(numbers)),
                }
            }
        }
    }
}

/// A value of a column as it is.
pub(super) fn column_json(values: &Values, row: usize) -> Option<Value> {
    use guideway_layout::Value as Of;
    match values.get(row)? {
        Of::Bool(value) => Some(value.into()),
        Of::Int(value) => Some(value.into()),
        // JSON has no other numbers.
        Of::Float(value) => value.is_finite().then(|| value.into()),
        Of::Text(value) => Some(value.into()),
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

fn truth(value: &Value) -> Option<bool> {
    match value {
        Value::Bool(truth) => Some(*truth),
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
