//! Writes the layer of a vector tile: features, and tables of their keys and values.
//!
//! Source: Mapbox Vector Tile Specification 2.1, section 4.

use guideway_layout::{PathRef, Value};

use super::extent::EXTENT;
use super::field::Field;
use super::message::{bytes, double, head, number, number_bytes, packed, zigzag};
use super::value_table::ValueTable;

/// Name of the layer.
pub(crate) const LAYER: &str = "paths";
/// Type of a feature: a line string.
const LINE_STRING: u64 = 2;

/// The layer under construction. Its memory serves tile after tile.
#[derive(Default)]
pub(super) struct Layer {
    features: Vec<u8>,
    /// Messages of the values with their heads, and the number of each.
    values: Vec<u8>,
    table: ValueTable,
    message: Vec<u8>,
    /// A packed list.
    list: Vec<u8>,
    tags: Vec<u32>,
    tile: Vec<u8>,
}

impl Layer {
    /// Removes all features.
    pub(super) fn clear(&mut self) {
        self.features.clear();
        self.values.clear();
        self.table.clear();
    }

    /// Appends a path as a feature with some geometry commands. Its number is the identifier of the
    /// path if that is a number: a row would differ from worker to worker.
    pub(super) fn push(&mut self, fields: &[Field<'_>], path: PathRef<'_>, commands: &[u32]) {
        self.tags.clear();
        for (key, field) in (0..).zip(fields) {
            let Some(value) = field.value(path) else {
                continue;
            };
            if let Some(number) = self.number_of(value, field.is_unique()) {
                self.tags.extend([key, number]);
            }
        }
        self.message.clear();
        if let Ok(id) = path.id().parse() {
            number(&mut self.message, 1, id);
        }
        packed(&mut self.message, 2, &self.tags, &mut self.list);
        number(&mut self.message, 3, LINE_STRING);
        packed(&mut self.message, 4, commands, &mut self.list);
        bytes(&mut self.features, 2, &self.message);
    }

    /// Number of a value in the table; `None` for one that vector tiles do not have. Values that
    /// are unique are not looked up.
    fn number_of(&mut self, value: Value<'_>, is_unique: bool) -> Option<u32> {
        let message = &mut self.message;
        message.clear();
        match value {
            Value::Text(text) => bytes(message, 1, text.as_bytes()),
            Value::Float(value) => double(message, 3, value),
            Value::Int(value) => number(message, 6, zigzag(value)),
            Value::Bool(value) => number(message, 7, u64::from(value)),
            Value::Json(_) => return None,
        }
        Some(match is_unique {
            true => {
                bytes(&mut self.values, 4, message);
                self.table.skip()
            }
            false => self.table.number(message, &mut self.values, |values| {
                head(values, 4, message.len());
            }),
        })
    }

    /// The tile with this layer; `None` if it has no features.
    pub(super) fn finish(&mut self, fields: &[Field<'_>]) -> Option<&[u8]> {
        if self.features.is_empty() {
            return None;
        }
        let names = fields.iter().map(|field| field.name().as_bytes());
        let bytes_of = |text: &[u8]| 1 + number_bytes(text.len() as u64) + text.len();
        let layer_bytes = 2
            + bytes_of(LAYER.as_bytes())
            + self.features.len()
            + names.clone().map(bytes_of).sum::<usize>()
            + self.values.len()
            + 1
            + number_bytes(u64::from(EXTENT));
        let tile = &mut self.tile;
        tile.clear();
        head(tile, 3, layer_bytes);
        number(tile, 15, 2);
        bytes(tile, 1, LAYER.as_bytes());
        tile.extend_from_slice(&self.features);
        names.for_each(|name| bytes(tile, 3, name));
        tile.extend_from_slice(&self.values);
        number(tile, 5, u64::from(EXTENT));
        Some(tile)
    }
}
