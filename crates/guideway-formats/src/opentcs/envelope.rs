//! Reads vehicle envelopes: the areas that vehicles occupy on a path or point, one polygon per key.

use guideway_layout::Code;
use guideway_spline::Point;
use roxmltree::Node;
use serde_json::Value;

use super::elements::ANY;
use super::reader::PlantReader;
use crate::ReadError;
use crate::builder::Table;
use crate::xml::children;

/// Column of the keys of envelopes: a JSON array of texts, one per polygon of [`AREA_COLUMN`].
pub(super) const KEY_COLUMN: &str = "vehicleEnvelope";

/// Column of the areas: the coordinates of a GeoJSON MultiPolygon, in meters.
pub(super) const AREA_COLUMN: &str = "vehicleEnvelope.area";

/// Stores the envelopes of an element as two columns: their keys, and their areas as the
/// coordinates of a GeoJSON MultiPolygon (RFC 7946, 3.1.7), in meters. Keeps an envelope that is no
/// area as it is.
///
/// # Errors
/// When the layout exceeds a limit.
pub(super) fn set_envelopes<'d, 't>(
    reader: &mut PlantReader<'_, 'd, 't>,
    table: Table,
    row: usize,
    element: Node<'d, 't>,
) -> Result<(), ReadError> {
    let (mut keys, mut areas) = (Vec::new(), Vec::new());
    for envelope in children(element, KEY_COLUMN) {
        match read_ring(reader, envelope) {
            Some(ring) => {
                keys.push(envelope.attribute("key").unwrap_or_default());
                areas.push([ring]);
            }
            None => reader.keep(KEY_COLUMN, ANY.to_json(envelope).into()),
        }
    }
    if keys.is_empty() {
        return Ok(());
    }
    reader.set_json(table, row, KEY_COLUMN, Some(keys.into()))?;
    reader.set_json(table, row, AREA_COLUMN, Some(Value::from(areas)))
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
    let corner = Point::new(x_mm / 1e3, y_mm / 1e3);
    let is_valid = reader.base.check_point(corner, vertex);
    is_valid.then_some([corner.x, corner.y])
}
