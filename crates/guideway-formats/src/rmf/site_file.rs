//! Maps files of the Open-RMF site editor, `*.site.json`, to a layout: meters, y up.
//!
//! ```text
//! levels.ID.anchors, anchors      positions           nodes
//! levels.ID.walls, .doors         pairs of anchors    paths
//! navigation.guided.lanes         pairs of anchors    paths; two-way unless `reverse` is `Disable`
//! navigation.guided.locations     names and tags      names and columns of nodes
//! navigation.guided.graphs        names               vehicle types of lanes
//! lifts                           two anchors         stations
//! ```
//!
//! Source: the site files and the documentation of `rmf_site_format` 0.0.2.

use std::collections::{HashMap, HashSet};

use guideway_layout::{Code, Direction, Layout, Level, Member, NewPath, Place, Value};
use guideway_spline::{Point, Runs};

use super::parameters::{set_json, set_parameters};
use super::reader::{SiteReader, place};
use crate::ReadError;
use crate::builder::{PlaceFn, Table};
use crate::source::Source;
use crate::yaml::YamlNode;

/// Version of a site file, as the provenance of its layout states it.
const SITE: &str = "site";

/// Lists of pairs of anchors of a level, and the element that each pair is.
const EDGES: [(&str, &str); 2] = [("walls", "wall"), ("doors", "door")];

/// Members of a level that are read, or that are no elements of a floor.
const READ: [&str; 5] = ["properties", "anchors", "walls", "doors", "rankings"];

/// Graphs that are read: every lane may belong to every graph.
const MAX_GRAPHS: usize = 64;

/// Tags of locations, and the column of each in navigation graphs.
const TAGS: [(&str, &str); 3] = [
    ("Charger", "is_charger"),
    ("ParkingSpot", "is_parking_spot"),
    ("HoldingPoint", "is_holding_point"),
];

/// Returns whether the root of a file is that of a site.
pub(super) fn is_site(root: YamlNode<'_>) -> bool {
    root.get("navigation").is_some() || root.get("format_version").is_some()
}

/// Fills a layout from a site.
pub(super) struct SiteFileMapper<'a, 'y> {
    reader: SiteReader<'a, 'y>,
    root: YamlNode<'y>,
    /// Row of the node of each anchor.
    nodes: HashMap<&'y str, u32>,
    /// Anchors within lifts, which move between levels.
    in_lifts: HashSet<&'y str>,
    /// Identifier and name of each graph.
    graphs: Vec<(&'y str, &'y str)>,
    lanes: u64,
}

impl<'a, 'y> SiteFileMapper<'a, 'y> {
    pub(super) fn new(source: Source<'a>, file_bytes: usize, root: YamlNode<'y>) -> Self {
        let mut reader = SiteReader::new(source, file_bytes);
        // Its parameters have no types, as those of a navigation graph.
        reader.is_graph = true;
        Self {
            reader,
            root,
            nodes: HashMap::new(),
            in_lifts: HashSet::new(),
            graphs: Vec::new(),
            lanes: 0,
        }
    }

