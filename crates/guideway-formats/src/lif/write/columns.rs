//! LIF members from columns: selects the columns that a version has members for, and converts their
//! values to JSON.

use guideway_layout::{Attribute, Attributes, Value};

use super::actions::are_actions_of_1;
use crate::json::{CellKind, Members, Tree};
use crate::lif::members::{Column, REFERENCE_POINT};
use crate::lif::version::Version;

/// Form of a value in a file, compared with the column.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Form {
    Same,
    /// The value of another member.
    Renamed,
    /// A boolean that the other version negates.
    Negated,
    /// A list with the number of the column.
    InList,
    /// The only number of the list in the column.
    OnlyItem,
}

/// A member, with the columns that may have its value.
struct MemberSource<'a> {
    group: Option<&'static str>,
    name: &'static str,
    column: Column,
    sources: Vec<Source<'a>>,
}

struct Source<'a> {
    name: &'static str,
    form: Form,
    of_element: Option<&'a Attribute>,
    of_entry: Option<&'a Attribute>,
}

/// The columns of a table that a version has members for.
pub(in crate::lif) struct MemberColumns<'a> {
    members: Vec<MemberSource<'a>>,
    /// True for a file whose values need not follow the schema of the version.
    is_as_written: bool,
    version: Version,
}

/// Columns of an element and of its entries per vehicle type.
#[derive(Clone, Copy)]
pub(super) struct Tables<'a> {
    pub(super) of_element: &'a Attributes,
    pub(super) of_entry: Option<&'a Attributes>,
}

impl<'a> MemberColumns<'a> {
    /// Selects the columns for the members of an object. `is_reverse` selects those for the
    /// opposite direction of a path.
    pub(super) fn select(
        version: Version,
        names: &[&'static str],
        tables: Tables<'a>,
        is_reverse: bool,
        is_as_written: bool,
    ) -> Self {
        let mut members: Vec<MemberSource<'a>> = Vec::new();
        for column in version.columns(names).into_iter().flatten() {
            if members.iter().any(|known| known.column.name == column.name) {
                // Another name of the same member.
                continue;
            }
            let sources = sources(version, column, is_reverse).into_iter();
            let source = |(name, form)| Source {
                name,
                form,
                of_element: tables.of_element.get(name),
                of_entry: tables.of_entry.and_then(|table| table.get(name)),
            };
            let exists = |s: &Source<'_>| s.of_element.is_some() || s.of_entry.is_some();
            let sources: Vec<Source<'a>> = sources.map(source).filter(exists).collect();
            if sources.is_empty() {
                continue;
            }
            let (group, name) = match column.member.split_once('.') {
                Some((group, name)) => (Some(group), name),
                None => (None, column.member),
            };
            members.push(MemberSource {
                group,
                name,
                column,
                sources,
            });
        }
        Self {
            members,
            is_as_written,
            version,
        }
    }

    /// Adds the members of an element, for one of its entries or for none, to an object.
    pub(in crate::lif) fn add_to(
        &self,
        object: &mut Members<'a>,
        row: usize,
        entry: Option<usize>,
    ) {
        for member in &self.members {
            let Some(value) = self.value(member, row, entry) else {
                continue;
            };
            let Some(group) = member.group else {
                object.push((member.name.into(), value));
                continue;
            };
            let known = object.iter_mut().find(|(name, _)| name == group);
            match known {
                Some((_, Tree::Object(members))) => members.push((member.name.into(), value)),
                _ => {
                    let nested = Tree::Object(vec![(member.name.into(), value)]);
                    object.push((group.into(), nested));
                }
            }
        }
        if !self.is_as_written && self.version == Version::V1 {
            object.retain(|(name, value)| name != "loadRestriction" || is_restriction_of_1(value));
        }
    }

    fn value(
        &self,
        member: &MemberSource<'a>,
        row: usize,
        entry: Option<usize>,
    ) -> Option<Tree<'a>> {
        let mut sources = member.sources.iter();
        sources.find_map(|source| self.convert(member, source, source.value(row, entry)?))
    }

    /// Returns whether a column is a source of a member.
    pub(super) fn has_source(&self, column: &str) -> bool {
        let mut sources = self.members.iter().flat_map(|member| &member.sources);
        sources.any(|source| source.name == column)
    }

    /// Returns the number of values of a column that the version cannot hold, and of those that it
    /// holds in another form, in the rows that count.
    pub(super) fn count_changed(
        &self,
        column: &Attribute,
        is_counted: impl Fn(usize) -> bool,
    ) -> [usize; 2] {
        let (mut unfit, mut other_form) = (0, 0);
        for row in (0..column.values.len()).filter(|&row| is_counted(row)) {
            let Some(value) = column.values.get(row) else {
                continue;
            };
            let mut all = self.members.iter().flat_map(|member| {
                let sources = member.sources.iter().filter(|s| s.name == column.name);
                sources.map(move |source| (member, source))
            });
            let found = all.find(|(member, source)| self.convert(member, source, value).is_some());
            match found {
                None => unfit += 1,
                Some((_, source)) => {
                    let is_only_item = source.form == Form::InList;
                    other_form += usize::from(source.form != Form::Same && !is_only_item);
                }
            }
        }
        [unfit, other_form]
    }

