//! Maps a plant model to a layout: points to nodes, locations to stations.

use std::collections::{HashMap, HashSet};

use guideway_layout::{Code, Layout, Place};
use guideway_spline::Point;
use roxmltree::Node;

use super::elements::BOUNDING_BOX;
use super::envelope::{KEY_COLUMN, set_envelopes};
use super::group_mapper::GroupMapper;
use super::path_mapper::{PathCounts, PathMapper};
use super::reader::{Known, PlantReader, name_or_empty};
use super::visual_layout::VisualLayout;
use crate::ReadError;
use crate::builder::Table;
use crate::source::Source;
use crate::xml::{Xml, child, children};

/// Positions nearer than this are equal. Derived: half of the file's resolution of 1 mm.
pub(super) const SAME_POSITION_M: f64 = 5e-4;

/// Offset of a label in a new model, in layout units.
pub(super) const LABEL_OFFSET: [i64; 2] = [-10, -20];

/// Use of a point in a new model.
pub(super) const DEFAULT_POINT_TYPE: &str = "HALT_POSITION";

/// Symbol of a location in a new model.
pub(super) const DEFAULT_REPRESENTATION: &str = "DEFAULT";

/// Column of the operations per node of a station: a JSON array of arrays of names.
pub(super) const LINK_OPERATIONS: &str = "linkOperations";

/// Columns of nodes and stations.
pub(super) const BOX_COLUMN: &str = "maxVehicleBoundingBox";
pub(super) const REPRESENTATION: &str = "locationRepresentation";

const POINT: Known = Known {
    attributes: &[
        "name",
        "positionX",
        "positionY",
        "positionZ",
        "xPosition",
        "yPosition",
        "zPosition",
        "vehicleOrientationAngle",
        "type",
    ],
    children: &[
        BOX_COLUMN,
        KEY_COLUMN,
        "outgoingPath",
        "property",
        "pointLayout",
    ],
};

const LOCATION: Known = Known {
    attributes: &[
        "name",
        "positionX",
        "positionY",
        "positionZ",
        "xPosition",
        "yPosition",
        "zPosition",
        "type",
        "locked",
    ],
    children: &["link", "property", "locationLayout"],
};

/// Attributes of `pointLayout` and `locationLayout`.
const ELEMENT_LAYOUT: &[&str] = &[
    "positionX",
    "positionY",
    "xPosition",
    "yPosition",
    "labelOffsetX",
    "labelOffsetY",
    "xLabelOffset",
    "yLabelOffset",
    "layerId",
    REPRESENTATION,
];

/// The two positions of an element, in meters.
struct Position {
    drawn: Point<f64>,
    /// Position in the plant, if it is another one.
    plant: Option<Point<f64>>,
}

/// Fills a layout from a model.
pub(super) struct PlantMapper<'a, 'd, 't> {
    reader: PlantReader<'a, 'd, 't>,
    visual: VisualLayout<'d, 't>,
    /// Row per point name.
    nodes: HashMap<&'d str, u32>,
    /// Row per location name.
    stations: HashMap<&'d str, u32>,
    /// Number of points and locations whose drawn position differs from that in the plant.
    moved: u64,
    /// Largest distance between the two positions, in meters.
    max_shift_m: f64,
}

impl<'a, 'd, 't> PlantMapper<'a, 'd, 't> {
    pub(super) fn new(
        source: Source<'a>,
        xml: &'d Xml<'t>,
        file_bytes: usize,
        model: Node<'d, 't>,
    ) -> Self {
        let mut reader = PlantReader::new(source, xml, file_bytes);
        Self {
            visual: VisualLayout::read(&mut reader, model),
            reader,
            nodes: HashMap::new(),
            stations: HashMap::new(),
            moved: 0,
            max_shift_m: 0.0,
        }
    }

