//! Maps a plant model to a layout: points to nodes, locations to stations, blocks to a column.

use std::collections::HashMap;

use guideway_layout::{Code, Layout, Place};
use guideway_spline::Point;
use roxmltree::Node;

use super::envelope::set_envelopes;
use super::path_mapper::{PathCounts, PathMapper};
use super::reader::{PlantReader, name_or_empty};
use super::visual_layout::VisualLayout;
use crate::ReadError;
use crate::builder::Table;
use crate::source::Source;
use crate::xml::{Xml, child, children};

/// Positions nearer than this are equal. Derived: half of the file's resolution of 1 mm.
const SAME_POSITION_M: f64 = 5e-4;

/// Fills a layout from a model.
pub(super) struct PlantMapper<'a, 'd, 't> {
    reader: PlantReader<'a, 'd, 't>,
    /// Row per point name.
    nodes: HashMap<&'d str, u32>,
    /// Number of points and locations whose drawn position differs from that in the plant.
    moved: u64,
    /// Largest distance between the two positions, in meters.
    max_shift_m: f64,
}

impl<'a, 'd, 't> PlantMapper<'a, 'd, 't> {
    pub(super) fn new(source: Source<'a>, xml: &'d Xml<'t>, file_bytes: usize) -> Self {
        Self {
            reader: PlantReader::new(source, xml, file_bytes),
            nodes: HashMap::new(),
            moved: 0,
            max_shift_m: 0.0,
        }
    }

    /// Maps the whole model and returns the layout.
    ///
    /// # Errors
    /// When the layout exceeds a limit, or when the caller cancels.
    pub(super) fn read(mut self, model: Node<'d, 't>) -> Result<Layout, ReadError> {
        let visual = VisualLayout::read(&mut self.reader, model);
        self.map_version(model)?;
        for point in children(model, "point") {
            self.map_point(point, &visual)?;
        }
        let blocks = blocks_by_member(model);
        let mut paths = PathMapper::new(&mut self.reader, &visual, &self.nodes, &blocks);
        for path in children(model, "path") {
            paths.map_path(path)?;
        }
        let counts = paths.into_counts();
        for location in children(model, "location") {
            self.map_location(location, &visual)?;
        }
        self.report_moved();
        let mut layout = self.reader.base.builder.layout;
        layout.provenance.counts = element_counts(model, counts);
        Ok(layout)
    }

    fn map_version(&mut self, model: Node<'d, 't>) -> Result<(), ReadError> {
        const KNOWN: &[&str] = &["0.0.2", "0.0.3", "0.0.4", "0.0.5", "6.0.0", "7.0.0"];
        let version = model.attribute("version").unwrap_or_default();
        let builder = &mut self.reader.base.builder;
        builder.check_text(version)?;
        let provenance = &mut builder.layout.provenance;
        crate::Format::OpenTcs
            .name()
            .clone_into(&mut provenance.format);
        version.clone_into(&mut provenance.format_version);
        if !KNOWN.contains(&version) {
            let message = || match version {
                "" => "the file states no version".to_owned(),
                other => format!("the file states the unknown version {other}"),
            };
            let remedy = "It is read by its structure; check that the picture is right";
            self.reader
                .base
                .report(Code::Version, model, message, remedy);
        }
        Ok(())
    }

    fn map_point(
        &mut self,
        point: Node<'d, 't>,
        visual: &VisualLayout<'d>,
    ) -> Result<(), ReadError> {
        let name = self.reader.name(point)?;
        let Some(position_m) = self.position_m(point, "pointLayout", visual) else {
            return Ok(());
        };
        let reader = &mut self.reader;
        let row = reader.base.builder.push_node(&name, position_m, None)?;
        if let Some(name) = point.attribute("name") {
            self.nodes.entry(name).or_insert(row);
        }
        let (table, row) = (Table::Nodes, row as usize);
        reader.set_text(table, row, "type", point.attribute("type"))?;
        let layer = child(point, "pointLayout").and_then(|l| l.attribute("layerId"));
        let layer = layer.map(|id| visual.layer_name(id));
        reader.set_text(table, row, "layer", layer)?;
        set_envelopes(reader, table, row, point)?;
        reader.set_properties(table, row, point)
    }