    /// Maps the whole file and returns the layout.
    ///
    /// # Errors
    /// When the layout exceeds a limit, or when the caller cancels.
    pub(super) fn read(mut self) -> Result<Layout, ReadError> {
        let guided = self.root.get("navigation").and_then(|n| n.get("guided"));
        let locations = entries(guided, "locations");
        let names = locations.filter_map(|(_, location)| {
            let name = location.get("name").and_then(YamlNode::text)?;
            Some((location.get("anchor")?.text()?, name))
        });
        let names: HashMap<&str, &str> = names.filter(|(_, name)| !name.is_empty()).collect();
        for (_, lift) in entries(Some(self.root), "lifts") {
            let anchors = entries(Some(lift), "cabin_anchors").map(|(id, _)| id);
            self.in_lifts.extend(anchors);
        }
        for (index, (id, level)) in entries(Some(self.root), "levels").enumerate() {
            self.map_level(id, level)?;
            self.map_anchors(level, Some(index as u32), &names)?;
        }
        self.map_anchors(self.root, None, &names)?;
        for (index, (_, level)) in entries(Some(self.root), "levels").enumerate() {
            for (key, element) in EDGES {
                for (id, edge) in entries(Some(level), key) {
                    self.map_edge(id, edge, element, Some(index as u32))?;
                }
            }
        }
        for (id, graph) in entries(guided, "graphs") {
            let name = graph.get("name").and_then(YamlNode::text);
            let name = name.filter(|name| !name.is_empty()).unwrap_or(id);
            self.reader.builder.check_text(name)?;
            if self.graphs.len() == MAX_GRAPHS {
                let at: PlaceFn<'_> = &|| place(&format!("graph \"{name}\""), graph);
                let message = || format!("the site has more than {MAX_GRAPHS} graphs");
                let remedy = "Lanes are read without the others; split the site";
                let builder = &mut self.reader.builder;
                builder.report(Code::Attribute, at, message, remedy);
                break;
            }
            self.graphs.push((id, name));
        }
        for (id, lane) in entries(guided, "lanes") {
            self.lanes += 1;
            self.map_edge(id, lane, "lane", None)?;
        }
        for (_, location) in entries(guided, "locations") {
            self.map_location(location)?;
        }
        for (id, lift) in entries(Some(self.root), "lifts") {
            self.map_lift(id, lift)?;
        }
        let name = self.root.get("properties").and_then(|p| p.get("name"));
        let builder = &mut self.reader.builder;
        if let Some(name) = name.and_then(YamlNode::text) {
            builder.check_text(name)?;
            builder.set(Table::Layout, 0, "name", Value::Text(name))?;
        }
        let provenance = &mut builder.layout.provenance;
        crate::Format::Rmf.name().clone_into(&mut provenance.format);
        SITE.clone_into(&mut provenance.format_version);
        let counts = [
            ("levels", entries(Some(self.root), "levels").count() as u64),
            ("anchors", self.nodes.len() as u64),
            ("lanes", self.lanes),
            ("locations", entries(guided, "locations").count() as u64),
            ("lifts", entries(Some(self.root), "lifts").count() as u64),
        ];
        provenance.counts = counts.map(|(name, count)| (name.to_owned(), count)).into();
        Ok(self.reader.builder.layout)
    }

    /// Appends a level. Reports elements that are no paths.
    fn map_level(&mut self, id: &'y str, level: YamlNode<'y>) -> Result<(), ReadError> {
        let builder = &mut self.reader.builder;
        let property = |key| level.get("properties").and_then(|p| p.get(key));
        let name = property("name").and_then(YamlNode::text);
        builder.check_text(id)?;
        builder.check_text(name.unwrap_or_default())?;
        let elevation = property("elevation").and_then(YamlNode::number);
        builder.layout.levels.push(Level {
            id: id.to_owned(),
            name: name.map(str::to_owned),
            elevation_m: elevation.filter(|e| e.is_finite()),
            ..Level::default()
        });
        for (key, list) in level.entries().filter(|(key, _)| !READ.contains(key)) {
            let count = list.entries().count();
            if count > 0 {
                let at: PlaceFn<'_> = &|| place(&format!("levels.{id}.{key}"), list);
                let message = || format!("{key}: {count}");
                let remedy = "They are left out; Guideway draws lanes, walls and doors";
                builder.report(Code::NotDrawn, at, message, remedy);
            }
        }
        Ok(())
    }

    /// Appends a node per anchor of a level or of the site.
    fn map_anchors(
        &mut self,
        owner: YamlNode<'y>,
        level: Option<u32>,
        names: &HashMap<&'y str, &'y str>,
    ) -> Result<(), ReadError> {
        for (id, anchor) in entries(Some(owner), "anchors") {
            let at: PlaceFn<'_> = &|| place(&format!("anchors.{id}"), anchor);
            let builder = &mut self.reader.builder;
            let Some(position) = position(anchor) else {
                let message = || "the anchor has no position".to_owned();
                let remedy = "Give it `Translate2D`; lanes that end there are not drawn";
                builder.report(Code::MissingField, at, message, remedy);
                continue;
            };
            let name = names.get(id).copied().unwrap_or(id);
            builder.check_text(name)?;
            if builder.check_point(position, at) {
                let row = builder.push_node(name, position, level)?;
                let source = &mut builder.layout.nodes.source;
                source.set_position(row as usize, anchor.position());
                self.nodes.insert(id, row);
            }
        }
        Ok(())
    }

