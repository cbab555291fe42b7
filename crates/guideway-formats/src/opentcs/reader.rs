//! Reads attributes and properties of plant model elements, and stores them as columns.

use std::collections::HashSet;

use guideway_layout::{Code, Quantity, Value};
use roxmltree::Node;
use serde_json::{Map, Value as Json};

use super::elements::{ANY, OWN_PREFIX, push};
use crate::ReadError;
use crate::builder::Table;
use crate::fields::{Vocabulary, field};
use crate::source::Source;
use crate::xml::{Xml, children};
use crate::xml_builder::XmlBuilder;

/// Properties that become columns, and as many columns that properties hold; bounds the number of
/// columns of a hostile file. Further properties share one column.
pub(super) const MAX_PROPERTIES: usize = 64;

/// Start of the names of columns of properties.
pub(super) const PROPERTY_PREFIX: &str = "property.";

/// Column of the properties beyond [`MAX_PROPERTIES`], as a JSON object.
pub(super) const PROPERTIES: &str = "properties";

/// Column of everything of an element that no other column has, as a JSON object.
pub(super) const OTHER: &str = "other";

/// Characters of a malformed value that a message quotes.
const MAX_QUOTED_CHARS: usize = 40;

/// XML attributes and child elements of an element that a reader reads.
pub(super) struct Known {
    pub(super) attributes: &'static [&'static str],
    pub(super) children: &'static [&'static str],
}

/// The layout under construction, and the property columns so far.
pub(super) struct PlantReader<'a, 'd, 't> {
    pub(super) base: XmlBuilder<'a, 'd, 't>,
    properties: HashSet<&'d str>,
    own: HashSet<&'d str>,
    /// Values of the current element for the column [`OTHER`].
    other: Map<String, Json>,
}

impl<'a, 'd, 't> PlantReader<'a, 'd, 't> {
    pub(super) fn new(source: Source<'a>, xml: &'d Xml<'t>, file_bytes: usize) -> Self {
        Self {
            base: XmlBuilder::new(source, xml, file_bytes),
            properties: HashSet::new(),
            own: HashSet::new(),
            other: Map::new(),
        }
    }

    /// Starts an element: what is kept from now on belongs to it.
    pub(super) fn begin(&mut self) {
        self.other.clear();
    }

    /// Keeps a value of the current element that no column has.
    pub(super) fn keep(&mut self, name: &str, value: Json) {
        push(&mut self.other, name, value);
    }

    /// Keeps a text of the current element that does not have the meaning that it should have.
    fn keep_text(&mut self, name: &str, text: &str) {
        self.other.insert(name.to_owned(), text.into());
    }

    /// Stores the properties of the current element, and everything of it that no column has.
    ///
    /// # Errors
    /// When a text exceeds its limit.
    pub(super) fn finish(
        &mut self,
        table: Table,
        row: usize,
        node: Node<'d, 't>,
        known: &Known,
    ) -> Result<(), ReadError> {
        for attribute in node.attributes() {
            if !known.attributes.contains(&attribute.name()) {
                self.keep_text(attribute.name(), attribute.value());
            }
        }
        for child in node.children().filter(Node::is_element) {
            let tag = child.tag_name().name();
            if !known.children.contains(&tag) {
                self.keep(tag, ANY.to_json(child).into());
            }
        }
        self.set_properties(table, row, node)?;
        let other = std::mem::take(&mut self.other);
        self.set_json(table, row, OTHER, (!other.is_empty()).then(|| other.into()))
    }

    /// Keeps a child element whose attributes are not all known.
    pub(super) fn keep_unknown(&mut self, child: Node<'d, 't>, known: &[&str]) {
        let is_known = |name: &str| known.contains(&name);
        if !child
            .attributes()
            .all(|attribute| is_known(attribute.name()))
        {
            self.keep(child.tag_name().name(), ANY.to_json(child).into());
        }
    }

