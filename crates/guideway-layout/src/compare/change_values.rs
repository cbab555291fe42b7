//! [`ChangedTexts`]: the old and the new value of a change, as text with units.

use super::cells::{Table, common_types};
use super::change::{Change, ChangedValue, Changes, ElementChange};
use super::element_pairs::level_id;
use crate::{Direction, ElementKind, Layout};

/// The old and the new value of a change.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ChangedTexts<'a> {
    /// Name of the property, such as `maxSpeed` or `start node`.
    pub property: &'a str,
    /// Vehicle type, if the value is that of one type.
    pub vehicle_type: Option<&'a str>,
    /// Old value with its unit; `None` for a new value.
    pub before: Option<String>,
    /// New value with its unit; `None` for a value that was removed.
    pub after: Option<String>,
}

impl<'a> Changes<'a> {
    /// The values of a change; `None` if it is of another kind than [`Change::Set`].
    pub fn values(&self, of: &ElementChange) -> Option<ChangedTexts<'a>> {
        let Change::Set(value) = of.change else {
            return None;
        };
        let rows = [of.old_row()?, of.new_row()?];
        let (layouts, kind) = (self.layouts, of.element);
        let mut vehicle_type = None;
        let property = match value {
            ChangedValue::Position => "position",
            ChangedValue::Level => "level",
            ChangedValue::Direction => "direction",
            ChangedValue::StartNode => "start node",
            ChangedValue::EndNode => "end node",
            ChangedValue::Nodes => "nodes",
            ChangedValue::VehicleTypes => "vehicle types",
            ChangedValue::Column { name, .. } => self.columns[name as usize],
        };
        let tables = layouts.map(|layout| Table::of(layout, kind));
        let [before, after] = match value {
            ChangedValue::Column { entry, .. } => {
                vehicle_type = entry.and_then(|entry| tables[0].type_of(entry));
                // A value for all vehicle types may be stored with each.
                let types = || common_types(tables, rows.map(|row| row as usize));
                let of = vehicle_type.or_else(|| types().first().copied());
                [0, 1].map(|i| tables[i].text(rows[i] as usize, of, property))
            }
            ChangedValue::VehicleTypes => {
                [0, 1].map(|i| Some(tables[i].type_list(rows[i] as usize)))
            }
            _ => [0, 1].map(|i| text(layouts[i], kind, rows[i], value)),
        };
        Some(ChangedTexts {
            property,
            vehicle_type,
            before,
            after,
        })
    }
}

/// The value of an element that is no property, as text.
fn text(layout: &Layout, kind: ElementKind, row: u32, value: ChangedValue) -> Option<String> {
    let path = || layout.paths.get(row as usize);
    let node_id = |node: Option<u32>| Some(layout.nodes.id(node?).to_owned());
    match value {
        ChangedValue::Position => {
            let p = layout.stations.position_m(row)?;
            Some(format!("({}, {}) m", p.x, p.y))
        }
        ChangedValue::Level => {
            let level = match kind {
                ElementKind::Path => path().level(),
                ElementKind::Station => layout.stations.level(row),
                _ => layout.nodes.level(row),
            };
            level_id(layout, level).map(str::to_owned)
        }
        ChangedValue::Direction => {
            let words = match path().direction() {
                Direction::Forward => "one-way",
                Direction::Both => "two-way",
            };
            Some(words.to_owned())
        }
        ChangedValue::StartNode => node_id(path().start_node()),
        ChangedValue::EndNode => node_id(path().end_node()),
        ChangedValue::Nodes => {
            let nodes = layout.stations.nodes(row).iter();
            let ids: Vec<&str> = nodes.map(|&node| layout.nodes.id(node)).collect();
            (!ids.is_empty()).then(|| ids.join(", "))
        }
        ChangedValue::VehicleTypes | ChangedValue::Column { .. } => None,
    }
}
