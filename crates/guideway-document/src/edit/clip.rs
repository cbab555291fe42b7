//! [`Clip`]: elements of a document, to be pasted into the same or another one.

use guideway_layout::{Layout, VehicleType};
use guideway_scene::{EditError, Table};

use crate::PathSet;
use crate::document::Document;
use crate::elements::Elements;
use crate::select_mode::SelectMode;

/// Copied paths, nodes and stations with all their properties, levels with all that is on them, and
/// vehicle types, independent of their document.
#[derive(Clone, Debug)]
pub struct Clip {
    layout: Layout,
    levels: PathSet,
}

impl Clip {
    /// The elements and the vehicle types as a layout, with all levels.
    pub fn layout(&self) -> &Layout {
        &self.layout
    }

    /// The rows of the levels that are copied, not only named.
    pub fn levels(&self) -> &PathSet {
        &self.levels
    }

    /// Returns `true` if levels or vehicle types are copied.
    pub fn has_groups(&self) -> bool {
        !self.levels.is_empty() || !self.layout.vehicle_types.is_empty()
    }
}

impl Document {
    /// Copies elements, the end nodes of the paths, and the stations whose nodes are all copied;
    /// levels with all that is on them; vehicle types with the properties that they have
    /// everywhere.
    ///
    /// # Errors
    /// When an element does not exist.
    pub fn clip(&self, elements: &Elements) -> Result<Clip, EditError> {
        self.check_exist(elements)?;
        let levels = elements.levels.iter();
        let on_levels = levels.map(|level| self.elements_of_level(level));
        let all = on_levels.fold(elements.clone(), |all, on_level| {
            all.combined(on_level, SelectMode::Add)
        });
        let all = self.with_places(&all);
        let old = self.layout();
        let vehicle_type = |name: &String| {
            let known = old.vehicle_types.iter().find(|known| known.id == *name);
            known.cloned().unwrap_or_else(|| VehicleType {
                id: name.clone(),
                ..VehicleType::default()
            })
        };
        let rows = |rows: &PathSet| -> Vec<usize> { rows.iter().map(|row| row as usize).collect() };
        let node = |row: u32| {
            // The rank counts the rows up to and with this one.
            all.nodes
                .contains(row)
                .then(|| all.nodes.rank(row) as u32 - 1)
        };
        Ok(Clip {
            layout: Layout {
                paths: old.paths.select(&rows(&all.paths), node),
                nodes: old.nodes.select(&rows(&all.nodes)),
                stations: old.stations.select(&rows(&all.stations), node),
                levels: old.levels.clone(),
                vehicle_types: elements.vehicle_types.iter().map(vehicle_type).collect(),
                ..Layout::default()
            },
            levels: elements.levels.clone(),
        })
    }

    /// Elements with the end nodes of their paths, and the stations whose nodes are all among them.
    pub(super) fn with_places(&self, elements: &Elements) -> Elements {
        let nodes = &self.end_nodes(&elements.paths) | &elements.nodes;
        let nodes: PathSet = nodes
            .iter()
            .filter(|&n| self.scene.exists(Table::Nodes, n))
            .collect();
        Elements {
            paths: elements.paths.clone(),
            stations: &self.stations_of_only(&nodes) | &elements.stations,
            nodes,
            ..Elements::default()
        }
    }
}