    /// A number in the first of several attributes that is present. Reports a finding if it is
    /// malformed.
    pub(super) fn number(&mut self, node: Node<'d, 't>, keys: &[&'static str]) -> Option<f64> {
        let found = keys
            .iter()
            .find_map(|key| Some((*key, node.attribute(*key)?)));
        let (key, text) = found?;
        self.parse_number(node, key, text)
    }

    /// Parses a number. Keeps its text and reports a finding if it is malformed.
    pub(super) fn parse_number(
        &mut self,
        node: Node<'d, 't>,
        key: &str,
        text: &str,
    ) -> Option<f64> {
        let number = text.trim().parse().ok();
        if number.is_none() {
            let message = || format!("{key} is \"{}\", expected a number", quoted(text));
            self.base
                .report(Code::WrongType, node, message, "Correct the number");
            self.keep_text(key, text);
        }
        number
    }

    /// A speed or length in the unit of the file. Keeps its text and reports a finding if it is
    /// malformed, negative or not finite.
    pub(super) fn magnitude(&mut self, node: Node<'d, 't>, key: &'static str) -> Option<f64> {
        let number = self.number(node, &[key])?;
        if number.is_finite() && number >= 0.0 {
            return Some(number);
        }
        let message = || format!("{key} is {number}, expected 0 or more");
        self.base
            .report(Code::UnknownValue, node, message, "Correct the number");
        self.keep_text(key, node.attribute(key).unwrap_or_default());
        None
    }

    /// Stores a number in the unit of the file as the property of a row that the field holds.
    ///
    /// # Errors
    /// When the layout exceeds a limit.
    pub(super) fn set_field(
        &mut self,
        table: Table,
        row: usize,
        name: &str,
        number: Option<f64>,
    ) -> Result<(), ReadError> {
        match (field(Vocabulary::OpenTcs, name), number) {
            (Some(field), Some(number)) => {
                let builder = &mut self.base.builder;
                builder.set_field(table, row, field, Value::Float(number))
            }
            _ => Ok(()),
        }
    }

    /// Stores a length in millimeters, unless it is 0.
    pub(super) fn set_length_mm(&mut self, table: Table, row: usize, name: &str, mm: f64) {
        if mm.is_finite() && mm != 0.0 {
            let attributes = self.base.builder.attributes(table);
            attributes.set_quantity(row, name, mm / 1e3, Quantity::Length);
        }
    }

    /// The name of an element, or its tag, with a finding, if it has none.
    ///
    /// # Errors
    /// When the name exceeds the text limit.
    pub(super) fn name(&mut self, node: Node<'d, 't>) -> Result<String, ReadError> {
        let Some(name) = node.attribute("name") else {
            let message = || "the attribute `name` is missing".to_owned();
            self.base
                .report(Code::MissingField, node, message, "Give it a name");
            return Ok(self.base.xml.place(node).to_string());
        };
        self.base.builder.check_text(name)?;
        Ok(name.to_owned())
    }

    /// Reports a reference to a point that is missing or has no position.
    pub(super) fn report_unknown_point(&mut self, node: Node<'d, 't>, point: &str) {
        let message = || format!("the point \"{point}\" does not exist or has no position");
        let remedy = "Add the point, or correct the name";
        self.base.report(Code::UnknownNode, node, message, remedy);
    }

    /// Stores a text, if present, as an attribute of a row.
    ///
    /// # Errors
    /// When the text exceeds its limit.
    pub(super) fn set_text(
        &mut self,
        table: Table,
        row: usize,
        name: &str,
        text: Option<&str>,
    ) -> Result<(), ReadError> {
        let Some(text) = text else {
            return Ok(());
        };
        self.base.builder.check_text(text)?;
        self.base.builder.set(table, row, name, Value::Text(text))
    }

    /// Stores a whole number, if present and not `default`, as an attribute of a row. Stores any
    /// other text in [`OTHER`].
    ///
    /// # Errors
    /// When the layout exceeds a limit.
    pub(super) fn set_int(
        &mut self,
        table: Table,
        row: usize,
        name: &str,
        (text, default): (Option<&str>, i64),
    ) -> Result<(), ReadError> {
        let builder = &mut self.base.builder;
        match text.map(|text| (text, text.trim().parse())) {
            Some((_, Ok(number))) if number != default => {
                builder.set(table, row, name, Value::Int(number))
            }
            Some((text, Err(_))) => {
                self.keep_text(name, text);
                Ok(())
            }
            _ => Ok(()),
        }
    }

    /// Stores a JSON value, if present, as an attribute of a row.
    ///
    /// # Errors
    /// When the layout exceeds a limit.
    pub(super) fn set_json(
        &mut self,
        table: Table,
        row: usize,
        name: &str,
        value: Option<Json>,
    ) -> Result<(), ReadError> {
        let Some(value) = value else {
            return Ok(());
        };
        let text = value.to_string();
        self.base.builder.set(table, row, name, Value::Json(&text))
    }

    /// Stores the attribute `locked` of a row if it is true: false is the default.
    ///
    /// # Errors
    /// When the layout exceeds a limit.
    pub(super) fn set_locked(
        &mut self,
        table: Table,
        row: usize,
        node: Node<'d, 't>,
    ) -> Result<(), ReadError> {
        match node.attribute("locked") {
            Some("true" | "1") => self
                .base
                .builder
                .set(table, row, "locked", Value::Bool(true)),
            None | Some("false" | "0") => Ok(()),
            Some(other) => {
                let message = || format!("locked is \"{}\", expected true or false", quoted(other));
                self.base
                    .report(Code::WrongType, node, message, "Correct the value");
                self.keep_text("locked", other);
                Ok(())
            }
        }
    }

    /// Stores every property of an element as an attribute of a row. Of several properties of one
    /// name the last one counts, with a finding.
    fn set_properties(
        &mut self,
        table: Table,
        row: usize,
        node: Node<'d, 't>,
    ) -> Result<(), ReadError> {
        let mut seen = HashSet::new();
        let mut further = Map::new();
        for property in children(node, "property") {
            let (Some(name), Some(value)) =
                (property.attribute("name"), property.attribute("value"))
            else {
                let message = || "the property has no name or no value".to_owned();
                let remedy = "It is kept as it is; give it both";
                self.base.report(Code::Attribute, property, message, remedy);
                self.keep("property", ANY.to_json(property).into());
                continue;
            };
            self.base.builder.check_text(name)?;
            self.base.builder.check_text(value)?;
            if !seen.insert(name) {
                let message = || format!("the property \"{}\" is repeated", quoted(name));
                let remedy = "The last one counts; remove the others";
                self.base
                    .report(Code::DuplicateKey, property, message, remedy);
            }
            if self.restore_own(table, row, name, value)? {
                continue;
            }
            if self.properties.contains(name) || self.properties.len() < MAX_PROPERTIES {
                self.properties.insert(name);
                self.set_text(table, row, &format!("{PROPERTY_PREFIX}{name}"), Some(value))?;
            } else {
                further.insert(name.to_owned(), value.into());
            }
        }
        let further = (!further.is_empty()).then(|| further.into());
        self.set_json(table, row, PROPERTIES, further)
    }

    /// Turns a property that holds a column of another format back into the column. Returns `false`
    /// for any other property.
    fn restore_own(
        &mut self,
        table: Table,
        row: usize,
        name: &'d str,
        value: &str,
    ) -> Result<bool, ReadError> {
        let Some(label) = name.strip_prefix(OWN_PREFIX) else {
            return Ok(false);
        };
        let Ok(json) = serde_json::from_str::<Json>(value) else {
            return Ok(false);
        };
        if !self.own.contains(name) && self.own.len() == MAX_PROPERTIES {
            return Ok(false);
        }
        let (column, quantity) = split_label(label);
        let builder = &mut self.base.builder;
        match &json {
            Json::Null => return Ok(false),
            Json::Bool(flag) => builder.set(table, row, column, Value::Bool(*flag))?,
            Json::String(text) => builder.set(table, row, column, Value::Text(text))?,
            Json::Array(_) | Json::Object(_) => {
                builder.set(table, row, column, Value::Json(value))?;
            }
            Json::Number(number) => match (quantity, number.as_i64(), number.as_f64()) {
                (Some(quantity), _, Some(number)) => {
                    let attributes = builder.attributes(table);
                    attributes.set_quantity(row, column, number, quantity);
                }
                (None, Some(number), _) => builder.set(table, row, column, Value::Int(number))?,
                (_, _, Some(number)) => builder.set(table, row, column, Value::Float(number))?,
                _ => return Ok(false),
            },
        }
        self.own.insert(name);
        Ok(true)
    }
}

/// Splits the label of a column, such as `maxHeight (m)`, into its name and quantity. An empty unit
/// means that the name itself ends in one.
pub(super) fn split_label(label: &str) -> (&str, Option<Quantity>) {
    let Some((name, unit)) = label.strip_suffix(')').and_then(|l| l.rsplit_once(" (")) else {
        return (label, None);
    };
    match Quantity::of_unit(unit) {
        None if !unit.is_empty() => (label, None),
        quantity => (name, quantity),
    }
}

/// The start of a malformed value, for a message.
pub(super) fn quoted(text: &str) -> String {
    text.chars().take(MAX_QUOTED_CHARS).collect()
}

/// The name of an element; empty if it has none.
pub(super) fn name_or_empty<'d>(node: Node<'d, '_>) -> &'d str {
    node.attribute("name").unwrap_or_default()
}