    fn map_location(
        &mut self,
        location: Node<'d, 't>,
        visual: &VisualLayout<'d>,
    ) -> Result<(), ReadError> {
        let name = self.reader.name(location)?;
        let position_m = self.position_m(location, "locationLayout", visual);
        let reader = &mut self.reader;
        let mut nodes = Vec::new();
        for link in children(location, "link") {
            let point = link.attribute("point").unwrap_or_default();
            match self.nodes.get(point) {
                Some(&row) => nodes.push(row),
                None => reader.report_unknown_point(location, point),
            }
        }
        let builder = &mut reader.base.builder;
        let row = builder.push_station(&name, position_m, nodes, None)? as usize;
        reader.set_text(Table::Stations, row, "type", location.attribute("type"))?;
        reader.set_bool(Table::Stations, row, "locked", location)?;
        reader.set_properties(Table::Stations, row, location)
    }

    /// The drawn position of an element, or else its position in the plant.
    fn position_m(
        &mut self,
        node: Node<'d, 't>,
        layout_tag: &'static str,
        visual: &VisualLayout<'d>,
    ) -> Option<Point<f64>> {
        let plant_mm = self.position_mm(node);
        let drawn_mm = match child(node, layout_tag) {
            Some(layout) => self.position_mm(layout),
            None => self.legacy_position_mm(node, visual),
        };
        let Some(position_mm) = drawn_mm.or(plant_mm) else {
            let message = || "it has no position".to_owned();
            let remedy = "Give it one in the tool that wrote the file";
            self.reader
                .base
                .report(Code::MissingField, node, message, remedy);
            return None;
        };
        let position_m = position_mm * 1e-3;
        if !self.reader.base.check_point(position_m, node) {
            return None;
        }
        if let (Some(plant_mm), Some(drawn_mm)) = (plant_mm, drawn_mm) {
            let shift_m = plant_mm.distance(drawn_mm) * 1e-3;
            if shift_m > SAME_POSITION_M {
                self.moved += 1;
                self.max_shift_m = self.max_shift_m.max(shift_m);
            }
        }
        Some(position_m)
    }

    fn position_mm(&mut self, node: Node<'d, 't>) -> Option<Point<f64>> {
        let x = self.reader.number(node, &["positionX", "xPosition"]);
        let y = self.reader.number(node, &["positionY", "yPosition"]);
        Some(Point::new(x?, y?))
    }

    /// The drawn position in a file up to version 0.0.3.
    fn legacy_position_mm(
        &mut self,
        node: Node<'d, 't>,
        visual: &VisualLayout<'d>,
    ) -> Option<Point<f64>> {
        let element = visual.legacy_element(node.attribute("name")?)?;
        let x = self.reader.parse_number(node, "POSITION_X", element.x?);
        let y = self.reader.parse_number(node, "POSITION_Y", element.y?);
        Some(Point::new(x?, y?))
    }

    fn report_moved(&mut self) {
        let (moved, max_m) = (self.moved, self.max_shift_m);
        if moved > 0 {
            let at = || Place::element("points and locations");
            let message = || {
                format!("{moved} of them are drawn up to {max_m:.3} m from their plant position")
            };
            let remedy = "They are shown as drawn, where the curves meet them";
            self.reader
                .base
                .builder
                .report(Code::LegacyPosition, &at, message, remedy);
        }
    }
}

/// The names of the blocks per member.
fn blocks_by_member<'d>(model: Node<'d, '_>) -> HashMap<&'d str, Vec<&'d str>> {
    let mut blocks: HashMap<&str, Vec<&str>> = HashMap::new();
    for block in children(model, "block") {
        for member in children(block, "member").filter_map(|m| m.attribute("name")) {
            blocks.entry(member).or_default().push(name_or_empty(block));
        }
    }
    blocks
}

fn element_counts(model: Node<'_, '_>, paths: PathCounts) -> Vec<(String, u64)> {
    let nested = |outer: &'static str, inner: &'static str| {
        let outer = children(model, outer);
        outer.map(|o| children(o, inner).count() as u64).sum()
    };
    let tags = ["point", "path", "location", "vehicle", "block"];
    let mut counts: Vec<(String, u64)> = tags
        .iter()
        .map(|&tag| (format!("{tag}s"), children(model, tag).count() as u64))
        .collect();
    counts.push(("controlPoints".into(), paths.control_points));
    counts.push(("envelopes".into(), nested("path", "vehicleEnvelope")));
    counts.push(("layers".into(), nested("visualLayout", "layer")));
    counts.extend(paths.connection_types);
    counts
}