    /// Maps a lane, a wall or a door to a path. `level` is that of a wall or a door; a lane has
    /// that of its anchors.
    fn map_edge(
        &mut self,
        id: &'y str,
        edge: YamlNode<'y>,
        element: &str,
        level: Option<u32>,
    ) -> Result<(), ReadError> {
        let at: PlaceFn<'_> = &|| place(&format!("{element} \"{id}\""), edge);
        let builder = &mut self.reader.builder;
        let anchors = edge.get("anchors");
        let anchor = |index| anchors.and_then(|list| list.item(index)?.text());
        let ends = [anchor(0), anchor(1)];
        let name = edge.get("name").and_then(YamlNode::text);
        let name = name.filter(|name| element == "door" && !name.is_empty());
        let path_id = name.unwrap_or(id);
        builder.check_text(path_id)?;
        let known = ends.map(|end| self.nodes.get(end.unwrap_or_default()).copied());
        let [Some(start), Some(end)] = known else {
            let is_lift = ends.iter().flatten().any(|end| self.in_lifts.contains(end));
            let (code, detail) = match is_lift {
                true => (Code::CrossLevel, "it leads into a lift"),
                false => (Code::UnknownNode, "one of its anchors is not in the file"),
            };
            let remedy = match is_lift {
                true => "Nothing to do; a lift is a station",
                false => "It is left out; correct the anchors in the editor",
            };
            return builder.refuse_at(path_id, code, detail, at, remedy);
        };
        let nodes = &builder.layout.nodes;
        let (from, to) = (nodes.level(start), nodes.level(end));
        if level.is_none() && from != to && from.is_some() && to.is_some() {
            let detail = "its anchors are on different levels";
            let remedy = "Nothing to do if it is meant to; lifts connect levels";
            return builder.refuse_at(path_id, Code::CrossLevel, detail, at, remedy);
        }
        let mut runs = Runs::default();
        runs.push_line(nodes.position_m(start), nodes.position_m(end));
        let is_one_way = edge.get("reverse").and_then(YamlNode::text) == Some("Disable");
        let fleets = match element {
            "lane" => self.fleets(edge),
            _ => Vec::new(),
        };
        let builder = &mut self.reader.builder;
        let row = builder.push_path(&NewPath {
            id: path_id,
            runs: &runs,
            start_node: Some(start),
            end_node: Some(end),
            direction: match is_one_way {
                true => Direction::Forward,
                false => Direction::Both,
            },
            level: level.or(from).or(to),
            vehicle_types: &fleets,
        })?;
        let source = &mut builder.layout.paths.source;
        source.set_position(row, edge.position());
        builder.set(Table::Paths, row, "element", Value::Text(element))?;
        if element != "lane" {
            return Ok(());
        }
        if let Some(mutex) = edge.get("mutex").and_then(YamlNode::text) {
            self.reader.add_to_mutex(mutex, Member::Path(row as u32));
        }
        let to = (Table::Paths, row);
        if let Some(reverse) = edge.get("reverse").filter(|reverse| reverse.is_map()) {
            set_json(&mut self.reader, to, "reverse", reverse, at)?;
        }
        match edge.get("forward") {
            Some(forward) => set_parameters(&mut self.reader, to, forward, |_| false, at),
            None => Ok(()),
        }
    }

