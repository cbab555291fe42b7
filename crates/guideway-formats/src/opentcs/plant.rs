//! From a plant model to a layout: points, locations, blocks, counts.

use std::collections::{HashMap, HashSet};

use guideway_layout::{Code, Layout, Place, Value};
use guideway_spline::Point;
use roxmltree::Node;

use super::drawing::Drawing;
use crate::ReadError;
use crate::builder::{Builder, Table};
use crate::source::Source;
use crate::xml::{Xml, child, children};

/// Most properties that become columns; a file could else make columns without end.
const MOST_PROPERTIES: usize = 64;

/// Positions nearer than this are the same: the file has whole millimeters.
const SAME_POSITION_M: f64 = 5e-4;

/// Fills a layout from a model.
pub(super) struct Plant<'a, 'd, 't> {
    pub(super) builder: Builder<'a>,
    pub(super) xml: &'d Xml<'t>,
    pub(super) nodes: HashMap<&'d str, u32>,
    /// The names of the blocks that something is a member of.
    pub(super) blocks: HashMap<&'d str, Vec<&'d str>>,
    /// How many paths have which connection type, and how many control points they have.
    pub(super) connection_types: Vec<(String, u64)>,
    pub(super) control_points: u64,
    properties: HashSet<&'d str>,
    moved: u64,
    farthest_m: f64,
}

impl<'a, 'd, 't> Plant<'a, 'd, 't> {
    pub(super) fn new(source: Source<'a>, xml: &'d Xml<'t>, file_bytes: usize) -> Self {
        Self {
            builder: Builder::new(source, file_bytes),
            xml,
            nodes: HashMap::new(),
            blocks: HashMap::new(),
            connection_types: Vec::new(),
            control_points: 0,
            properties: HashSet::new(),
            moved: 0,
            farthest_m: 0.0,
        }
    }

    pub(super) fn map(
        mut self,
        model: Node<'d, 't>,
        drawing: &Drawing<'d>,
    ) -> Result<Layout, ReadError> {
        self.map_version(model)?;
        for point in children(model, "point") {
            self.map_point(point, drawing)?;
        }
        for block in children(model, "block") {
            let name = block.attribute("name").unwrap_or_default();
            for member in children(block, "member").filter_map(|m| m.attribute("name")) {
                self.blocks.entry(member).or_default().push(name);
            }
        }
        for path in children(model, "path") {
            self.map_path(path, drawing)?;
        }
        for location in children(model, "location") {
            self.map_location(location, drawing)?;
        }
        self.report_moved();
        self.count(model);
        Ok(self.builder.layout)
    }

    fn map_version(&mut self, model: Node<'d, 't>) -> Result<(), ReadError> {
        const KNOWN: &[&str] = &["0.0.2", "0.0.3", "0.0.4", "0.0.5", "6.0.0", "7.0.0"];
        let stated = model.attribute("version").unwrap_or_default();
        self.builder.check_text(stated)?;
        let provenance = &mut self.builder.layout.provenance;
        crate::Format::OpenTcs
            .name()
            .clone_into(&mut provenance.format);
        stated.clone_into(&mut provenance.format_version);
        if !KNOWN.contains(&stated) {
            let message = || match stated {
                "" => "the file states no version".to_owned(),
                other => format!("the file states version {other}, which is not known"),
            };
            let remedy = "It is read by its structure; look whether the picture is right";
            self.report(Code::Version, model, message, remedy);
        }
        Ok(())
    }

    fn map_point(&mut self, point: Node<'d, 't>, drawing: &Drawing<'d>) -> Result<(), ReadError> {
        let name = self.name(point)?;
        let Some(position) = self.position(point, "pointLayout", drawing) else {
            return Ok(());
        };
        let row = self.builder.push_node(&name, position, None)?;
        if let Some(name) = point.attribute("name") {
            self.nodes.entry(name).or_insert(row);
        }
        self.text_attribute(Table::Nodes, row as usize, "type", point.attribute("type"))?;
        let layer = child(point, "pointLayout").and_then(|l| l.attribute("layerId"));
        let layer = layer.map(|id| drawing.layer_name(id));
        self.text_attribute(Table::Nodes, row as usize, "layer", layer)?;
        self.set_envelopes(Table::Nodes, row as usize, point)?;
        self.set_properties(Table::Nodes, row as usize, point)
    }

    fn map_location(
        &mut self,
        location: Node<'d, 't>,
        drawing: &Drawing<'d>,
    ) -> Result<(), ReadError> {
        let name = self.name(location)?;
        let position = self.position(location, "locationLayout", drawing);
        let mut nodes = Vec::new();
        for link in children(location, "link") {
            let point = link.attribute("point").unwrap_or_default();
            match self.nodes.get(point) {
                Some(&row) => nodes.push(row),
                None => self.report_unknown_node(location, point),
            }
        }
        let row = self.builder.push_station(&name, position, nodes, None)? as usize;
        self.text_attribute(Table::Stations, row, "type", location.attribute("type"))?;
        self.bool_attribute(Table::Stations, row, "locked", location)?;
        self.set_properties(Table::Stations, row, location)
    }

