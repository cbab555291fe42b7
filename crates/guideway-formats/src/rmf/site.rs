//! From a file to a layout: vertices become nodes, lanes and walls become paths, lifts become stations.

use std::collections::{BTreeMap, HashSet};

use guideway_layout::{Code, Direction, Layout, NewPath, Place, Value};
use guideway_spline::Runs;

use super::frame::{Coordinates, Frame, frames};
use super::level::{Level, ends};
use super::parameters::parameter;
use crate::ReadError;
use crate::builder::{Builder, PlaceFn, Table};
use crate::source::Source;
use crate::yaml::{Item, Yaml};

/// What becomes paths: the key of its list, and what one of it is called. Lanes come last and so lie on top.
const EDGES: [(&str, &str); 4] = [
    ("walls", "wall"),
    ("doors", "door"),
    ("human_lanes", "human lane"),
    ("lanes", "lane"),
];

/// What a level holds besides, and a picture of paths does not.
const NOT_DRAWN: [&str; 5] = ["floors", "models", "features", "constraints", "holes"];

/// Most graphs that are counted by number; the editor has nine.
const MOST_GRAPHS: usize = 64;

/// Fills a layout from a file.
pub(super) struct Site<'a, 'y> {
    pub(super) builder: Builder<'a>,
    /// The parameters that are columns, of paths and of nodes.
    pub(super) columns: HashSet<(bool, &'y str)>,
    bidirectional: u64,
    graphs: BTreeMap<i64, u64>,
}

impl<'a, 'y> Site<'a, 'y> {
    pub(super) fn new(source: Source<'a>, file_bytes: usize) -> Self {
        Self {
            builder: Builder::new(source, file_bytes),
            columns: HashSet::new(),
            bidirectional: 0,
            graphs: BTreeMap::new(),
        }
    }

