//! Layers of a drawing: those of the layout, and new ones for further names.

use std::collections::HashMap;

use guideway_layout::{Attributes, Layout, Level, Value};
use serde_json::{Map, Value as Json};

use super::plant::objects;
use super::visual_layout::{DEFAULT_LAYER, default_layer, layer_labels};

/// The layers of a file under construction.
pub(super) struct Layers {
    objects: Vec<Map<String, Json>>,
    /// Identifier per label.
    ids: HashMap<String, i64>,
    group: i64,
    /// Number of layers of the layout, or of a new model.
    known: usize,
}

impl Layers {
    /// The layers of a layout, or of a new model.
    pub(super) fn of_layout(layout: &Layout) -> Self {
        let mut all = objects(layout, "layers");
        if all.is_empty() {
            all.extend(default_layer().as_object().cloned());
        }
        let id = |object: &Map<String, Json>| object.get("id").and_then(Json::as_i64);
        let name = |object: &'_ Map<String, Json>| -> String {
            let name = object.get("name").and_then(Json::as_str);
            name.unwrap_or_default().to_owned()
        };
        let names: Vec<_> = all.iter().map(|o| (id(o).unwrap_or(0), name(o))).collect();
        let labels = layer_labels(names.iter().map(|(id, name)| (*id, name.as_str())));
        let groups = objects(layout, "layerGroups");
        Self {
            known: all.len(),
            objects: all,
            ids: labels.into_iter().map(|(id, label)| (label, id)).collect(),
            group: groups.first().and_then(id).unwrap_or(0),
        }
    }

    /// Identifier of the layer of a row: that of its column `layer`, else of its level.
    pub(super) fn id(
        &mut self,
        layout: &Layout,
        attributes: &Attributes,
        row: usize,
        level: Option<u32>,
    ) -> i64 {
        let level = level.and_then(|level| layout.levels.get(level as usize));
        let level = level.map(Level::name_or_id);
        match attributes.value(row, "layer") {
            Some(Value::Text(label)) => self.labeled(label),
            _ => self.labeled(level.unwrap_or(DEFAULT_LAYER)),
        }
    }

    fn labeled(&mut self, label: &str) -> i64 {
        if let Some(&id) = self.ids.get(label) {
            return id;
        }
        let next = |name: &str| {
            let numbers = self.objects.iter().filter_map(|o| o.get(name)?.as_i64());
            numbers.max().map_or(0, |number| number.saturating_add(1))
        };
        let (id, ordinal) = (next("id"), next("ordinal"));
        let object = serde_json::json!({
            "id": id, "ordinal": ordinal, "visible": true, "name": label, "groupId": self.group
        });
        self.objects.extend(object.as_object().cloned());
        self.ids.insert(label.to_owned(), id);
        id
    }

    /// All layers, as objects.
    pub(super) fn objects(&self) -> &[Map<String, Json>] {
        &self.objects
    }

    /// Number of layers that the layout does not have.
    pub(super) fn new_layers(&self) -> usize {
        self.objects.len() - self.known
    }
}
