//! How the plant is drawn: scale, layers, and in old files the shape of every path.

use std::collections::HashMap;

use guideway_layout::Code;
use guideway_spline::Point;
use roxmltree::Node;

use super::plant::Plant;
use crate::xml::{child, children};

/// Millimeters a layout unit where the file does not say; the editor always writes this.
const DEFAULT_SCALE: f64 = 50.0;

/// The `visualLayout` of a model.
pub(super) struct Drawing<'d> {
    scale: Point<f64>,
    layers: HashMap<&'d str, &'d str>,
    /// Up to 0.0.3: the properties of everything that is drawn, by its name.
    elements: HashMap<&'d str, Drawn<'d>>,
}

/// How one thing is drawn, in files up to 0.0.3.
#[derive(Default)]
pub(super) struct Drawn<'d> {
    pub(super) x: Option<&'d str>,
    pub(super) y: Option<&'d str>,
    pub(super) connection_type: Option<&'d str>,
    pub(super) control_points: Option<&'d str>,
}

impl<'d> Drawn<'d> {
    fn read(element: Node<'d, '_>) -> Self {
        let mut drawn = Self::default();
        for property in children(element, "property") {
            let value = property.attribute("value");
            match property.attribute("name") {
                Some("POSITION_X") => drawn.x = value,
                Some("POSITION_Y") => drawn.y = value,
                Some("CONN_TYPE") => drawn.connection_type = value,
                Some("CONTROL_POINTS") => drawn.control_points = value,
                _ => {}
            }
        }
        drawn
    }
}

impl<'d> Drawing<'d> {
    pub(super) fn read<'t>(plant: &mut Plant<'_, 'd, 't>, model: Node<'d, 't>) -> Self {
        let Some(node) = child(model, "visualLayout") else {
            return Self {
                scale: Point::new(DEFAULT_SCALE, DEFAULT_SCALE),
                layers: HashMap::new(),
                elements: HashMap::new(),
            };
        };
        let layers = children(node, "layer")
            .filter_map(|layer| Some((layer.attribute("id")?, layer.attribute("name")?)))
            .collect();
        let mut elements = HashMap::new();
        for element in children(node, "modelLayoutElement") {
            if let Some(name) = element.attribute("visualizedObjectName") {
                elements.entry(name).or_insert_with(|| Drawn::read(element));
            }
        }
        Self {
            scale: Point::new(scale(plant, node, "scaleX"), scale(plant, node, "scaleY")),
            layers,
            elements,
        }
    }

    /// A control point in meters. In the file it is in layout units, with y down.
    pub(super) fn to_meters(&self, point: Point<f64>) -> Point<f64> {
        Point::new(
            point.x * self.scale.x / 1000.0,
            -point.y * self.scale.y / 1000.0,
        )
    }

    /// What a layer is called.
    pub(super) fn layer_name(&self, id: &'d str) -> &'d str {
        self.layers.get(id).copied().unwrap_or(id)
    }

    /// How something is drawn, in files up to 0.0.3.
    pub(super) fn of(&self, object: &str) -> Option<&Drawn<'d>> {
        self.elements.get(object)
    }
}

fn scale<'d, 't>(plant: &mut Plant<'_, 'd, 't>, node: Node<'d, 't>, key: &'static str) -> f64 {
    let scale = plant.number(node, &[key]).unwrap_or(DEFAULT_SCALE);
    if scale.is_finite() && scale > 0.0 {
        return scale;
    }
    let message = || format!("{key} is {scale}");
    let remedy = "50 mm a unit is used; give a number above 0";
    plant.report(Code::UnknownValue, node, message, remedy);
    DEFAULT_SCALE
}
