//! The areas that vehicles of some kind may occupy: polygons in the plant, one for each envelope key.

use guideway_layout::{Code, Value};
use guideway_spline::Point;
use roxmltree::Node;

use super::plant::Plant;
use crate::ReadError;
use crate::builder::Table;
use crate::xml::children;

impl<'d, 't> Plant<'_, 'd, 't> {
    /// Keys of envelopes as one column, their areas as another: the coordinates of a GeoJSON MultiPolygon
    /// (RFC 7946, 3.1.7), in meters.
    pub(super) fn set_envelopes(
        &mut self,
        table: Table,
        row: usize,
        element: Node<'d, 't>,
    ) -> Result<(), ReadError> {
        let (mut keys, mut areas) = (Vec::new(), Vec::new());
        for envelope in children(element, "vehicleEnvelope") {
            keys.extend(envelope.attribute("key"));
            areas.extend(self.ring(envelope).map(|ring| [ring]));
        }
        if !keys.is_empty() {
            self.text_attribute(table, row, "vehicleEnvelope", Some(&keys.join(", ")))?;
        }
        if areas.is_empty() {
            return Ok(());
        }
        let area = serde_json::Value::from(areas).to_string();
        let area = Value::Text(&area);
        self.builder.set(table, row, "vehicleEnvelope.area", area)
    }

    /// The corners of an envelope in meters, the first one again at the end.
    fn ring(&mut self, envelope: Node<'d, 't>) -> Option<Vec<[f64; 2]>> {
        let mut ring = Vec::new();
        for vertex in children(envelope, "vertex") {
            ring.push(self.corner(vertex)?);
        }
        if ring.first() != ring.last() {
            ring.extend(ring.first().copied());
        }
        if ring.len() < 4 {
            let message = || "the envelope has fewer than three corners".to_owned();
            let remedy = "Give it at least three, or remove it";
            self.report(Code::MissingField, envelope, message, remedy);
            return None;
        }
        Some(ring)
    }

    /// A corner in meters; says so if it cannot be one, and the envelope is left out.
    fn corner(&mut self, vertex: Node<'d, 't>) -> Option<[f64; 2]> {
        for key in ["x", "y"] {
            if vertex.attribute(key).is_none() {
                let message = || format!("a corner of the envelope has no {key}");
                self.report(Code::MissingField, vertex, message, "Give it one");
                return None;
            }
        }
        let corner = Point::new(self.number(vertex, &["x"])?, self.number(vertex, &["y"])?) * 1e-3;
        let xml = self.xml;
        let is_placed = self.builder.check_point(corner, &|| xml.place(vertex));
        is_placed.then_some([corner.x, corner.y])
    }
}
