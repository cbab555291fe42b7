//! Maps a site to a layout: vertices to nodes; lanes, walls and doors to paths; lifts to stations.

use std::collections::BTreeMap;

use guideway_layout::{Code, Direction, Layout, NewPath, Place, Value};
use guideway_spline::Runs;

use super::frame::{Coordinates, Frame, frames};
use super::level::{Level, ends};
use super::lifts::map_lifts;
use super::parameters::{parameter, set_parameters};
use super::reader::{SiteReader, place};
use crate::ReadError;
use crate::builder::{PlaceFn, Table};
use crate::source::Source;
use crate::yaml::{Yaml, YamlNode};

/// Lists that become paths: key of the list, and name of one element. Lanes come last, so they are
/// drawn on top.
const EDGES: [(&str, &str); 4] = [
    ("walls", "wall"),
    ("doors", "door"),
    ("human_lanes", "human lane"),
    ("lanes", "lane"),
];

/// Lists of a level that are counted but not drawn.
const NOT_DRAWN: [&str; 5] = ["floors", "models", "features", "constraints", "holes"];

/// Graphs counted by number; the editor has nine.
const MAX_GRAPHS: usize = 64;

/// Fills a layout from a file.
pub(super) struct SiteMapper<'a, 'y> {
    reader: SiteReader<'a, 'y>,
    /// Number of bidirectional lanes.
    bidirectional: u64,
    /// Number of lanes per graph.
    graphs: BTreeMap<i64, u64>,
}

impl<'a, 'y> SiteMapper<'a, 'y> {
    pub(super) fn new(source: Source<'a>, file_bytes: usize) -> Self {
        Self {
            reader: SiteReader::new(source, file_bytes),
            bidirectional: 0,
            graphs: BTreeMap::new(),
        }
    }

    /// Maps the whole file and returns the layout.
    ///
    /// # Errors
    /// When the layout exceeds a limit, or when the caller cancels.
    pub(super) fn read(
        mut self,
        yaml: &'y Yaml<'y>,
        root: YamlNode<'y>,
        levels: YamlNode<'y>,
    ) -> Result<Layout, ReadError> {
        self.report_document(yaml);
        let all: Result<Vec<_>, _> = levels
            .entries()
            .map(|(name, content)| Level::read(&mut self.reader.builder, name, content))
            .collect();
        let levels = all?;
        let is_graph = is_graph(&levels);
        let coordinates = match is_graph {
            true => Coordinates::Meters,
            false => self.coordinates(root),
        };
        let name = root.get("reference_level_name").and_then(YamlNode::text);
        let reference = levels.iter().position(|level| Some(level.name) == name);
        if let (Some(named), None) = (root.get("reference_level_name"), reference) {
            let message = || format!("there is no level `{}`", name.unwrap_or(named.kind()));
            let at: PlaceFn<'_> = &|| place("reference_level_name", named);
            let remedy = "The first level is used; correct the name";
            self.reader
                .builder
                .report(Code::UnknownValue, at, message, remedy);
        }
        let reference = reference.unwrap_or(0);
        let frames = frames(&mut self.reader.builder, coordinates, &levels, reference);
        for (index, (level, frame)) in levels.iter().zip(&frames).enumerate() {
            self.map_level(index as u32, level, *frame)?;
        }
        map_lifts(&mut self.reader, root, &levels, &frames, reference)?;
        self.count_elements(&levels, root, is_graph);
        Ok(self.reader.builder.layout)
    }

