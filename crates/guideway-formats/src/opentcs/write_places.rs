//! Writes points and locations of a plant.

use std::io::{self, Write};

use guideway_layout::{Attributes, Value};
use guideway_spline::Point;
use serde_json::{Map, Value as Json};

use super::context::Context;
use super::elements::{BOUNDING_BOX, REPRESENTATIONS};
use super::envelope::{AREA_COLUMN, KEY_COLUMN};
use super::held::{Areas, POINT_TYPES, held_by_node, held_by_station};
use super::layers::Layers;
use super::plant::{kind_of, to_mm};
use super::plant_mapper::{
    BOX_COLUMN, DEFAULT_REPRESENTATION, LABEL_OFFSET, LINK_OPERATIONS, REPRESENTATION,
};
use super::values::{SAME_M, SAME_NUMBER, json, number};
use super::version::Version;
use super::write_elements::write_fields;
use super::xml_writer::XmlWriter;
use crate::Losses;
use crate::fields::{Vocabulary, field};

/// Step to which angles are rounded that it changes by their rounding errors only, in degrees.
const ANGLE_STEP_DEG: f64 = 1e-9;

/// Attributes of the position in the plant, by axis.
const PLANT_POSITION: [&str; 3] = ["positionX", "positionY", "positionZ"];

/// Counts what rounding changes.
#[derive(Default)]
pub(super) struct Rounding {
    positions: usize,
    /// Positions in the plant, by axis.
    plant: [usize; 3],
    angles: usize,
    envelopes: usize,
    unmatched_envelopes: usize,
}

impl Rounding {
    /// Whole millimeters of a number in meters, and whether they are another number.
    fn mm(meters: f64, is_rounded: &mut bool) -> i64 {
        let mm = (meters * 1e3).round();
        *is_rounded |= (mm - meters * 1e3).abs() > SAME_NUMBER * mm.abs();
        mm as i64
    }

    fn check_position(&mut self, position: Point<f64>) {
        let [x, y] = to_mm(position).map(|mm| mm as f64 / 1e3);
        self.positions += usize::from(position.distance(Point::new(x, y)) > SAME_M);
    }

    /// Lists the changes. `of` names the rows, such as `nodes`.
    pub(super) fn add_to(self, of: &str, losses: &mut Losses) {
        let detail = format!("positions of {of}, rounded to millimeters");
        losses.add("positions", self.positions, detail);
        let detail = format!("values of {of}, rounded to millimeters");
        for (name, count) in PLANT_POSITION.into_iter().zip(self.plant) {
            losses.add(format!("column {name}"), count, detail.clone());
        }
        losses.add(format!("column {AREA_COLUMN}"), self.envelopes, detail);
        let detail = format!("values of {of} beyond a full turn: written within it");
        losses.add("column theta", self.angles, detail);
        let detail = format!("values of {of} without a key per area");
        for name in [KEY_COLUMN, AREA_COLUMN] {
            losses.add(
                format!("column {name}"),
                self.unmatched_envelopes,
                detail.clone(),
            );
        }
    }
}