    /// The names of the graphs that a lane belongs to; empty if it belongs to all.
    fn fleets(&self, lane: YamlNode<'y>) -> Vec<&'y str> {
        let graphs = lane.get("graphs");
        let list = |key| {
            let list = graphs.and_then(|graphs| graphs.get(key))?;
            Some(
                list.items()
                    .filter_map(YamlNode::text)
                    .collect::<HashSet<_>>(),
            )
        };
        let (only, except) = (list("Only"), list("AllExcept"));
        let is_in = |id: &str| {
            only.as_ref().is_none_or(|only| only.contains(id))
                && except.as_ref().is_none_or(|except| !except.contains(id))
        };
        if only.is_none() && except.is_none() {
            return Vec::new();
        }
        let graphs = self.graphs.iter().filter(|(id, _)| is_in(id));
        graphs.map(|(_, name)| *name).collect()
    }

    /// Stores the tags of a location at its node.
    fn map_location(&mut self, location: YamlNode<'y>) -> Result<(), ReadError> {
        let at: PlaceFn<'_> = &|| place("a location", location);
        let anchor = location.get("anchor").and_then(YamlNode::text);
        let Some(&node) = anchor.and_then(|anchor| self.nodes.get(anchor)) else {
            let message = || "its anchor is not in the file".to_owned();
            let remedy = "It is left out; correct the anchor in the editor";
            let builder = &mut self.reader.builder;
            builder.report(Code::UnknownNode, at, message, remedy);
            return Ok(());
        };
        let Some(tags) = location.get("tags") else {
            return Ok(());
        };
        let to = (Table::Nodes, node as usize);
        let is_known = |tag: YamlNode<'_>| TAGS.iter().any(|(name, _)| tag.text() == Some(name));
        for (tag, column) in TAGS {
            if tags.items().any(|found| found.text() == Some(tag)) {
                let builder = &mut self.reader.builder;
                builder.set(to.0, to.1, column, Value::Bool(true))?;
            }
        }
        match tags.items().all(is_known) {
            true => Ok(()),
            false => set_json(&mut self.reader, to, "tags", tags, at),
        }
    }

    /// Appends a station in the middle of the anchors of a lift.
    fn map_lift(&mut self, id: &'y str, lift: YamlNode<'y>) -> Result<(), ReadError> {
        let builder = &mut self.reader.builder;
        let properties = lift.get("properties");
        let property = |key| {
            properties
                .and_then(|p| p.get(key))
                .or_else(|| lift.get(key))
        };
        let name = property("name").and_then(YamlNode::text).unwrap_or(id);
        builder.check_text(name)?;
        let anchors = property("reference_anchors");
        let end = |index| {
            let anchor = anchors?.item(index)?.text()?;
            let node = *self.nodes.get(anchor)?;
            Some(builder.layout.nodes.position_m(node))
        };
        let middle = end(0)
            .zip(end(1))
            .map(|(a, b): (Point<f64>, _)| a.lerp(b, 0.5));
        if middle.is_none() {
            let at: PlaceFn<'_> = &|| Place {
                line: Some(lift.line()),
                ..Place::element(format!("lift \"{name}\""))
            };
            let message = || "the lift has no position".to_owned();
            let remedy = "Give it two reference anchors in the editor";
            builder.report(Code::MissingField, at, message, remedy);
        }
        let row = builder.push_station(name, middle, Vec::new(), None)? as usize;
        let source = &mut builder.layout.stations.source;
        source.set_position(row, lift.position());
        builder.set(Table::Stations, row, "kind", Value::Text("lift"))
    }
}

/// The keys and values of an object within another one.
fn entries<'y>(
    owner: Option<YamlNode<'y>>,
    key: &str,
) -> impl Iterator<Item = (&'y str, YamlNode<'y>)> + use<'y> {
    let found = owner.and_then(|owner| owner.get(key));
    found.into_iter().flat_map(YamlNode::entries)
}

/// The position of an anchor, in meters.
fn position(anchor: YamlNode<'_>) -> Option<Point<f64>> {
    let categorized = || anchor.get("CategorizedTranslate2D")?.get("General");
    let pose = || anchor.get("Pose3D")?.get("trans");
    let list = anchor
        .get("Translate2D")
        .or_else(categorized)
        .or_else(pose)?;
    Some(Point::new(list.item(0)?.number()?, list.item(1)?.number()?))
}
