//! Reads attributes and properties of plant model elements, and stores them as columns.

use std::collections::HashSet;

use guideway_layout::{Code, Value};
use roxmltree::Node;

use crate::ReadError;
use crate::builder::Table;
use crate::source::Source;
use crate::xml::{Xml, children};
use crate::xml_builder::XmlBuilder;

/// Properties that become columns; bounds the number of columns of a hostile file.
const MAX_PROPERTIES: usize = 64;

/// Characters of a malformed value that a message quotes.
const MAX_QUOTED_CHARS: usize = 40;

/// The layout under construction, and the property columns so far.
pub(super) struct PlantReader<'a, 'd, 't> {
    pub(super) base: XmlBuilder<'a, 'd, 't>,
    properties: HashSet<&'d str>,
}

impl<'a, 'd, 't> PlantReader<'a, 'd, 't> {
    pub(super) fn new(source: Source<'a>, xml: &'d Xml<'t>, file_bytes: usize) -> Self {
        Self {
            base: XmlBuilder::new(source, xml, file_bytes),
            properties: HashSet::new(),
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

    /// Parses a number. Reports a finding if it is malformed.
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
        }
        number
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

    /// Stores an XML attribute of the value `true` or `false`, if present, as an attribute of a
    /// row.
    ///
    /// # Errors
    /// When the layout exceeds a limit.
    pub(super) fn set_bool(
        &mut self,
        table: Table,
        row: usize,
        name: &'static str,
        node: Node<'d, 't>,
    ) -> Result<(), ReadError> {
        let value = match node.attribute(name) {
            Some("true") => true,
            Some("false") => false,
            Some(other) => {
                let message = || format!("{name} is \"{}\", expected true or false", quoted(other));
                self.base
                    .report(Code::WrongType, node, message, "Correct the value");
                return Ok(());
            }
            None => return Ok(()),
        };
        self.base.builder.set(table, row, name, Value::Bool(value))
    }

    /// Stores every property of an element as an attribute of a row.
    ///
    /// # Errors
    /// When a text exceeds its limit.
    pub(super) fn set_properties(
        &mut self,
        table: Table,
        row: usize,
        node: Node<'d, 't>,
    ) -> Result<(), ReadError> {
        let mut seen = HashSet::new();
        for property in children(node, "property") {
            let (Some(name), value) = (property.attribute("name"), property.attribute("value"))
            else {
                continue;
            };
            if !self.properties.contains(name) {
                if self.properties.len() == MAX_PROPERTIES {
                    let message = || format!("more than {MAX_PROPERTIES} different properties");
                    let remedy = "The others are left out";
                    self.base.report(Code::Attribute, property, message, remedy);
                    continue;
                }
                self.base.builder.check_text(name)?;
                self.properties.insert(name);
            }
            if seen.insert(name) {
                self.set_text(table, row, &format!("property.{name}"), value)?;
            }
        }
        Ok(())
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
