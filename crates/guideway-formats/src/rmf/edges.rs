//! Maps the vertices and edges of a level: vertices to nodes; lanes, walls and doors to paths.

use guideway_layout::{Code, Direction, Member, NewPath, Quantity, Value};
use guideway_spline::{Point, Runs};

use super::frame::Frame;
use super::level::{Level, ends};
use super::parameters::{parameter, set_parameters};
use super::reader::place;
use super::site_mapper::SiteMapper;
use crate::ReadError;
use crate::builder::{PlaceFn, Table};
use crate::yaml::YamlNode;

/// Lists that become paths: key of the list, and name of one element. Lanes come last, so they are
/// drawn on top.
pub(super) const EDGES: [(&str, &str); 4] = [
    ("walls", "wall"),
    ("doors", "door"),
    ("human_lanes", "human lane"),
    ("lanes", "lane"),
];

impl<'y> SiteMapper<'_, 'y> {
    /// Maps a vertex to a node; `None` for one without a position.
    pub(super) fn map_vertex(
        &mut self,
        level_index: u32,
        level: &Level<'y>,
        frame: Frame,
        index: usize,
        vertex: YamlNode<'y>,
    ) -> Result<Option<u32>, ReadError> {
        let Some(position) = level.position(index) else {
            return Ok(None);
        };
        let at: PlaceFn<'_> = &|| level.item_place("vertices", index, vertex);
        let position = frame.to_meters(position);
        if !self.reader.builder.check_point(position, at) {
            return Ok(None);
        }
        // [x, y, z, name, parameters] in a building, [x, y, parameters] in a graph.
        let parameters = vertex.item(4).or_else(|| vertex.item(2));
        let named = parameters.and_then(|p| p.get("name"));
        let name = vertex
            .item(3)
            .or(named)
            .and_then(YamlNode::text)
            .unwrap_or_default();
        self.reader.builder.check_text(name)?;
        let id = match name {
            "" => format!("{}.vertices[{index}]", level.name),
            name => name.to_owned(),
        };
        let row = self
            .reader
            .builder
            .push_node(&id, position, Some(level_index))?;
        let nodes = &mut self.reader.builder.layout.nodes;
        nodes.source.set_position(row as usize, vertex.position());
        let height_m = vertex.item(2).and_then(YamlNode::number);
        if let Some(height_m) = height_m.filter(|height_m| *height_m != 0.0) {
            let attributes = self.reader.builder.attributes(Table::Nodes);
            attributes.set_quantity(row as usize, "z", height_m, Quantity::Length);
        }
        let Some(parameters) = parameters else {
            return Ok(Some(row));
        };
        let is_graph = self.reader.is_graph;
        let mut in_lift = None;
        for (key, node) in parameters.entries() {
            let Some(Value::Text(text)) = parameter(node, is_graph) else {
                continue;
            };
            match key {
                "mutex" if !text.is_empty() => self.reader.add_to_mutex(text, Member::Node(row)),
                "lift" | "lift_cabin" if self.lift_names.contains(text) => {
                    self.reader.lifts.entry(text).or_default().push(row);
                    in_lift = Some(key);
                }
                _ => {}
            }
        }
        let is_elsewhere = |key: &str| match key {
            "name" => named.is_some() && vertex.item(3).is_none(),
            "mutex" => is_text(parameters, "mutex", is_graph),
            key => Some(key) == in_lift,
        };
        let to = (Table::Nodes, row as usize);
        set_parameters(&mut self.reader, to, parameters, is_elsewhere, at)?;
        Ok(Some(row))
    }

    /// Maps an edge between two vertices to a path.
    pub(super) fn map_edge(
        &mut self,
        level_index: u32,
        level: &Level<'y>,
        nodes: &[Option<u32>],
        (key, element, index): (&str, &str, usize),
        edge: YamlNode<'y>,
    ) -> Result<(), ReadError> {
        let at: PlaceFn<'_> = &|| level.item_place(key, index, edge);
        let is_graph = self.reader.is_graph;
        let parameters = edge.item(2).filter(|p| p.is_map());
        let parameter = |key| parameters.and_then(|p| parameter(p.get(key)?, is_graph));
        let is_lane = element == "lane";
        // Doors have names; lanes have none, but this program writes an identifier.
        let id_key = match (element, is_graph) {
            ("door", _) => "name",
            ("lane", true) => "id",
            _ => "",
        };
        let (id, has_id) = match parameter(id_key) {
            Some(Value::Text(id)) if is_lane || !id.is_empty() => (id.to_owned(), true),
            _ => (format!("{}.{key}[{index}]", level.name), false),
        };
        self.reader.builder.check_text(&id)?;
        let known = ends(edge).map(|ends| ends.map(|end| nodes.get(end).copied().flatten()));
        let Some([Some(start), Some(end)]) = known else {
            let detail = match known {
                Some(_) => "one of its vertices does not exist or has no position",
                None => "it does not begin with the indices of two vertices",
            };
            let remedy = "It is left out; correct the vertices in the editor";
            let builder = &mut self.reader.builder;
            return builder.refuse_at(&id, Code::UnknownNode, detail, at, remedy);
        };
        if let Some(odd) = edge.item(2).filter(|p| !p.is_map()) {
            self.reader.report_type(at, "an object of parameters", odd);
        }
        let both = ["bidirectional", "is_bidirectional"];
        let is_both = both
            .iter()
            .any(|key| parameter(key) == Some(Value::Bool(true)));
        let mut fleet = None;
        if is_lane {
            self.bidirectional += u64::from(is_both);
            if let Some(Value::Int(graph)) = parameter("graph_idx") {
                self.count_graph(graph);
                fleet = Some(format!("graph {graph}"));
            }
        }
        let positions = &self.reader.builder.layout.nodes;
        let mut runs = Runs::default();
        runs.push_line(positions.position_m(start), positions.position_m(end));
        let row = self.reader.builder.push_path(&NewPath {
            id: &id,
            runs: &runs,
            start_node: Some(start),
            end_node: Some(end),
            direction: match is_both || !is_lane {
                true => Direction::Both,
                false => Direction::Forward,
            },
            level: Some(level_index),
            // Each graph is for the vehicles of one fleet.
            vehicle_types: fleet.as_deref().as_slice(),
        })?;
        let paths = &mut self.reader.builder.layout.paths;
        paths.source.set_position(row, edge.position());
        // A navigation graph has lanes only, apart from its doors.
        if !is_graph {
            let element = Value::Text(element);
            self.reader
                .builder
                .set(Table::Paths, row, "element", element)?;
        }
        if let Some(Value::Text(mutex)) = parameter("mutex")
            && !mutex.is_empty()
        {
            self.reader.add_to_mutex(mutex, Member::Path(row as u32));
        }
        let orientation = parameter("orientation").filter(|_| is_lane && !is_graph);
        if let Some(Value::Text(text)) = orientation
            && !text.is_empty()
        {
            let value = Value::Text(text);
            let name = "orientation_constraint";
            self.reader.builder.set(Table::Paths, row, name, value)?;
        }
        let Some(parameters) = parameters else {
            return Ok(());
        };
        let is_elsewhere = |key: &str| match key {
            "bidirectional" | "is_bidirectional" => {
                let value = value_of(parameters, key, is_graph);
                matches!(value, Some(Value::Bool(_)))
            }
            "graph_idx" => fleet.is_some(),
            "mutex" => is_text(parameters, "mutex", is_graph),
            "orientation" => matches!(orientation, Some(Value::Text(_))),
            key => has_id && key == id_key,
        };
        let to = (Table::Paths, row);
        set_parameters(&mut self.reader, to, parameters, is_elsewhere, at)
    }

    /// Maps the doors of a navigation graph to paths. A building has them in its levels.
    pub(super) fn map_graph_doors(
        &mut self,
        root: YamlNode<'y>,
        levels: &[Level<'y>],
    ) -> Result<(), ReadError> {
        let doors = root.get("doors").filter(|_| self.reader.is_graph);
        for (name, door) in doors.into_iter().flat_map(YamlNode::entries) {
            let at: PlaceFn<'_> = &|| place(&format!("doors.{name}"), door);
            self.reader.builder.check_text(name)?;
            let end = |index| {
                let end = door.get("endpoints")?.item(index)?;
                Some(Point::new(end.item(0)?.number()?, end.item(1)?.number()?))
            };
            let ends = [end(0), end(1)]
                .map(|end| end.filter(|&point| self.reader.builder.check_point(point, at)));
            let [Some(start), Some(end)] = ends else {
                let detail = "the door has no two endpoints";
                let remedy = "It is left out; correct its endpoints";
                let builder = &mut self.reader.builder;
                builder.refuse_at(name, Code::MissingField, detail, at, remedy)?;
                continue;
            };
            let map = door.get("map").and_then(YamlNode::text);
            let level = levels.iter().position(|level| Some(level.name) == map);
            let mut runs = Runs::default();
            runs.push_line(start, end);
            let row = self.reader.builder.push_path(&NewPath {
                id: name,
                runs: &runs,
                direction: Direction::Both,
                level: level.map(|level| level as u32),
                ..NewPath::default()
            })?;
            let paths = &mut self.reader.builder.layout.paths;
            paths.source.set_position(row, door.position());
            let element = Value::Text("door");
            self.reader
                .builder
                .set(Table::Paths, row, "element", element)?;
            let is_elsewhere = |key: &str| key == "endpoints" || key == "map" && level.is_some();
            let to = (Table::Paths, row);
            set_parameters(&mut self.reader, to, door, is_elsewhere, at)?;
        }
        Ok(())
    }
}

fn value_of<'y>(parameters: YamlNode<'y>, key: &str, is_graph: bool) -> Option<Value<'y>> {
    parameter(parameters.get(key)?, is_graph)
}

fn is_text(parameters: YamlNode<'_>, key: &str, is_graph: bool) -> bool {
    matches!(value_of(parameters, key, is_graph), Some(Value::Text(_)))
}