    /// Converts a value of a column to JSON, which has no infinities and no NaN.
    fn convert(
        &self,
        member: &MemberSource<'_>,
        source: &Source<'_>,
        value: Value<'a>,
    ) -> Option<Tree<'a>> {
        let needs_schema = !self.is_as_written && self.version == Version::V1;
        let tree = match source.form {
            Form::Negated => return Some(Tree::Bool(!boolean(value)?)),
            Form::InList => return Some(Tree::Array(vec![number(value)?])),
            Form::OnlyItem => {
                let text = value.to_string();
                let list = text.trim_start_matches('[').trim_end_matches(']');
                return Tree::number(list.trim().parse().ok()?);
            }
            Form::Same | Form::Renamed => match member.column.kind {
                CellKind::Number => number(value)?,
                CellKind::Integer => Tree::Raw(value.to_string().into()),
                CellKind::Flag => Tree::Bool(boolean(value)?),
                CellKind::Text => text(value)?,
                CellKind::Choice(choices) => choice(member, choices, self.is_as_written, value)?,
                CellKind::List => list(value)?,
                CellKind::Json => match value {
                    Value::Json(text) => Tree::Raw(text.into()),
                    _ => return None,
                },
            },
        };
        let fits = match (member.name, &tree) {
            ("actions", Tree::Raw(text)) => are_actions_of_1(text),
            ("stationHeight", Tree::Number(height)) => *height >= 0.0,
            _ => true,
        };
        (fits || !needs_schema).then_some(tree)
    }
}

impl<'a> Source<'a> {
    fn value(&self, row: usize, entry: Option<usize>) -> Option<Value<'a>> {
        let of_entry = entry.and_then(|entry| self.of_entry?.values.get(entry));
        of_entry.or_else(|| self.of_element?.values.get(row))
    }
}

/// Returns the columns that may have the value of a member, and their forms.
fn sources(version: Version, column: Column, is_reverse: bool) -> Vec<(&'static str, Form)> {
    use Form::{InList, Negated, OnlyItem, Renamed, Same};
    let (one, list) = ("vehicleOrientation", "vehicleOrientations");
    let (rotation, reach) = ("rotationAllowed", "reachOrientationBeforeEntering");
    let (start, end) = ("rotationAtStartNodeAllowed", "rotationAtEndNodeAllowed");
    let (left, right) = ("corridor.leftWidth", "corridor.rightWidth");
    match (column.member, column.name) {
        ("vehicleOrientation", _) => vec![(one, Same), (list, OnlyItem)],
        ("mobileRobotOrientations", _) => vec![(list, Same), (one, InList)],
        ("rotationAllowed", _) => vec![(rotation, Same), (reach, Negated)],
        ("reachOrientationBeforeEntering", _) => vec![(reach, Same), (rotation, Negated)],
        ("nodeDescriptor", name) if version == Version::V2 => vec![(name, Same), ("name", Renamed)],
        (_, "maxSpeed") if is_reverse => vec![("maxReverseSpeed", Renamed), ("maxSpeed", Same)],
        (_, name) if is_reverse && name == start => vec![(end, Same)],
        (_, name) if is_reverse && name == end => vec![(start, Same)],
        (_, name) if is_reverse && name == left => vec![(right, Same)],
        (_, name) if is_reverse && name == right => vec![(left, Same)],
        (_, name) => vec![(name, Same)],
    }
}

fn number<'a>(value: Value<'_>) -> Option<Tree<'a>> {
    match value {
        Value::Float(number) => Tree::number(number),
        Value::Int(number) => Some(Tree::Raw(number.to_string().into())),
        Value::Text(text) => Tree::number(text.parse().ok()?),
        Value::Bool(_) | Value::Json(_) => None,
    }
}

fn boolean(value: Value<'_>) -> Option<bool> {
    match value {
        Value::Bool(value) => Some(value),
        Value::Text(text) => text.parse().ok(),
        _ => None,
    }
}

pub(super) fn text(value: Value<'_>) -> Option<Tree<'_>> {
    match value {
        Value::Text(text) => Some(Tree::Text(text.into())),
        Value::Json(_) => None,
        other => Some(Tree::Text(other.to_string().into())),
    }
}

fn choice<'a>(
    member: &MemberSource<'_>,
    choices: &[&str],
    is_as_written: bool,
    value: Value<'a>,
) -> Option<Tree<'a>> {
    let Value::Text(text) = value else {
        return None;
    };
    let text = match (member.column.member, text) {
        (REFERENCE_POINT, "KINEMATICCENTER") => "KINEMATIC_CENTER",
        (_, text) => text,
    };
    (is_as_written || choices.contains(&text)).then(|| Tree::Text(text.into()))
}

/// A list, or a text with commas between its items.
fn list(value: Value<'_>) -> Option<Tree<'_>> {
    match value {
        Value::Json(text) => text.starts_with('[').then(|| Tree::Raw(text.into())),
        Value::Text(text) => {
            let items = text.split(", ").map(|item| match item.parse::<f64>() {
                Ok(number) if number.is_finite() => Tree::Number(number),
                _ => Tree::Text(item.into()),
            });
            Some(Tree::Array(items.collect()))
        }
        _ => None,
    }
}

/// Returns whether a load restriction has the members that 1.0 requires.
fn is_restriction_of_1(value: &Tree<'_>) -> bool {
    match value {
        Tree::Object(members) => {
            let has = |name: &str| members.iter().any(|(key, _)| key == name);
            has("unloaded") && has("loaded")
        }
        _ => false,
    }
}
