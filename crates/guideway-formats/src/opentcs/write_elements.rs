//! Writes JSON values of a layout as elements of a plant model, and columns as properties.

use std::collections::HashSet;
use std::io::{self, Write};

use guideway_layout::{Attribute, Attributes, Value};
use serde_json::{Map, Value as Json};

use super::elements::{Child, Element, OWN_PREFIX};
use super::held::Held;
use super::reader::{MAX_PROPERTIES, PROPERTIES, PROPERTY_PREFIX, split_label};
use super::xml_writer::XmlWriter;
use crate::Losses;

/// Writes the attributes of an object to the element that was just started, with the defaults of
/// openTCS for those that it lacks. Returns the number of members that are no such attributes.
///
/// # Errors
/// When the output fails, as in the other functions.
pub(super) fn write_fields<W: Write>(
    xml: &mut XmlWriter<'_, W>,
    element: &Element,
    object: &Map<String, Json>,
) -> io::Result<usize> {
    let mut written = 0;
    for field in element.fields {
        let text = object.get(field.name).and_then(|v| field.kind.text(v));
        written += usize::from(text.is_some());
        if let Some(text) = text.as_deref().or(field.default) {
            xml.attribute(field.name, text)?;
        }
    }
    Ok(object.len() - written)
}

/// Writes an object as an element. Members that the schemas do not have become properties. Returns
/// the number of members that are lost.
pub(super) fn write_object<W: Write>(
    xml: &mut XmlWriter<'_, W>,
    element: &Element,
    object: &Map<String, Json>,
) -> io::Result<usize> {
    xml.begin(element.tag)?;
    write_fields(xml, element, object)?;
    let lost = write_children(xml, element, object)?;
    xml.end()?;
    Ok(lost)
}

/// Writes the members of an object that are no attributes to the element that was started last.
/// Returns the number of members that are lost.
pub(super) fn write_children<W: Write>(
    xml: &mut XmlWriter<'_, W>,
    element: &Element,
    object: &Map<String, Json>,
) -> io::Result<usize> {
    let is_field = |name: &str, value: &Json| {
        let mut fields = element.fields.iter().filter(|field| field.name == name);
        fields.any(|field| field.kind.text(value).is_some())
    };
    let is_child = |name: &str, value: &Json| {
        let mut children = element.children.iter().filter(|child| child.tag() == name);
        children.any(|child| match child {
            Child::Once(_) | Child::Required(_) | Child::Properties => value.is_object(),
            Child::Names(_) => value.is_array(),
        })
    };
    let mut further = object.clone();
    further.retain(|name, value| !is_field(name, value) && !is_child(name, value));
    let mut lost = 0;
    for child in element.children {
        let value = object.get(child.tag());
        match (child, value) {
            (Child::Once(element) | Child::Required(element), Some(Json::Object(object))) => {
                lost += write_object(xml, element, object)?;
            }
            (Child::Required(element), _) => {
                lost += write_object(xml, element, &Map::new())?;
            }
            (Child::Names(tag), Some(Json::Array(names))) => {
                for name in names {
                    match name.as_str() {
                        Some(name) => xml.element(tag, &[("name", &name)])?,
                        None => lost += 1,
                    }
                }
            }
            (Child::Properties, value) => {
                for (name, value) in value.and_then(Json::as_object).into_iter().flatten() {
                    write_property(xml, name, &plain(value))?;
                }
                for (name, value) in std::mem::take(&mut further) {
                    write_property(xml, &format!("{OWN_PREFIX}{name}"), &value.to_string())?;
                }
            }
            _ => {}
        }
    }
    Ok(lost + further.len())
}

/// The text of a scalar, or JSON.
fn plain(value: &Json) -> String {
    match value {
        Json::String(text) => text.clone(),
        other => other.to_string(),
    }
}

/// Writes a property.
///
/// # Errors
/// When the output fails.
pub(super) fn write_property<W: Write>(
    xml: &mut XmlWriter<'_, W>,
    name: &str,
    value: &str,
) -> io::Result<()> {
    xml.element("property", &[("name", &name), ("value", &value)])
}

