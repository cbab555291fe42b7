//! Reads the visual layout of a plant: scale, layers, and in old files the shape of every path.

use std::collections::{HashMap, HashSet};

use guideway_layout::Code;
use guideway_spline::Point;
use roxmltree::Node;
use serde_json::{Map, Value as Json};

use super::elements::{ANY, LAYER, LAYER_GROUP, VISUAL_LAYOUT};
use super::reader::PlantReader;
use crate::ReadError;
use crate::builder::Table;
use crate::xml::{child, children};

/// Millimeters per layout unit without a scale in the file; the value that the editor always
/// writes.
pub(super) const DEFAULT_SCALE: f64 = 50.0;

/// Name of the layer of elements without a layer; that of the first layer in the editor.
pub(super) const DEFAULT_LAYER: &str = "Default layer";

/// Name of the group of layers in the editor.
pub(super) const DEFAULT_GROUP: &str = "Default layer group";

/// The `visualLayout` of a model.
pub(super) struct VisualLayout<'d, 't> {
    node: Option<Node<'d, 't>>,
    /// Millimeters per layout unit along x and y.
    scale: Point<f64>,
    /// Label per layer identifier.
    layers: HashMap<&'d str, String>,
    /// Identifiers of layers that are hidden, or in a hidden group.
    hidden: HashSet<&'d str>,
    /// Legacy drawing properties per object name, up to version 0.0.3.
    legacy_elements: HashMap<&'d str, LegacyElement<'d, 't>>,
}

/// The drawing properties of one object in files up to version 0.0.3.
pub(super) struct LegacyElement<'d, 't> {
    node: Node<'d, 't>,
    pub(super) x: Option<&'d str>,
    pub(super) y: Option<&'d str>,
    pub(super) connection_type: Option<&'d str>,
    pub(super) control_points: Option<&'d str>,
    pub(super) label_offset: [Option<&'d str>; 2],
    /// Color of a block or of the route of a vehicle.
    pub(super) color: Option<&'d str>,
    /// True if it has properties other than these.
    has_more: bool,
}

impl<'d, 't> LegacyElement<'d, 't> {
    fn read(node: Node<'d, 't>) -> Self {
        let mut legacy = Self {
            node,
            x: None,
            y: None,
            connection_type: None,
            control_points: None,
            label_offset: [None; 2],
            color: None,
            has_more: false,
        };
        for property in children(node, "property") {
            let value = property.attribute("value");
            let field = match property.attribute("name").unwrap_or_default() {
                "POSITION_X" => &mut legacy.x,
                "POSITION_Y" => &mut legacy.y,
                "CONN_TYPE" => &mut legacy.connection_type,
                "CONTROL_POINTS" => &mut legacy.control_points,
                "LABEL_OFFSET_X" => &mut legacy.label_offset[0],
                "LABEL_OFFSET_Y" => &mut legacy.label_offset[1],
                "COLOR" | "ROUTE_COLOR" => &mut legacy.color,
                _ => {
                    legacy.has_more = true;
                    continue;
                }
            };
            *field = value;
        }
        legacy
    }

    /// The whole element, if it has properties that are not read.
    pub(super) fn unread(&self) -> Option<Json> {
        self.has_more.then(|| ANY.to_json(self.node).into())
    }

    fn layer(&self) -> Option<&'d str> {
        self.node.attribute("layer").filter(|layer| *layer != "0")
    }
}

