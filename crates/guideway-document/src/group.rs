//! Group: a reference to a level or a vehicle type of a layout, and the elements that belong to it.

use guideway_layout::{Layout, TypeEntries};
use guideway_scene::Table;
use guideway_spline::Bounds;

use crate::document::Document;
use crate::element::Element;
use crate::elements::Elements;
use crate::select_mode::SelectMode;

/// A level or a vehicle type: what elements have in common.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Group {
    /// Row of a level.
    Level(u32),
    /// Name of a vehicle type.
    VehicleType(String),
}

impl Group {
    /// Its identifier; `None` for a level that does not exist.
    pub fn id<'a>(&'a self, layout: &'a Layout) -> Option<&'a str> {
        match self {
            Self::Level(row) => Some(&layout.levels.get(*row as usize)?.id),
            Self::VehicleType(name) => Some(name),
        }
    }

    /// `level` or `vehicle type`.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Level(_) => "level",
            Self::VehicleType(_) => "vehicle type",
        }
    }
}

impl Document {
    /// Returns `true` if a level or a vehicle type exists.
    pub fn contains_group(&self, group: &Group) -> bool {
        match group {
            Group::Level(row) => (*row as usize) < self.layout().levels.len(),
            Group::VehicleType(name) => self.layout().vehicle_type_names().contains(&**name),
        }
    }

    /// The existing elements of a level.
    pub fn elements_of_level(&self, level: u32) -> Elements {
        let mut elements = Elements::default();
        for of in Table::ALL {
            let rows = self.existing(of);
            let is_here = |row: &u32| of.level(self.layout(), *row) == Some(level);
            *elements.rows_mut(of) = rows.filter(is_here).collect();
        }
        elements
    }

    /// The elements of a level; the paths that a vehicle type may use, and the nodes that name it.
    pub fn members(&self, group: &Group) -> Elements {
        match group {
            Group::Level(row) => self.elements_of_level(*row),
            Group::VehicleType(name) => {
                let layout = self.layout();
                let (paths, nodes) = (layout.paths.vehicle_types(), layout.nodes.vehicle_types());
                let names = |row: u32, of: &TypeEntries| of.entry_for(row as usize, name).is_some();
                // A path that names no type is open to all.
                let may_use =
                    |row: &u32| paths.entries(*row as usize).is_empty() || names(*row, paths);
                Elements {
                    paths: self.existing(Table::Paths).filter(may_use).collect(),
                    nodes: self
                        .existing(Table::Nodes)
                        .filter(|row| names(*row, nodes))
                        .collect(),
                    ..Elements::default()
                }
            }
        }
    }

    /// All members of levels and vehicle types.
    pub fn members_of_all(&self, groups: impl Iterator<Item = Group>) -> Elements {
        groups.fold(Elements::default(), |all, group| {
            all.combined(self.members(&group), SelectMode::Add)
        })
    }

    /// Bounding box of elements and of the members of groups, in meters; `None` without any.
    pub fn bounds_of_all(&self, elements: &Elements) -> Option<Bounds<f64>> {
        let own = elements
            .iter()
            .filter_map(|element| self.bounds_of(element));
        let members = elements.groups().map(|group| self.members(&group));
        let of_members = members.filter_map(|members| self.bounds_of_all(&members));
        own.chain(of_members).reduce(Bounds::union)
    }
}

impl Elements {
    /// A single level or vehicle type.
    pub fn of_group(group: &Group) -> Self {
        let mut elements = Self::default();
        elements.insert_group(group.clone());
        elements
    }

    /// Adds a level or a vehicle type.
    pub fn insert_group(&mut self, group: Group) {
        match group {
            Group::Level(row) => drop(self.levels.insert(row)),
            Group::VehicleType(name) => drop(self.vehicle_types.insert(name)),
        }
    }

    /// Returns `true` if a level or a vehicle type is among them.
    pub fn contains_group(&self, group: &Group) -> bool {
        match group {
            Group::Level(row) => self.levels.contains(*row),
            Group::VehicleType(name) => self.vehicle_types.contains(name),
        }
    }

    /// The levels and the vehicle types.
    pub fn groups(&self) -> impl Iterator<Item = Group> {
        let levels = self.levels.iter().map(Group::Level);
        let types = self.vehicle_types.iter().cloned().map(Group::VehicleType);
        levels.chain(types)
    }

    /// The paths, nodes and stations.
    pub fn iter(&self) -> impl Iterator<Item = Element> {
        (self.paths.iter().map(Element::Path))
            .chain(self.nodes.iter().map(Element::Node))
            .chain(self.stations.iter().map(Element::Station))
    }
}
