//! Creates nodes, paths between nodes, and stations.

use guideway_layout::Direction;
use guideway_scene::{Edit, Insertion, NewNode, NewStation, Table, TableEdit};
use guideway_spline::{Point, Runs};

use super::error::OperationError;
use crate::PathSet;
use crate::document::Document;

/// A path to create between two nodes.
#[derive(Clone, Debug, Default)]
pub struct NewEdge {
    /// Identifier; `None` makes one of the names of the nodes.
    pub id: Option<String>,
    /// Row of the first node.
    pub start_node: u32,
    /// Row of the last node.
    pub end_node: u32,
    /// Curve from the first to the last node, in meters; `None` makes a line.
    pub curve: Option<Runs>,
    /// Travel direction.
    pub direction: Direction,
    /// Index of its level; `None` takes that of the nodes if they have the same one.
    pub level: Option<u32>,
    /// Vehicle types that may use it; empty means all.
    pub vehicle_types: Vec<String>,
    /// Row of the path whose properties it copies, if any.
    pub attributes_of: Option<u32>,
}

impl Document {
    /// Creates a node at a position in meters. Without an identifier, it is called `node` with a
    /// number. Returns its row.
    ///
    /// # Errors
    /// When the identifier is taken, the position is out of reach, or the level unknown.
    pub fn create_node(
        &mut self,
        id: Option<&str>,
        position_m: Point<f64>,
        level: Option<u32>,
    ) -> Result<u32, OperationError> {
        let id = self.new_name(Table::Nodes, id, "node")?;
        let row = self.layout().nodes.len() as u32;
        let node = NewNode {
            id,
            position_m,
            level,
            vehicle_types: Vec::new(),
            attributes_of: None,
        };
        let edit = TableEdit::InsertNodes([node].into());
        self.perform("create node", vec![edit.into()])?;
        Ok(row)
    }

    /// Creates a path between two nodes. Returns its row.
    ///
    /// # Errors
    /// When a node does not exist, the identifier is taken, or a line would have no length.
    pub fn create_edge(&mut self, edge: &NewEdge) -> Result<u32, OperationError> {
        let ends = [edge.start_node, edge.end_node];
        self.check_rows_exist(Table::Nodes, &ends.into_iter().collect())?;
        let own_type = edge.attributes_of.into_iter().collect::<PathSet>();
        self.check_rows_exist(Table::Paths, &own_type)?;
        let nodes = &self.layout().nodes;
        let [from_m, to_m] = ends.map(|node| nodes.position_m(node));
        let [start, end] = ends.map(|node| nodes.id(node).to_owned());
        let runs = match &edge.curve {
            Some(curve) => curve.clone(),
            None if from_m == to_m => return Err(OperationError::NoLength { start, end }),
            None => {
                let mut line = Runs::default();
                line.push_line(from_m, to_m);
                line
            }
        };
        let levels = ends.map(|node| nodes.level(node));
        let of_nodes = levels[0].filter(|_| levels[0] == levels[1]);
        let path = Insertion {
            id: self.new_name(Table::Paths, edge.id.as_deref(), &format!("{start}--{end}"))?,
            runs,
            start_node: Some(edge.start_node),
            end_node: Some(edge.end_node),
            direction: edge.direction,
            level: edge.level.or(of_nodes),
            vehicle_types: edge.vehicle_types.clone(),
            attributes_of: edge.attributes_of,
            ..Insertion::default()
        };
        let row = self.scene.row_count() as u32;
        self.perform("create edge", vec![Edit::Insert([path].into()).into()])?;
        Ok(row)
    }

    /// Creates a station that nodes serve. Without a position in meters, it is at the first of
    /// them; without a level, on that of the first of them. Returns its row.
    ///
    /// # Errors
    /// When a node or the level does not exist, the identifier is taken, or the position is out of
    /// reach.
    pub fn create_station(
        &mut self,
        id: Option<&str>,
        nodes: &[u32],
        position_m: Option<Point<f64>>,
        level: Option<u32>,
    ) -> Result<u32, OperationError> {
        self.check_rows_exist(Table::Nodes, &nodes.iter().copied().collect())?;
        let id = self.new_name(Table::Stations, id, "station")?;
        let layout = self.layout();
        let row = layout.stations.len() as u32;
        let first = nodes.first();
        let station = NewStation {
            id,
            position_m: position_m.or_else(|| Some(layout.nodes.position_m(*first?))),
            nodes: nodes.to_vec(),
            level: level.or_else(|| layout.nodes.level(*first?)),
            attributes_of: None,
        };
        let edit = TableEdit::InsertStations([station].into());
        self.perform("create station", vec![edit.into()])?;
        Ok(row)
    }

    /// Sets the nodes that serve a station, by their identifiers. A station without a position of
    /// its own stays where it is.
    ///
    /// # Errors
    /// When the station does not exist, or no node has an identifier.
    pub fn set_station_nodes(&mut self, station: u32, ids: &[&str]) -> Result<(), OperationError> {
        self.check_rows_exist(Table::Stations, &[station].into_iter().collect())?;
        let layout = self.layout();
        let mut rows = vec![None; ids.len()];
        for node in self.existing(Table::Nodes) {
            let places = ids.iter().zip(&mut rows);
            let named = places.filter(|(id, _)| **id == layout.nodes.id(node));
            named.for_each(|(_, row)| *row = Some(node));
        }
        let unknown = rows.iter().zip(ids).find(|(row, _)| row.is_none());
        if let Some((_, id)) = unknown {
            let node = (*id).to_owned();
            return Err(OperationError::UnknownNode { node });
        }
        let nodes: Box<[u32]> = rows.into_iter().flatten().collect();
        let placed = layout.stations.position_m(station);
        let at_m = self
            .station_position_m(station)
            .filter(|_| placed.is_none());
        let place = at_m.map(|at_m| TableEdit::MoveStations([(station, Some(at_m))].into()).into());
        let set = TableEdit::SetStationNodes([(station, nodes)].into()).into();
        let changes = place.into_iter().chain([set]).collect();
        Ok(self.perform("set nodes of station", changes)?)
    }

    /// The given name, if it is free, or a free one that begins with `wanted`.
    fn new_name(
        &self,
        of: Table,
        id: Option<&str>,
        wanted: &str,
    ) -> Result<String, OperationError> {
        let mut names = self.names(of);
        match id {
            Some(id) => names.exact(id),
            None => Ok(names.unique(wanted)),
        }
    }
}