impl<'d, 't> VisualLayout<'d, 't> {
    /// Reads the `visualLayout` of a model; defaults without one.
    pub(super) fn read(reader: &mut PlantReader<'_, 'd, 't>, model: Node<'d, 't>) -> Self {
        let Some(node) = child(model, "visualLayout") else {
            return Self {
                node: None,
                scale: Point::new(DEFAULT_SCALE, DEFAULT_SCALE),
                layers: HashMap::new(),
                hidden: HashSet::new(),
                legacy_elements: HashMap::new(),
            };
        };
        let text = |layer: Node<'d, 't>, name| layer.attribute(name).unwrap_or_default();
        let layers = children(node, "layer").map(|l| (text(l, "id"), text(l, "name")));
        let mut legacy_elements = HashMap::new();
        for element in children(node, "modelLayoutElement") {
            if let Some(name) = element.attribute("visualizedObjectName") {
                legacy_elements
                    .entry(name)
                    .or_insert_with(|| LegacyElement::read(element));
            }
        }
        Self {
            node: Some(node),
            scale: Point::new(scale(reader, node, "scaleX"), scale(reader, node, "scaleY")),
            layers: layer_labels(layers).into_iter().collect(),
            hidden: hidden_layers(node),
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

    /// The label of the layer of an element of a name, if the drawing hides it.
    pub(super) fn hidden_layer(&self, name: &str, layout: Option<Node<'d, 't>>) -> Option<&str> {
        let id = match layout {
            Some(layout) => layout.attribute("layerId"),
            None => self.legacy_element(name)?.layer(),
        };
        let id = self.hidden.get(id.unwrap_or("0"))?;
        Some(self.layers.get(id).map_or(id, String::as_str))
    }

    /// The layer of an element of a name, with the layout element that names its layer. `None` for
    /// the layer [`DEFAULT_LAYER`].
    pub(super) fn layer(&self, name: &str, layout: Option<Node<'d, 't>>) -> Option<&str> {
        let label = match layout.and_then(|layout| layout.attribute("layerId")) {
            // A drawing without layers has the first one of a new model.
            Some("0") if self.layers.is_empty() => DEFAULT_LAYER,
            Some(id) => self.layers.get(id).map_or(id, String::as_str),
            None => self.legacy_element(name)?.layer()?,
        };
        (label != DEFAULT_LAYER).then_some(label)
    }

    /// The legacy drawing properties of an object.
    pub(super) fn legacy_element(&self, object: &str) -> Option<&LegacyElement<'d, 't>> {
        self.legacy_elements.get(object)
    }

    /// Stores the drawing as attributes of the layout, unless it is that of a new model. `names`
    /// are those of all objects.
    ///
    /// # Errors
    /// When the layout exceeds a limit.
    pub(super) fn store(
        &self,
        reader: &mut PlantReader<'_, 'd, 't>,
        names: &HashSet<&str>,
    ) -> Result<(), ReadError> {
        let Some(node) = self.node else {
            return Ok(());
        };
        let mut drawing = VISUAL_LAYOUT.to_json(node);
        drawing.remove("layer");
        drawing.remove("layerGroup");
        drawing.remove("modelLayoutElement");
        let unread = children(node, "modelLayoutElement").filter(|element| {
            let name = element
                .attribute("visualizedObjectName")
                .unwrap_or_default();
            let first = self.legacy_elements.get(name).map(|legacy| legacy.node);
            !names.contains(name) || first != Some(*element)
        });
        for element in unread {
            reader.keep("modelLayoutElement", ANY.to_json(element).into());
        }
        let all = |tag, element: &super::elements::Element| -> Vec<Json> {
            children(node, tag)
                .map(|n| element.to_json(n).into())
                .collect()
        };
        let layers = all("layer", &LAYER);
        let groups = all("layerGroup", &LAYER_GROUP);
        for (name, value, default) in [
            ("visualLayout", drawing.into(), default_drawing()),
            ("layers", layers.into(), Json::Array(vec![default_layer()])),
            (
                "layerGroups",
                groups.into(),
                Json::Array(vec![default_group()]),
            ),
        ] {
            let is_empty = |value: &Json| value.as_array().is_some_and(Vec::is_empty);
            let value = Some(value).filter(|value| *value != default && !is_empty(value));
            reader.set_json(Table::Layout, 0, name, value)?;
        }
        Ok(())
    }
}

/// Identifiers of the layers of a drawing that are hidden, or in a hidden group.
fn hidden_layers<'d>(drawing: Node<'d, '_>) -> HashSet<&'d str> {
    let is_hidden = |node: &Node<'_, '_>| {
        let visible = node.attribute("visible").unwrap_or_default();
        matches!(visible.trim(), "false" | "0")
    };
    let groups = children(drawing, "layerGroup").filter(is_hidden);
    let groups: HashSet<_> = groups.filter_map(|group| group.attribute("id")).collect();
    let layers = children(drawing, "layer").filter(|layer| {
        let group = layer.attribute("groupId");
        is_hidden(layer) || group.is_some_and(|group| groups.contains(group))
    });
    layers.filter_map(|layer| layer.attribute("id")).collect()
}

/// The drawing of a new model.
pub(super) fn default_drawing() -> Json {
    let mut drawing = Map::new();
    drawing.insert("name".into(), "VLayout".into());
    drawing.insert("scaleX".into(), DEFAULT_SCALE.into());
    drawing.insert("scaleY".into(), DEFAULT_SCALE.into());
    drawing.into()
}

/// The layer of a new model.
pub(super) fn default_layer() -> Json {
    serde_json::json!({
        "id": 0, "ordinal": 0, "visible": true, "name": DEFAULT_LAYER, "groupId": 0
    })
}

/// The group of layers of a new model.
pub(super) fn default_group() -> Json {
    serde_json::json!({ "id": 0, "name": DEFAULT_GROUP, "visible": true })
}

/// A unique label per layer, for its identifier: its name, with the identifier if the name is empty
/// or that of an earlier layer.
pub(super) fn layer_labels<'l, I>(layers: impl Iterator<Item = (I, &'l str)>) -> Vec<(I, String)>
where
    I: std::fmt::Display,
{
    let mut used = HashSet::new();
    let label = |(id, name): (I, &'l str)| {
        let label = match !name.is_empty() && used.insert(name) {
            true => name.to_owned(),
            false => format!("{name} [{id}]"),
        };
        (id, label)
    };
    layers.map(label).collect()
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
