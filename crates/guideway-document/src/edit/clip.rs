//! [`Clip`]: elements of a document, to be pasted into the same or another one.

use guideway_layout::Layout;
use guideway_scene::{EditError, Table};

use crate::PathSet;
use crate::document::Document;
use crate::elements::Elements;

/// Copied paths, nodes and stations with all their properties, independent of their document.
#[derive(Clone, Debug)]
pub struct Clip {
    layout: Layout,
}

impl Clip {
    /// The elements as a layout.
    pub fn layout(&self) -> &Layout {
        &self.layout
    }
}

impl Document {
    /// Copies elements, the end nodes of the paths, and the stations whose nodes are all copied.
    ///
    /// # Errors
    /// When an element does not exist.
    pub fn clip(&self, elements: &Elements) -> Result<Clip, EditError> {
        self.check_exist(elements)?;
        let all = self.with_places(elements);
        let old = self.layout();
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
                ..Layout::default()
            },
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
        }
    }
}