    /// Reports duplicate keys and further documents of the file.
    fn report_document(&mut self, yaml: &Yaml<'_>) {
        for (key, line) in &yaml.duplicate_keys {
            let at: PlaceFn<'_> = &|| Place {
                element: "an object".into(),
                line: Some(*line),
            };
            let message = || format!("the key `{key}` occurs more than once");
            let remedy = "The last value is used; remove the others";
            self.reader
                .builder
                .report(Code::DuplicateKey, at, message, remedy);
        }
        if let Some(line) = yaml.next_document {
            let at: PlaceFn<'_> = &|| Place {
                element: "the next document".into(),
                line: Some(line),
            };
            let message = || "the file contains more than one document".to_owned();
            let remedy = "Only the first one is read; split the file";
            self.reader
                .builder
                .report(Code::NotDrawn, at, message, remedy);
        }
    }

    /// The coordinate system of the file. Reports an unknown one.
    fn coordinates(&mut self, root: YamlNode<'_>) -> Coordinates {
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
                let message = || format!("unknown coordinate system `{name}`");
                let remedy = "Pixels of a floor plan are assumed; correct the name";
                self.reader
                    .builder
                    .report(Code::UnknownValue, at, message, remedy);
                Coordinates::Image
            }
        }
    }

    fn map_level(&mut self, index: u32, level: &Level<'y>, frame: Frame) -> Result<(), ReadError> {
        let elevation = level.content.get("elevation");
        if let Some(odd) = elevation.filter(|e| e.number().is_none()) {
            self.reader
                .report_type(&|| level.place("elevation"), "a number", odd);
        }
        let elevation = elevation.and_then(YamlNode::number);
        self.reader
            .builder
            .layout
            .levels
            .push(guideway_layout::Level {
                id: level.name.to_owned(),
                name: None,
                elevation_m: elevation.filter(|e| e.is_finite()),
                attributes: guideway_layout::Attributes::default(),
            });
        let mut nodes = Vec::with_capacity(level.positions.len());
        for (i, vertex) in level
            .content
            .get("vertices")
            .into_iter()
            .flat_map(YamlNode::items)
            .enumerate()
        {
            nodes.push(self.map_vertex(index, level, frame, i, vertex)?);
        }
        for (key, element) in EDGES {
            for (i, edge) in level.list(&mut self.reader.builder, key).enumerate() {
                self.map_edge(index, level, &nodes, (key, element, i), edge)?;
            }
        }
        for key in NOT_DRAWN {
            let count = level.count(key);
            if count > 0 {
                let at: PlaceFn<'_> = &|| level.place(key);
                let remedy = "They are left out; Guideway draws vertices, lanes, walls, doors and \
                              lifts only";
                self.reader.builder.report(
                    Code::NotDrawn,
                    at,
                    || format!("{key}: {count}"),
                    remedy,
                );
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
        if let Some(parameters) = parameters {
            set_parameters(&mut self.reader, Table::Nodes, row as usize, parameters, at)?;
        }
        Ok(Some(row))
    }

    fn map_edge(
        &mut self,
        level_index: u32,
        level: &Level<'y>,
        nodes: &[Option<u32>],
        (key, element, index): (&str, &str, usize),
        edge: YamlNode<'y>,
    ) -> Result<(), ReadError> {
        let at: PlaceFn<'_> = &|| level.item_place(key, index, edge);
        let id = format!("{}.{key}[{index}]", level.name);
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
        let element = Value::Text(element);
        self.reader
            .builder
            .set(Table::Paths, row, "element", element)?;
        match parameters {
            Some(parameters) => set_parameters(&mut self.reader, Table::Paths, row, parameters, at),
            None => Ok(()),
        }
    }

    fn count_graph(&mut self, graph: i64) {
        if self.graphs.len() < MAX_GRAPHS || self.graphs.contains_key(&graph) {
            *self.graphs.entry(graph).or_insert(0) += 1;
        }
    }

    /// Sets the provenance: format, version and element counts.
    fn count_elements(&mut self, levels: &[Level<'_>], root: YamlNode<'_>, is_graph: bool) {
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
        let provenance = &mut self.reader.builder.layout.provenance;
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

/// Whether the file is a navigation graph: the third value of its first vertex is parameters or
/// missing. In a building it is a height.
fn is_graph(levels: &[Level<'_>]) -> bool {
    let vertices = levels
        .iter()
        .filter_map(|level| level.content.get("vertices"));
    let mut third = vertices
        .flat_map(YamlNode::items)
        .map(|vertex| vertex.item(2));
    third
        .next()
        .is_some_and(|item| item.is_none_or(YamlNode::is_map))
}