/// Writes the points: the nodes of the layout, then new ones.
pub(super) fn write_points<W: Write>(
    context: &Context<'_>,
    layers: &mut Layers,
    xml: &mut XmlWriter<'_, W>,
    losses: &mut Losses,
) -> io::Result<()> {
    let &Context { layout, plant, .. } = context;
    let nodes = &layout.nodes;
    let mut rounding = Rounding::default();
    let mut outgoing: Vec<(u32, usize)> = Vec::new();
    for (path, ends) in plant.ends.iter().enumerate() {
        let is_reversed = context.drawn.get(path).is_some_and(|path| path.is_reversed);
        outgoing.extend(ends.map(|ends| (ends[usize::from(is_reversed)], path)));
    }
    outgoing.sort_unstable();
    let empty = Attributes::default();
    for (point, row) in plant.points.iter().zip(0_u32..) {
        let is_node = (row as usize) < nodes.len();
        // A new point has no columns; its layer is that of its path.
        let attributes = if is_node { &nodes.attributes } else { &empty };
        let value = |name: &str| attributes.value(row as usize, name);
        xml.begin("point")?;
        xml.attribute("name", &point.name)?;
        write_position(
            context,
            xml,
            attributes,
            row as usize,
            point.position_mm,
            &mut rounding,
        )?;
        if is_node {
            rounding.check_position(nodes.position_m(row));
        }
        let angle = angle_deg(value("theta"), &mut rounding);
        let angle = angle.map_or("NaN".to_owned(), |angle| format!("{angle:?}"));
        xml.attribute("vehicleOrientationAngle", angle)?;
        let kind = match value("type") {
            Some(Value::Text(kind)) if POINT_TYPES.contains(&kind) => kind,
            _ => POINT_TYPES[0],
        };
        xml.attribute("type", kind)?;
        let bounding_box: Map<String, Json> = json(value(BOX_COLUMN)).unwrap_or_default();
        xml.begin(BOX_COLUMN)?;
        write_fields(xml, &BOUNDING_BOX, &bounding_box)?;
        xml.end()?;
        write_envelopes(xml, attributes, row as usize, &mut rounding)?;
        let first = outgoing.partition_point(|&(point, _)| point < row);
        for &(_, path) in outgoing[first..]
            .iter()
            .take_while(|(point, _)| *point == row)
        {
            xml.element("outgoingPath", &[("name", &plant.path_names[path])])?;
        }
        let version = context.version;
        let held = |_, name: &str, value: Value<'_>| held_by_node(version, name, value);
        context
            .properties
            .write(xml, attributes, row as usize, held)?;
        let layer = match point.path {
            Some(path) => {
                let level = layout.paths.get(path).level();
                layers.id(layout, &layout.paths.attributes, path, level)
            }
            None => layers.id(layout, attributes, row as usize, nodes.level(row)),
        };
        xml.begin("pointLayout")?;
        write_label(context, xml, attributes, row as usize, point.position_mm)?;
        xml.attribute("layerId", layer)?;
        xml.end()?;
        xml.end()?;
    }
    rounding.add_to("nodes", losses);
    Ok(())
}

/// Writes the locations with their links.
pub(super) fn write_locations<W: Write>(
    context: &Context<'_>,
    layers: &mut Layers,
    xml: &mut XmlWriter<'_, W>,
    losses: &mut Losses,
) -> io::Result<()> {
    let &Context { layout, plant, .. } = context;
    let stations = &layout.stations;
    let mut rounding = Rounding::default();
    let (mut without_position, mut without_kind, mut lost_operations) = (0, 0, 0);
    for (name, station) in plant.station_names.iter().zip(0_u32..) {
        let row = station as usize;
        let value = |name: &str| stations.attributes.value(row, name);
        let links = stations.nodes(station);
        let position = stations.position_m(station).unwrap_or_else(|| {
            without_position += 1;
            let node = links.first();
            node.map_or(Point::default(), |&node| layout.nodes.position_m(node))
        });
        if stations.position_m(station).is_some() {
            rounding.check_position(position);
        }
        let position_mm = to_mm(position);
        xml.begin("location")?;
        xml.attribute("name", name)?;
        write_position(
            context,
            xml,
            &stations.attributes,
            row,
            position_mm,
            &mut rounding,
        )?;
        xml.attribute("locked", value("locked") == Some(Value::Bool(true)))?;
        let kind = kind_of(layout, row);
        without_kind += usize::from(kind.is_none());
        xml.attribute("type", plant.type_name(kind))?;
        let operations: Vec<Vec<String>> = json(value(LINK_OPERATIONS)).unwrap_or_default();
        lost_operations += usize::from(operations.len() > links.len());
        for (index, &node) in links.iter().enumerate() {
            xml.begin("link")?;
            xml.attribute("point", &plant.points[node as usize].name)?;
            for operation in operations.get(index).into_iter().flatten() {
                xml.element("allowedOperation", &[("name", operation)])?;
            }
            xml.end()?;
        }
        let version = context.version;
        let held = |_, name: &str, value: Value<'_>| held_by_station(version, name, value);
        context
            .properties
            .write(xml, &stations.attributes, row, held)?;
        xml.begin("locationLayout")?;
        write_label(context, xml, &stations.attributes, row, position_mm)?;
        let symbol = match value(REPRESENTATION) {
            Some(Value::Text(symbol)) if REPRESENTATIONS.contains(&symbol) => symbol,
            _ => DEFAULT_REPRESENTATION,
        };
        xml.attribute(REPRESENTATION, symbol)?;
        let level = stations.level(station);
        let layer = layers.id(layout, &stations.attributes, row, level);
        xml.attribute("layerId", layer)?;
        xml.end()?;
        xml.end()?;
    }
    rounding.add_to("stations", losses);
    let detail = "stations without a position: written at their first node, or at the origin";
    losses.add("positions", without_position, detail);
    let detail = "stations without a kind: written with a location type for them";
    losses.add("column kind", without_kind, detail);
    let detail = "values of stations with more entries than nodes";
    losses.add(format!("column {LINK_OPERATIONS}"), lost_operations, detail);
    Ok(())
}

