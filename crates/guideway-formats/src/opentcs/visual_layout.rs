//! Reads the visual layout of a plant: scale, layer names, and in old files the shape of every
//! path.

use std::collections::HashMap;

use guideway_layout::Code;
use guideway_spline::Point;
use roxmltree::Node;

use super::reader::PlantReader;
use crate::xml::{child, children};

/// Millimeters per layout unit without a scale in the file; the value that the editor always
/// writes.
const DEFAULT_SCALE: f64 = 50.0;

/// The `visualLayout` of a model.
pub(super) struct VisualLayout<'d> {
    /// Millimeters per layout unit along x and y.
    scale: Point<f64>,
    /// Layer name per layer identifier.
    layers: HashMap<&'d str, &'d str>,
    /// Legacy drawing properties per object name, up to version 0.0.3.
    legacy_elements: HashMap<&'d str, LegacyElement<'d>>,
}

/// The drawing properties of one object in files up to version 0.0.3.
#[derive(Default)]
pub(super) struct LegacyElement<'d> {
    pub(super) x: Option<&'d str>,
    pub(super) y: Option<&'d str>,
    pub(super) connection_type: Option<&'d str>,
    pub(super) control_points: Option<&'d str>,
}

impl<'d> LegacyElement<'d> {
    fn read(element: Node<'d, '_>) -> Self {
        let mut legacy = Self::default();
        for property in children(element, "property") {
            let value = property.attribute("value");
            match property.attribute("name") {
                Some("POSITION_X") => legacy.x = value,
                Some("POSITION_Y") => legacy.y = value,
                Some("CONN_TYPE") => legacy.connection_type = value,
                Some("CONTROL_POINTS") => legacy.control_points = value,
                _ => {}
            }
        }
        legacy
    }
}

impl<'d> VisualLayout<'d> {
    /// Reads the `visualLayout` of a model; defaults without one.
    pub(super) fn read<'t>(reader: &mut PlantReader<'_, 'd, 't>, model: Node<'d, 't>) -> Self {
        let Some(node) = child(model, "visualLayout") else {
            return Self {
                scale: Point::new(DEFAULT_SCALE, DEFAULT_SCALE),
                layers: HashMap::new(),
                legacy_elements: HashMap::new(),
            };
        };
        let layers = children(node, "layer")
            .filter_map(|layer| Some((layer.attribute("id")?, layer.attribute("name")?)))
            .collect();
        let mut legacy_elements = HashMap::new();
        for element in children(node, "modelLayoutElement") {
            if let Some(name) = element.attribute("visualizedObjectName") {
                legacy_elements
                    .entry(name)
                    .or_insert_with(|| LegacyElement::read(element));
            }
        }
        Self {
            scale: Point::new(scale(reader, node, "scaleX"), scale(reader, node, "scaleY")),
            layers,
            legacy_elements,
        }
    }

    /// Converts a control point from layout units with y down to meters.
    pub(super) fn to_meters(&self, point: Point<f64>) -> Point<f64> {
        Point::new(
            point.x * self.scale.x / 1000.0,
            -point.y * self.scale.y / 1000.0,
        )
    }

    /// The name of a layer, or its identifier if it has no name.
    pub(super) fn layer_name(&self, id: &'d str) -> &'d str {
        self.layers.get(id).copied().unwrap_or(id)
    }

    /// The legacy drawing properties of an object.
    pub(super) fn legacy_element(&self, object: &str) -> Option<&LegacyElement<'d>> {
        self.legacy_elements.get(object)
    }
}

/// Reads a scale. Reports a finding and uses the default if it is not positive.
fn scale<'d, 't>(
    reader: &mut PlantReader<'_, 'd, 't>,
    node: Node<'d, 't>,
    key: &'static str,
) -> f64 {
    let scale = reader.number(node, &[key]).unwrap_or(DEFAULT_SCALE);
    if scale.is_finite() && scale > 0.0 {
        return scale;
    }
    let message = || format!("{key} is {scale}, expected a number above 0");
    let remedy = "50 mm per unit is used; correct the scale";
    reader
        .base
        .report(Code::UnknownValue, node, message, remedy);
    DEFAULT_SCALE
}