    /// Maps the whole model and returns the layout.
    ///
    /// # Errors
    /// When the layout exceeds a limit, or when the caller cancels.
    pub(super) fn read(mut self, model: Node<'d, 't>) -> Result<Layout, ReadError> {
        self.map_version(model)?;
        self.reader.base.refuse_includes()?;
        let leaving =
            children(model, "path").map(|p| (p.attribute("sourcePoint"), name_or_empty(p)));
        let leaving: HashSet<_> = leaving.collect();
        for point in children(model, "point") {
            self.map_point(point, &leaving)?;
        }
        let mut paths = PathMapper::new(&mut self.reader, &self.visual, &self.nodes);
        for path in children(model, "path") {
            paths.map_path(path)?;
        }
        let (paths, counts) = paths.finish();
        for location in children(model, "location") {
            self.map_location(location)?;
        }
        self.report_moved();
        let mut groups = GroupMapper {
            reader: &mut self.reader,
            visual: &self.visual,
            paths: &paths,
            nodes: &self.nodes,
            stations: &self.stations,
        };
        groups.map_groups(model)?;
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
        leaving: &HashSet<(Option<&str>, &str)>,
    ) -> Result<(), ReadError> {
        self.reader.begin();
        let name = self.reader.name(point)?;
        let Some(position) = self.position(point, "pointLayout") else {
            return Ok(());
        };
        let reader = &mut self.reader;
        let row = reader.base.push_node(point, &name, position.drawn)?;
        if let Some(name) = point.attribute("name") {
            self.nodes.entry(name).or_insert(row);
        }
        let (table, row) = (Table::Nodes, row as usize);
        let kind = point.attribute("type");
        let kind = kind.filter(|kind| *kind != DEFAULT_POINT_TYPE);
        reader.set_text(table, row, "type", kind)?;
        let angle = reader.number(point, &["vehicleOrientationAngle"]);
        let angle = angle.filter(|angle| !angle.is_nan());
        reader.set_field(table, row, "vehicleOrientationAngle", angle)?;
        self.set_placement(table, row, point, "pointLayout", position)?;
        let reader = &mut self.reader;
        let mut boxes = children(point, BOX_COLUMN).map(|n| BOUNDING_BOX.to_json(n));
        let default = BOUNDING_BOX.default_json();
        let bounding_box = boxes.next().filter(|b| *b != default).map(Into::into);
        reader.set_json(table, row, BOX_COLUMN, bounding_box)?;
        for path in children(point, "outgoingPath").map(name_or_empty) {
            if !leaving.contains(&(point.attribute("name"), path)) {
                let message = || format!("no path \"{path}\" begins here");
                let remedy = "The entry `outgoingPath` is left out; remove it or add the path";
                reader.base.report(Code::Attribute, point, message, remedy);
            }
        }
        set_envelopes(reader, table, row, point)?;
        reader.finish(table, row, point, &POINT)
    }

    fn map_location(&mut self, location: Node<'d, 't>) -> Result<(), ReadError> {
        self.reader.begin();
        let name = self.reader.name(location)?;
        let position = self.position(location, "locationLayout");
        let reader = &mut self.reader;
        let (mut nodes, mut operations) = (Vec::new(), Vec::new());
        for link in children(location, "link") {
            let point = link.attribute("point").unwrap_or_default();
            match self.nodes.get(point) {
                Some(&row) => {
                    nodes.push(row);
                    let names = children(link, "allowedOperation").map(name_or_empty);
                    operations.push(names.collect::<Vec<_>>());
                }
                None => {
                    reader.report_unknown_point(location, point);
                    reader.keep("link", super::elements::ANY.to_json(link).into());
                }
            }
        }
        let drawn = position.as_ref().map(|position| position.drawn);
        let row = reader.base.push_station(location, &name, drawn, nodes)?;
        if let Some(name) = location.attribute("name") {
            self.stations.entry(name).or_insert(row);
        }
        let (table, row) = (Table::Stations, row as usize);
        reader.set_text(table, row, "kind", location.attribute("type"))?;
        reader.set_locked(table, row, location)?;
        let has_operations = operations.iter().any(|names| !names.is_empty());
        let operations = has_operations.then(|| operations.into());
        reader.set_json(table, row, LINK_OPERATIONS, operations)?;
        let layout = child(location, "locationLayout");
        let symbol = layout.and_then(|layout| layout.attribute(REPRESENTATION));
        let symbol = symbol.filter(|symbol| *symbol != DEFAULT_REPRESENTATION);
        reader.set_text(table, row, REPRESENTATION, symbol)?;
        if let Some(position) = position {
            self.set_placement(table, row, location, "locationLayout", position)?;
        }
        self.reader.finish(table, row, location, &LOCATION)
    }