    pub(super) fn map(
        mut self,
        yaml: &'y Yaml<'y>,
        root: Item<'y>,
        levels: Item<'y>,
    ) -> Result<Layout, ReadError> {
        for (key, line) in &yaml.repeated {
            let at: PlaceFn<'_> = &|| Place {
                element: "an object".into(),
                line: Some(*line),
            };
            let message = || format!("the key `{key}` is there more than once");
            self.builder
                .report(Code::DuplicateKey, at, message, "Remove the others");
        }
        let all: Result<Vec<_>, _> = levels
            .entries()
            .map(|(name, content)| Level::read(&mut self.builder, name, content))
            .collect();
        let levels = all?;
        let is_graph = is_graph(&levels);
        let coordinates = match is_graph {
            true => Coordinates::Meters,
            false => self.coordinates(root),
        };
        let name = root.get("reference_level_name").and_then(Item::text);
        let reference = levels.iter().position(|level| Some(level.name) == name);
        if let (Some(named), None) = (root.get("reference_level_name"), reference) {
            let message = || format!("there is no level `{}`", name.unwrap_or(named.kind()));
            let at: PlaceFn<'_> = &|| place("reference_level_name", named);
            let remedy = "The first level is taken; correct the name";
            self.builder.report(Code::UnknownValue, at, message, remedy);
        }
        if let Some(line) = yaml.next_document {
            let at: PlaceFn<'_> = &|| Place {
                element: "the next document".into(),
                line: Some(line),
            };
            let message = || "the file holds more than one document".to_owned();
            self.builder.report(
                Code::NotDrawn,
                at,
                message,
                "Only the first one is read; split the file",
            );
        }
        let frames = frames(
            &mut self.builder,
            coordinates,
            &levels,
            reference.unwrap_or(0),
        );
        for (index, (level, frame)) in levels.iter().zip(&frames).enumerate() {
            self.map_level(index as u32, level, *frame)?;
        }
        self.map_lifts(root, &levels, &frames, reference.unwrap_or(0))?;
        self.count(&levels, root, is_graph);
        Ok(self.builder.layout)
    }

    fn coordinates(&mut self, root: Item<'_>) -> Coordinates {
        let Some(found) = root.get("coordinate_system") else {
            return Coordinates::Image;
        };
        match found.text() {
            Some("reference_image") => Coordinates::Image,
            Some("cartesian_meters") => Coordinates::Meters,
            Some("wgs84") => Coordinates::Degrees,
            Some("web_mercator") => Coordinates::Mercator,
            other => {
                let name = other.unwrap_or(found.kind());
                let at: PlaceFn<'_> = &|| place("coordinate_system", found);
                let message = || format!("the coordinate system `{name}` is not known");
                let remedy = "Pixels of a floor plan are assumed, as where there is none";
                self.builder.report(Code::UnknownValue, at, message, remedy);
                Coordinates::Image
            }
        }
    }

    fn map_level(&mut self, index: u32, level: &Level<'y>, frame: Frame) -> Result<(), ReadError> {
        let elevation = level.content.get("elevation");
        if let Some(odd) = elevation.filter(|e| e.number().is_none()) {
            self.report_type(&|| level.place("elevation"), "a number", odd);
        }
        let elevation = elevation.and_then(Item::number);
        self.builder.layout.levels.push(guideway_layout::Level {
            id: level.name.to_owned(),
            name: None,
            elevation_m: elevation.filter(|e| e.is_finite()),
        });
        let mut nodes = Vec::with_capacity(level.positions.len());
        for (i, vertex) in level
            .content
            .get("vertices")
            .into_iter()
            .flat_map(Item::items)
            .enumerate()
        {
            nodes.push(self.map_vertex(index, level, frame, i, vertex)?);
        }
        for (key, element) in EDGES {
            for (i, edge) in level.list(&mut self.builder, key).enumerate() {
                self.map_edge(index, level, &nodes, (key, element, i), edge)?;
            }
        }
        for key in NOT_DRAWN {
            let count = level.count(key);
            if count > 0 {
                let at: PlaceFn<'_> = &|| level.place(key);
                let remedy =
                    "They are left out: what is read are vertices, lanes, walls, doors and lifts";
                self.builder
                    .report(Code::NotDrawn, at, || format!("{key}: {count}"), remedy);
            }
        }
        Ok(())
    }

    fn map_vertex(
        &mut self,
        level_index: u32,
        level: &Level<'y>,
        frame: Frame,
        index: usize,
        vertex: Item<'y>,
    ) -> Result<Option<u32>, ReadError> {
        let Some(position) = level.position(index) else {
            return Ok(None);
        };
        let at: PlaceFn<'_> = &|| level.item_place("vertices", index, vertex);
        let position = frame.to_meters(position);
        if !self.builder.check_point(position, at) {
            return Ok(None);
        }
        // [x, y, z, name, parameters] in a building, [x, y, parameters] in a graph.
        let parameters = vertex.item(4).or_else(|| vertex.item(2));
        let named = parameters.and_then(|p| p.get("name"));
        let name = vertex
            .item(3)
            .or(named)
            .and_then(Item::text)
            .unwrap_or_default();
        self.builder.check_text(name)?;
        let id = match name {
            "" => format!("{}.vertices[{index}]", level.name),
            name => name.to_owned(),
        };
        let row = self.builder.push_node(&id, position, Some(level_index))?;
        if let Some(parameters) = parameters {
            self.set_parameters(Table::Nodes, row as usize, parameters, at)?;
        }
        Ok(Some(row))
    }

    fn map_edge(
        &mut self,
        level_index: u32,
        level: &Level<'y>,
        nodes: &[Option<u32>],
        (key, element, index): (&str, &str, usize),
        edge: Item<'y>,
    ) -> Result<(), ReadError> {
        let at: PlaceFn<'_> = &|| level.item_place(key, index, edge);
        let id = format!("{}.{key}[{index}]", level.name);
        let known = ends(edge).map(|ends| ends.map(|end| nodes.get(end).copied().flatten()));
        let Some([Some(start), Some(end)]) = known else {
            let detail = match known {
                Some(_) => "a vertex that it names is not there or has no position",
                None => "it does not begin with the numbers of two vertices",
            };
            let remedy = "It is left out; correct the vertices in the editor";
            self.builder
                .report(Code::UnknownNode, at, || detail.to_owned(), remedy);
            return self.builder.refuse(&id, Code::UnknownNode, detail);
        };
        if let Some(odd) = edge.item(2).filter(|p| !p.is_map()) {
            self.report_type(at, "an object of parameters", odd);
        }
        let parameters = edge.item(2).filter(|p| p.is_map());
        let parameter = |key| parameters.and_then(|p| parameter(p.get(key)?));
        let is_lane = element == "lane";
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
        let positions = &self.builder.layout.nodes;
        let mut runs = Runs::default();
        runs.push_line(positions.position_m(start), positions.position_m(end));
        let row = self.builder.push_path(&NewPath {
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
        let element = Value::Text(element);
        self.builder.set(Table::Paths, row, "element", element)?;
        match parameters {
            Some(parameters) => self.set_parameters(Table::Paths, row, parameters, at),
            None => Ok(()),
        }
    }

    /// Says that something is not what it should be, and is left out.
    pub(super) fn report_type(&mut self, at: PlaceFn<'_>, expected: &str, found: Item<'_>) {
        let message = || format!("{expected} was expected, {} was found", found.kind());
        let remedy = "It is left out; correct it";
        self.builder.report(Code::WrongType, at, message, remedy);
    }

    fn count_graph(&mut self, graph: i64) {
        if self.graphs.len() < MOST_GRAPHS || self.graphs.contains_key(&graph) {
            *self.graphs.entry(graph).or_insert(0) += 1;
        }
    }

    fn count(&mut self, levels: &[Level<'_>], root: Item<'_>, is_graph: bool) {
        const KEYS: [&str; 8] = [
            "vertices",
            "lanes",
            "human_lanes",
            "walls",
            "doors",
            "measurements",
            "floors",
            "models",
        ];
        let mut counts = vec![("levels".to_owned(), levels.len() as u64)];
        for key in KEYS.iter().chain(&["fiducials"]) {
            let count = levels.iter().map(|level| level.count(key)).sum();
            counts.push(((*key).to_owned(), count));
        }
        counts.push(("bidirectional".to_owned(), self.bidirectional));
        let graphs = self.graphs.iter();
        counts.extend(graphs.map(|(graph, count)| (format!("lanes of graph {graph}"), *count)));
        let lifts = root.get("lifts").map_or(0, |lifts| lifts.entries().count());
        counts.push(("lifts".to_owned(), lifts as u64));
        let provenance = &mut self.builder.layout.provenance;
        crate::Format::Rmf.name().clone_into(&mut provenance.format);
        let version = if is_graph {
            "navigation graph"
        } else {
            "building"
        };
        version.clone_into(&mut provenance.format_version);
        provenance.counts = counts;
    }
}

/// The place of something that has a name.
pub(super) fn place(element: &str, item: Item<'_>) -> Place {
    Place {
        element: element.to_owned(),
        line: Some(item.line()),
    }
}

/// Whether vertices are those of a graph: parameters where a building has a height, or nothing.
fn is_graph(levels: &[Level<'_>]) -> bool {
    let vertices = levels
        .iter()
        .filter_map(|level| level.content.get("vertices"));
    let mut third = vertices.flat_map(Item::items).map(|vertex| vertex.item(2));
    third
        .next()
        .is_some_and(|item| item.is_none_or(Item::is_map))
}