    /// Where something is: as drawn where the file says so, else as in the plant.
    fn position(
        &mut self,
        node: Node<'d, 't>,
        layout_tag: &'static str,
        drawing: &Drawing<'d>,
    ) -> Option<Point<f64>> {
        let plant = self.point(node);
        let drawn = match child(node, layout_tag) {
            Some(layout) => self.point(layout),
            None => self.legacy_position(node, drawing),
        };
        let Some(position_mm) = drawn.or(plant) else {
            let message = || "there is no position".to_owned();
            let remedy = "Give it one in the tool that wrote the file";
            self.report(Code::MissingField, node, message, remedy);
            return None;
        };
        let position = position_mm * 1e-3;
        let xml = self.xml;
        if !self.builder.check_point(position, &|| xml.place(node)) {
            return None;
        }
        if let (Some(plant), Some(drawn)) = (plant, drawn) {
            let apart = plant.distance(drawn) * 1e-3;
            if apart > SAME_POSITION_M {
                self.moved += 1;
                self.farthest_m = self.farthest_m.max(apart);
            }
        }
        Some(position)
    }

    fn point(&mut self, node: Node<'d, 't>) -> Option<Point<f64>> {
        let x = self.number(node, &["positionX", "xPosition"]);
        let y = self.number(node, &["positionY", "yPosition"]);
        Some(Point::new(x?, y?))
    }

    fn legacy_position(&mut self, node: Node<'d, 't>, drawing: &Drawing<'d>) -> Option<Point<f64>> {
        let drawn = drawing.of(node.attribute("name")?)?;
        let x = self.parse(node, "POSITION_X", drawn.x?);
        let y = self.parse(node, "POSITION_Y", drawn.y?);
        Some(Point::new(x?, y?))
    }

    /// A number under the first of the names that is there. Says so if it is none.
    pub(super) fn number(&mut self, node: Node<'d, 't>, keys: &[&'static str]) -> Option<f64> {
        let found = keys
            .iter()
            .find_map(|key| Some((*key, node.attribute(*key)?)));
        let (key, text) = found?;
        self.parse(node, key, text)
    }

    pub(super) fn parse(&mut self, node: Node<'d, 't>, key: &str, text: &str) -> Option<f64> {
        let number = text.trim().parse().ok();
        if number.is_none() {
            let start: String = text.chars().take(40).collect();
            let message = || format!("{key} is \"{start}\", a number was expected");
            self.report(Code::WrongType, node, message, "Correct the number");
        }
        number
    }

    /// The name of an element. Where there is none, the tag stands for it.
    pub(super) fn name(&mut self, node: Node<'d, 't>) -> Result<String, ReadError> {
        let Some(name) = node.attribute("name") else {
            let message = || "there is no name".to_owned();
            self.report(Code::MissingField, node, message, "Give it a name");
            return Ok(self.xml.place(node).to_string());
        };
        self.builder.check_text(name)?;
        Ok(name.to_owned())
    }

    /// Records a finding at an element.
    pub(super) fn report(
        &mut self,
        code: Code,
        node: Node<'d, 't>,
        message: impl FnOnce() -> String,
        remedy: &str,
    ) {
        let xml = self.xml;
        self.builder
            .report(code, &|| xml.place(node), message, remedy);
    }

    pub(super) fn report_unknown_node(&mut self, node: Node<'d, 't>, point: &str) {
        let message = || format!("the point \"{point}\" is not there or has no position");
        let remedy = "Add the point, or correct the name";
        self.report(Code::UnknownNode, node, message, remedy);
    }

    pub(super) fn text_attribute(
        &mut self,
        table: Table,
        row: usize,
        name: &str,
        text: Option<&str>,
    ) -> Result<(), ReadError> {
        let Some(text) = text else {
            return Ok(());
        };
        self.builder.check_text(text)?;
        self.builder.set(table, row, name, Value::Text(text))
    }

    pub(super) fn bool_attribute(
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
                let start: String = other.chars().take(40).collect();
                let message = || format!("{name} is \"{start}\", true or false was expected");
                self.report(Code::WrongType, node, message, "Correct the value");
                return Ok(());
            }
            None => return Ok(()),
        };
        self.builder.set(table, row, name, Value::Bool(value))
    }

    /// Sets a column for each property of an element.
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
                if self.properties.len() == MOST_PROPERTIES {
                    let message = || format!("more than {MOST_PROPERTIES} different properties");
                    let remedy = "The others are left out";
                    self.report(Code::Attribute, property, message, remedy);
                    continue;
                }
                self.builder.check_text(name)?;
                self.properties.insert(name);
            }
            if seen.insert(name) {
                self.text_attribute(table, row, &format!("property.{name}"), value)?;
            }
        }
        Ok(())
    }

    fn report_moved(&mut self) {
        let (moved, farthest) = (self.moved, self.farthest_m);
        if moved > 0 {
            let at = || Place::element("points and locations");
            let message = || {
                format!(
                    "{moved} of them are drawn up to {farthest:.3} m from their position in the plant"
                )
            };
            let remedy = "They are shown as drawn, where the curves meet them";
            self.builder
                .report(Code::LegacyPosition, &at, message, remedy);
        }
    }

    fn count(&mut self, model: Node<'d, 't>) {
        let tags = ["point", "path", "location", "vehicle", "block"];
        let mut counts: Vec<(String, u64)> = tags
            .iter()
            .map(|&tag| (format!("{tag}s"), children(model, tag).count() as u64))
            .collect();
        let paths = children(model, "path");
        let envelopes = paths
            .map(|p| children(p, "vehicleEnvelope").count() as u64)
            .sum();
        counts.push(("controlPoints".into(), self.control_points));
        counts.push(("envelopes".into(), envelopes));
        let layouts = children(model, "visualLayout");
        let layers = layouts.map(|l| children(l, "layer").count() as u64).sum();
        counts.push(("layers".into(), layers));
        counts.append(&mut self.connection_types);
        self.builder.layout.provenance.counts = counts;
    }
}

/// The name of an element, empty where there is none.
pub(super) fn name_of<'d>(node: Node<'d, '_>) -> &'d str {
    node.attribute("name").unwrap_or_default()
}