/// The columns that become properties, over all tables.
#[derive(Default)]
pub(super) struct PropertyColumns {
    /// Labels of the columns of other formats, which readers restore up to a number.
    own: HashSet<String>,
}

impl PropertyColumns {
    /// Writes the properties of a row: its values but those that are written otherwise.
    ///
    /// # Errors
    /// When the output fails.
    pub(super) fn write<W: Write>(
        &self,
        xml: &mut XmlWriter<'_, W>,
        attributes: &Attributes,
        row: usize,
        held: impl Fn(usize, &str, Value<'_>) -> Held,
    ) -> io::Result<()> {
        for column in attributes.iter() {
            let Some(value) = column.values.get(row) else {
                continue;
            };
            if let Some(name) = column.name.strip_prefix(PROPERTY_PREFIX) {
                write_property(xml, name, &value.to_string())?;
            } else if let (PROPERTIES, Some(object)) = (column.name.as_str(), object_of(value)) {
                for (name, value) in &object {
                    write_property(xml, name, &plain(value))?;
                }
            } else if held(row, &column.name, value) == Held::Not
                && self.own.contains(&label(column))
                && let Some(text) = json_text(value)
            {
                write_property(xml, &format!("{OWN_PREFIX}{}", label(column)), &text)?;
            }
        }
        Ok(())
    }

    /// Adds the columns of a table that have values which are not written otherwise, and lists the
    /// values that properties cannot hold either. `of` names the rows, such as `paths`.
    pub(super) fn add(
        &mut self,
        attributes: &Attributes,
        of: &str,
        losses: &mut Losses,
        held: impl Fn(usize, &str, Value<'_>) -> Held,
    ) {
        for column in attributes.iter() {
            let what = format!("column {}", column.name);
            let values =
                (0..column.values.len()).filter_map(|row| Some((row, column.values.get(row)?)));
            if column.name.starts_with(PROPERTY_PREFIX) {
                let others = values.filter(|(_, value)| !matches!(value, Value::Text(_)));
                losses.add(
                    what,
                    others.count(),
                    format!("values of {of}: written as text"),
                );
                continue;
            }
            let values = values
                .filter(|(_, value)| column.name != PROPERTIES || object_of(*value).is_none());
            let (mut defaults, mut lost, mut own) = (0, 0, 0);
            for (row, value) in values {
                match held(row, &column.name, value) {
                    Held::Written => {}
                    Held::Default => defaults += 1,
                    Held::Not if json_text(value).is_some() => own += 1,
                    Held::Not => lost += 1,
                }
            }
            if own > 0 && !self.own.contains(&label(column)) {
                match self.own.len() < MAX_PROPERTIES {
                    true => drop(self.own.insert(label(column))),
                    false => lost += own,
                }
            }
            losses.add(&what, lost, format!("values of {of}"));
            let detail = format!("values of {of} that openTCS implies");
            losses.add(&what, defaults, detail);
        }
    }
}

/// Name of a column with its unit, from which the reader knows both again. A name that looks like
/// one with a unit gets an empty one.
fn label(column: &Attribute) -> String {
    let looks_like_label = split_label(&column.name).0 != column.name;
    match column.quantity.is_none() && looks_like_label {
        true => format!("{} ()", column.name),
        false => column.label(),
    }
}

fn object_of(value: Value<'_>) -> Option<Map<String, Json>> {
    match value {
        Value::Json(text) => serde_json::from_str(text).ok(),
        _ => None,
    }
}

/// The JSON text of a value, by which its type is known again; `None` if JSON has no such number.
fn json_text(value: Value<'_>) -> Option<String> {
    match value {
        Value::Bool(value) => Some(value.to_string()),
        Value::Int(value) => Some(value.to_string()),
        Value::Float(value) => value.is_finite().then(|| Json::from(value).to_string()),
        Value::Text(text) => Some(Json::from(text).to_string()),
        Value::Json(text) => Some(text.to_owned()),
    }
}
