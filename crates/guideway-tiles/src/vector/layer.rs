//! Writes the layer of a vector tile: features, and tables of their keys and values.
//!
//! Source: Mapbox Vector Tile Specification 2.1, section 4.

use std::collections::HashMap;

use guideway_layout::{Layout, PathRef, Value};

use super::extent::EXTENT;
use super::message::{bytes, double, number, packed, zigzag};

/// Type of a feature: a line string.
const LINE_STRING: u64 = 2;

/// The layer under construction.
pub(super) struct Layer<'a> {
    name: &'a str,
    keys: &'a [&'a str],
    features: Vec<u8>,
    /// Messages of the values, each once, and the number of each.
    values: Vec<u8>,
    numbers: HashMap<Vec<u8>, u32>,
    message: Vec<u8>,
    tags: Vec<u32>,
}

impl<'a> Layer<'a> {
    pub(super) fn new(name: &'a str, keys: &'a [&'a str]) -> Self {
        Self {
            name,
            keys,
            features: Vec::new(),
            values: Vec::new(),
            numbers: HashMap::new(),
            message: Vec::new(),
            tags: Vec::new(),
        }
    }

    /// Appends a path as a feature with some geometry commands. Its number is the identifier of the
    /// path if that is a number: a row would differ from worker to worker.
    pub(super) fn push(&mut self, layout: &Layout, path: PathRef<'_>, commands: &[u32]) {
        self.tags.clear();
        for (key, &name) in (0..).zip(self.keys) {
            let value = match name {
                "id" => Some(Value::Text(path.id())),
                "level" => path
                    .level()
                    .map(|level| Value::Text(layout.levels[level as usize].id.as_str())),
                other => path.attribute(other),
            };
            if let Some(number) = value.and_then(|value| self.number_of(value)) {
                self.tags.extend([key, number]);
            }
        }
        self.message.clear();
        if let Ok(id) = path.id().parse() {
            number(&mut self.message, 1, id);
        }
        packed(&mut self.message, 2, &self.tags);
        number(&mut self.message, 3, LINE_STRING);
        packed(&mut self.message, 4, commands);
        bytes(&mut self.features, 2, &self.message);
    }

    /// Number of a value in the table; `None` for one that vector tiles do not have.
    fn number_of(&mut self, value: Value<'_>) -> Option<u32> {
        let message = &mut self.message;
        message.clear();
        match value {
            Value::Text(text) => bytes(message, 1, text.as_bytes()),
            Value::Float(value) => double(message, 3, value),
            Value::Int(value) => number(message, 6, zigzag(value)),
            Value::Bool(value) => number(message, 7, u64::from(value)),
            Value::Json(_) => return None,
        }
        if let Some(&known) = self.numbers.get(message) {
            return Some(known);
        }
        let new = self.numbers.len() as u32;
        bytes(&mut self.values, 4, message);
        self.numbers.insert(message.clone(), new);
        Some(new)
    }

    /// The tile with this layer; `None` if it has no features.
    pub(super) fn finish(self) -> Option<Vec<u8>> {
        if self.features.is_empty() {
            return None;
        }
        let mut layer = Vec::with_capacity(self.features.len() + self.values.len());
        number(&mut layer, 15, 2);
        bytes(&mut layer, 1, self.name.as_bytes());
        layer.extend_from_slice(&self.features);
        for key in self.keys {
            bytes(&mut layer, 3, key.as_bytes());
        }
        layer.extend_from_slice(&self.values);
        number(&mut layer, 5, u64::from(EXTENT));
        let mut tile = Vec::with_capacity(layer.len() + 8);
        bytes(&mut tile, 3, &layer);
        Some(tile)
    }
}
