//! Reads vehicle envelopes: the areas that vehicles occupy on a path or point, one polygon per key.

use guideway_layout::{Code, Value};
use guideway_spline::Point;
use roxmltree::Node;

use super::reader::PlantReader;
use crate::ReadError;
use crate::builder::Table;
use crate::xml::children;

/// Stores the envelopes of an element as two columns: their keys, and their areas as the
/// coordinates of a GeoJSON MultiPolygon (RFC 7946, 3.1.7), in meters.
///
/// # Errors
/// When a text exceeds its limit.
pub(super) fn set_envelopes<'d, 't>(
    reader: &mut PlantReader<'_, 'd, 't>,
    table: Table,
    row: usize,
    element: Node<'d, 't>,
) -> Result<(), ReadError> {
    let (mut keys, mut areas) = (Vec::new(), Vec::new());
    for envelope in children(element, "vehicleEnvelope") {
        keys.extend(envelope.attribute("key"));
        areas.extend(read_ring(reader, envelope).map(|ring| [ring]));
    }
    if !keys.is_empty() {
        reader.set_text(table, row, "vehicleEnvelope", Some(&keys.join(", ")))?;
    }
    if areas.is_empty() {
        return Ok(());
    }
    let area = serde_json::Value::from(areas).to_string();
    let area = Value::Text(&area);
    let builder = &mut reader.base.builder;
    builder.set(table, row, "vehicleEnvelope.area", area)
}

/// The corners of an envelope in meters, closed by the first one. `None`, with a finding, if a
/// corner is invalid or there are fewer than three.
fn read_ring<'d, 't>(
    reader: &mut PlantReader<'_, 'd, 't>,
    envelope: Node<'d, 't>,
) -> Option<Vec<[f64; 2]>> {
    let mut ring = Vec::new();
    for vertex in children(envelope, "vertex") {
        ring.push(read_corner(reader, vertex)?);
    }
    if ring.first() != ring.last() {
        ring.extend(ring.first().copied());
    }
    if ring.len() < 4 {
        let message = || "the envelope has fewer than three corners".to_owned();
        let remedy = "Give it at least three, or remove it";
        reader
            .base
            .report(Code::MissingField, envelope, message, remedy);
        return None;
    }
    Some(ring)
}

/// A corner in meters; `None`, with a finding, if it is invalid.
fn read_corner<'d, 't>(
    reader: &mut PlantReader<'_, 'd, 't>,
    vertex: Node<'d, 't>,
) -> Option<[f64; 2]> {
    for key in ["x", "y"] {
        if vertex.attribute(key).is_none() {
            let message = || format!("a corner of the envelope has no {key}");
            let remedy = "Give it one; the envelope is left out";
            reader
                .base
                .report(Code::MissingField, vertex, message, remedy);
            return None;
        }
    }
    let x_mm = reader.number(vertex, &["x"])?;
    let y_mm = reader.number(vertex, &["y"])?;
    let corner = Point::new(x_mm, y_mm) * 1e-3;
    let is_valid = reader.base.check_point(corner, vertex);
    is_valid.then_some([corner.x, corner.y])
}