/// Writes the position in the plant.
fn write_position<W: Write>(
    context: &Context<'_>,
    xml: &mut XmlWriter<'_, W>,
    attributes: &Attributes,
    row: usize,
    drawn_mm: [i64; 2],
    rounding: &mut Rounding,
) -> io::Result<()> {
    let axes = PLANT_POSITION.into_iter().zip(&mut rounding.plant);
    let drawn_mm = [drawn_mm[0], drawn_mm[1], 0];
    for ((name, rounded), (axis, drawn_mm)) in axes.zip(drawn_mm.into_iter().enumerate()) {
        let plant = number(attributes.value(row, name));
        let plant = plant.filter(|_| axis == 2 || context.version == Version::V6);
        let mut is_rounded = false;
        let mm = plant.map_or(drawn_mm, |meters| Rounding::mm(meters, &mut is_rounded));
        *rounded += usize::from(is_rounded);
        xml.attribute(name, mm)?;
    }
    Ok(())
}

/// Writes the drawn position, where the version has one, and the offset of the label.
fn write_label<W: Write>(
    context: &Context<'_>,
    xml: &mut XmlWriter<'_, W>,
    attributes: &Attributes,
    row: usize,
    drawn_mm: [i64; 2],
) -> io::Result<()> {
    if context.version == Version::V6 {
        xml.attribute("positionX", drawn_mm[0])?;
        xml.attribute("positionY", drawn_mm[1])?;
    }
    for (name, default) in ["labelOffsetX", "labelOffsetY"]
        .into_iter()
        .zip(LABEL_OFFSET)
    {
        let offset = match attributes.value(row, name) {
            Some(Value::Int(offset)) => offset,
            _ => default,
        };
        xml.attribute(name, offset)?;
    }
    Ok(())
}

/// The orientation at a point, in degrees from -360 to 360, as openTCS requires.
fn angle_deg(value: Option<Value<'_>>, rounding: &mut Rounding) -> Option<f64> {
    let field = field(Vocabulary::OpenTcs, "vehicleOrientationAngle")?;
    let angle = field.of_si(number(value)?);
    let within = if angle.abs() > 360.0 {
        angle % 360.0
    } else {
        angle
    };
    rounding.angles += usize::from(within != angle);
    // Adding zero maps -0 to 0.
    let round = (within / ANGLE_STEP_DEG).round() * ANGLE_STEP_DEG + 0.0;
    let is_same = (round - within).abs() <= SAME_NUMBER * within.abs();
    Some(if is_same { round } else { within })
}

/// Writes the envelopes of a row.
pub(super) fn write_envelopes<W: Write>(
    xml: &mut XmlWriter<'_, W>,
    attributes: &Attributes,
    row: usize,
    rounding: &mut Rounding,
) -> io::Result<()> {
    let keys: Vec<String> = json(attributes.value(row, KEY_COLUMN)).unwrap_or_default();
    let areas: Areas = json(attributes.value(row, AREA_COLUMN)).unwrap_or_default();
    rounding.unmatched_envelopes += usize::from(keys.len() != areas.len());
    let mut is_rounded = false;
    for (key, [ring]) in keys.iter().zip(&areas) {
        xml.begin(KEY_COLUMN)?;
        xml.attribute("key", key)?;
        for &[x, y] in ring {
            let [x, y] = [x, y].map(|meters| Rounding::mm(meters, &mut is_rounded));
            xml.element("vertex", &[("x", &x), ("y", &y)])?;
        }
        xml.end()?;
    }
    rounding.envelopes += usize::from(is_rounded);
    Ok(())
}
