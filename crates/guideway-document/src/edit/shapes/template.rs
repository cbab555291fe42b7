//! [`EdgeTemplate`]: direction, vehicle types, speeds and further properties of new paths.

use std::sync::Arc;

use guideway_layout::{Attribute, Attributes, Direction, ElementKind, OwnStyle, Quantity, Value};
use guideway_scene::{Table, TableEdit};

use super::error::ShapeError;
use crate::PathSet;
use crate::change::Change;
use crate::document::Document;
use crate::edit::lengths::LENGTH;
use crate::edit::property_value::accepted;

/// Property of the greatest speed.
const MAX_SPEED: &str = "maxSpeed";
/// Properties of one path that another one does not take over, beside the greatest speed: they name
/// it, measure it, or happen there.
const OWN: [&str; 4] = ["name", "description", LENGTH, "actions"];

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
    /// Width and color of their own.
    pub style: OwnStyle,
    /// Further properties, in one row.
    pub properties: Attributes,
    /// Further properties of single vehicle types, in one row each.
    pub properties_of_types: Vec<(String, Attributes)>,
}

impl EdgeTemplate {
    /// Names of the further properties, each once.
    pub fn further_names(&self) -> Vec<&str> {
        let of_types = self.properties_of_types.iter();
        let all = of_types.map(|(_, properties)| properties);
        let all = std::iter::once(&self.properties).chain(all);
        let mut names: Vec<&str> = Vec::new();
        for column in all.flat_map(Attributes::iter) {
            if !names.contains(&column.name.as_str()) {
                names.push(&column.name);
            }
        }
        let style = [
            ("width", self.style.width_m.is_some()),
            ("color", self.style.color_rgba.is_some()),
        ];
        names.extend(
            style
                .iter()
                .filter(|(_, is_own)| *is_own)
                .map(|(name, _)| *name),
        );
        names
    }

    /// The template without further properties.
    #[must_use]
    pub fn without_further(self) -> Self {
        Self {
            direction: self.direction,
            max_speed: self.max_speed,
            vehicle_types: self.vehicle_types,
            ..Self::default()
        }
    }

    /// Gives a vehicle type another name. Returns `false` if the template does not name it.
    pub fn rename_type(&mut self, old: &str, new: &str) -> bool {
        let speeds = self.vehicle_types.iter_mut().map(|(name, _)| name);
        let further = self.properties_of_types.iter_mut().map(|(name, _)| name);
        let mut is_named = false;
        for name in speeds.chain(further).filter(|name| *name == old) {
            new.clone_into(name);
            is_named = true;
        }
        is_named
    }

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
            style: paths.own_style(row),
            properties: further(&paths.attributes, row),
            properties_of_types: entries
                .entries(row)
                .map(|entry| {
                    let name = entries.type_of(entry).to_owned();
                    (name, further(&entries.attributes, entry))
                })
                .filter(|(_, properties)| !properties.is_empty())
                .collect(),
        }
    }

    /// Changes that set the further properties of new paths. What another file has in a column of
    /// another kind is left out.
    pub(super) fn further_properties(&self, template: &EdgeTemplate, new: &PathSet) -> Vec<Change> {
        let paths = &self.layout().paths;
        let of_types = template.properties_of_types.iter();
        // The user may have removed types since.
        let of_types = of_types.filter(|(name, _)| template.type_names().any(|n| n == name));
        let of_types = of_types.map(|(name, properties)| (Some(Arc::from(&**name)), properties));
        let mut changes = Vec::new();
        for (vehicle_type, properties) in
            std::iter::once((None, &template.properties)).chain(of_types)
        {
            let known = match vehicle_type {
                Some(_) => &paths.vehicle_types().attributes,
                None => &paths.attributes,
            };
            for column in properties.iter() {
                let (name, value) = (&*column.name, column.values.get(0));
                let accepted = accepted(ElementKind::Path, name, known.get(name), value);
                let Ok((Some(value), quantity)) = accepted else {
                    continue;
                };
                let edit = TableEdit::SetValues {
                    of: Table::Paths,
                    vehicle_type: vehicle_type.clone(),
                    column: name.into(),
                    quantity: quantity.or(column.quantity),
                    rows: new.iter().collect(),
                    values: Arc::new([Some(value)].into_iter().collect()),
                };
                changes.push(edit.into());
            }
        }
        changes
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

/// The properties of a row that another path takes over as they are.
fn further(of: &Attributes, row: usize) -> Attributes {
    let mut properties = Attributes::default();
    for column in of.select(&[row]).iter() {
        let is_own = column.name == MAX_SPEED || OWN.contains(&column.name.as_str());
        if !is_own && column.values.get(0).is_some() {
            properties.insert(column.clone());
        }
    }
    properties
}
