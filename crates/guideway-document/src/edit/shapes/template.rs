//! [`EdgeTemplate`]: direction, vehicle types and speeds of new paths.

use std::sync::Arc;

use guideway_layout::{Attribute, Direction, ElementKind, Quantity, Value};
use guideway_scene::{Table, TableEdit};

use super::error::ShapeError;
use crate::PathSet;
use crate::change::Change;
use crate::document::Document;
use crate::edit::property_value::accepted;

/// Property of the greatest speed.
const MAX_SPEED: &str = "maxSpeed";

/// The properties of new paths.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct EdgeTemplate {
    /// Travel direction.
    pub direction: Direction,
    /// Greatest speed of vehicle types without one of their own, in meters per second.
    pub max_speed: Option<f64>,
    /// Vehicle types that may use the paths, with a greatest speed of their own in meters per
    /// second; none means all types.
    pub vehicle_types: Vec<(String, Option<f64>)>,
}

impl EdgeTemplate {
    /// Names of the vehicle types.
    pub(super) fn type_names(&self) -> impl Iterator<Item = &str> {
        self.vehicle_types.iter().map(|(name, _)| name.as_str())
    }
}

impl Document {
    /// The template that makes paths like an existing one.
    ///
    /// # Panics
    /// When the path is unknown.
    pub fn template_of(&self, path: u32) -> EdgeTemplate {
        let (paths, row) = (&self.layout().paths, path as usize);
        let speed = |value: Option<Value<'_>>| value?.number();
        let entries = paths.vehicle_types();
        let own = |name: &str| {
            let entry = entries.entry_for(row, name)?;
            speed(entries.attributes.get(MAX_SPEED)?.values.get(entry))
        };
        EdgeTemplate {
            direction: paths.get(row).direction(),
            max_speed: speed(paths.attributes.value(row, MAX_SPEED)),
            vehicle_types: entries
                .of(row)
                .map(|name| (name.to_owned(), own(name)))
                .collect(),
        }
    }

    /// Changes that set the speeds of new paths.
    pub(super) fn speeds(
        &self,
        template: &EdgeTemplate,
        new: &PathSet,
    ) -> Result<Vec<Change>, ShapeError> {
        let paths = &self.layout().paths;
        let columns = [&paths.attributes, &paths.vehicle_types().attributes];
        let known: Option<&Attribute> = columns.into_iter().find_map(|c| c.get(MAX_SPEED));
        let own = |(name, speed): &(String, Option<f64>)| {
            (Some(Arc::from(name.as_str())), speed.or(template.max_speed))
        };
        let mut wanted: Vec<(Option<Arc<str>>, Option<f64>)> =
            template.vehicle_types.iter().map(own).collect();
        if wanted.is_empty() {
            wanted.push((None, template.max_speed));
        }
        let mut changes = Vec::new();
        for (vehicle_type, speed) in wanted {
            let Some(speed) = speed else { continue };
            let value = Some(Value::Float(speed));
            let (value, quantity) = accepted(ElementKind::Path, MAX_SPEED, known, value)?;
            let edit = TableEdit::SetValues {
                of: Table::Paths,
                vehicle_type,
                column: MAX_SPEED.into(),
                quantity: quantity.or(Some(Quantity::Speed)),
                rows: new.iter().collect(),
                values: Arc::new([value].into_iter().collect()),
            };
            changes.push(edit.into());
        }
        Ok(changes)
    }
}