    /// Stores the position in the plant, the layer and the offset of the label.
    fn set_placement(
        &mut self,
        table: Table,
        row: usize,
        node: Node<'d, 't>,
        layout_tag: &'static str,
        position: Position,
    ) -> Result<(), ReadError> {
        let reader = &mut self.reader;
        if let Some(plant) = position.plant {
            for (name, meters) in [("positionX", plant.x), ("positionY", plant.y)] {
                let attributes = reader.base.builder.attributes(table);
                let quantity = guideway_layout::Quantity::Length;
                attributes.set_quantity(row, name, meters, quantity);
            }
        }
        if let Some(z_mm) = reader.number(node, &["positionZ", "zPosition"]) {
            reader.set_length_mm(table, row, "positionZ", z_mm);
        }
        let (name, layout) = (name_or_empty(node), child(node, layout_tag));
        reader.set_text(table, row, "layer", self.visual.layer(name, layout))?;
        let legacy = self.visual.legacy_element(name);
        let attribute = |names: [&'static str; 2]| {
            let layout = layout?;
            names.into_iter().find_map(|name| layout.attribute(name))
        };
        let offsets = [
            ("labelOffsetX", "xLabelOffset"),
            ("labelOffsetY", "yLabelOffset"),
        ];
        for (axis, (name, old_name)) in offsets.into_iter().enumerate() {
            let text = attribute([name, old_name]);
            let text = text.or_else(|| legacy?.label_offset[axis]);
            reader.set_int(table, row, name, (text, LABEL_OFFSET[axis]))?;
        }
        if let Some(layout) = layout {
            reader.keep_unknown(layout, ELEMENT_LAYOUT);
        }
        let unread = legacy.and_then(|legacy| legacy.unread());
        unread
            .into_iter()
            .for_each(|unread| reader.keep("modelLayoutElement", unread));
        Ok(())
    }

    /// The drawn position of an element, or else its position in the plant.
    fn position(&mut self, node: Node<'d, 't>, layout_tag: &'static str) -> Option<Position> {
        let plant = self.position_m(node);
        let drawn = match child(node, layout_tag) {
            Some(layout) => self.position_m(layout),
            None => self.legacy_position_m(node),
        };
        let Some(position) = drawn.or(plant) else {
            let message = || "it has no position".to_owned();
            let remedy = "Give it one in the tool that wrote the file";
            self.reader
                .base
                .report(Code::MissingField, node, message, remedy);
            return None;
        };
        if !self.reader.base.check_point(position, node) {
            return None;
        }
        let is_other = |plant: &Point<f64>| plant.distance(position) > SAME_POSITION_M;
        let plant = plant.filter(|plant| plant.is_finite() && is_other(plant));
        if let Some(plant) = plant {
            self.moved += 1;
            self.max_shift_m = self.max_shift_m.max(plant.distance(position));
        }
        Some(Position {
            drawn: position,
            plant,
        })
    }

    fn position_m(&mut self, node: Node<'d, 't>) -> Option<Point<f64>> {
        let x_mm = self.reader.number(node, &["positionX", "xPosition"]);
        let y_mm = self.reader.number(node, &["positionY", "yPosition"]);
        Some(Point::new(x_mm? / 1e3, y_mm? / 1e3))
    }

    /// The drawn position in a file up to version 0.0.3.
    fn legacy_position_m(&mut self, node: Node<'d, 't>) -> Option<Point<f64>> {
        let element = self.visual.legacy_element(node.attribute("name")?)?;
        let x_mm = self.reader.parse_number(node, "POSITION_X", element.x?);
        let y_mm = self.reader.parse_number(node, "POSITION_Y", element.y?);
        Some(Point::new(x_mm? / 1e3, y_mm? / 1e3))
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
