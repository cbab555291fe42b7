//! A layout as LIF 1.0 or 2.0: a line for each node, edge and station, written as it comes.

use std::io::{self, Write};
use std::iter;
use std::time::SystemTime;

use guideway_layout::{Layout, Level};
use rayon::prelude::*;
use serde::Serialize;
use serde_json::{Map, Value, json};

use super::rest::Rest;
use super::write_columns::{Version, column_json};
use super::write_edges::{EdgeRef, Edges};
use super::write_network::Network;
use super::write_objects::Position;
use crate::Losses;

/// One thread writes so many lines before it looks for others.
const TASK: usize = 1 << 8;

/// So many tasks are in memory at once.
const AT_ONCE: usize = 1 << 5;

/// How to write a layout.
#[derive(Clone, Copy, Debug)]
pub struct WriteOptions {
    /// Which version of the format.
    pub version: Version,
    /// When the file was exported, as it will state.
    pub exported: SystemTime,
}

/// Writes a layout: levels as layouts, nodes, stations, and paths as edges. What is no straight line from
/// node to node gets a trajectory, the same curve over clamped knots. Positions are to a micrometer. What the layout
/// has not of a file of the same version is kept as it was: actions, descriptions, values for each vehicle type.
/// Returns what the format cannot hold.
///
/// # Errors
/// When `out` fails.
pub fn write_layout(
    layout: &Layout,
    out: &mut impl Write,
    options: &WriteOptions,
) -> io::Result<Losses> {
    let version = options.version;
    let rest = Rest::of(layout, version);
    let mut losses = match rest {
        Some(ref rest) => Losses::of_model(layout, rest.lost(layout)),
        None => Losses::of(layout),
    };
    let rest = rest.unwrap_or_default();
    losses.add_widths(layout);
    losses.add_colors(layout);
    losses.add_ranks(layout);
    let is_held = |name: &str| matches!(name, "nodeName" | "mapId");
    losses.add_columns(&layout.nodes.attributes, "nodes", is_held);
    losses.add_columns(&layout.stations.attributes, "stations", |name| {
        station_names(version).contains(&name)
    });
    let network = Network::of(layout, &mut losses);
    let edges = Edges::of(layout, &network, version, &mut losses);

    let mut meta = rest.meta.clone();
    let project = version.of("projectIdentification", "lifId");
    meta.entry(project)
        .or_insert_with(|| source_name(layout).into());
    let exported = humantime::format_rfc3339_millis(options.exported).to_string();
    for (name, value) in [
        ("creator", concat!("Guideway ", env!("CARGO_PKG_VERSION"))),
        ("exportTimestamp", &exported),
        ("lifVersion", version.of("1.0.0", "2.0.0")),
    ] {
        meta.insert(name.into(), value.into());
    }
    write!(out, "{{\"metaInformation\": {}", Value::Object(meta))?;
    for (name, value) in &rest.root {
        write!(out, ",\n{}: {value}", json!(name))?;
    }
    let file = File {
        layout,
        network: &network,
        edges: &edges,
        rest: &rest,
        version,
    };
    let of_level = |index: usize, out: &mut _| file.level(index, out);
    match version {
        Version::V1 => {
            let levels = 0..network.levels().count();
            list(out, "layouts", levels, of_level)?;
        }
        Version::V2 => {
            let origins = origins(&network, &rest);
            list(
                out,
                "origins",
                origins.into_iter(),
                |(mut origin, levels), out| {
                    origin.entry("originId").or_insert_with(|| "origin".into());
                    begin(out, origin)?;
                    list(out, "layouts", levels.into_iter(), of_level)?;
                    write!(out, "}}")
                },
            )?;
        }
    }
    writeln!(out, "}}")?;
    Ok(losses)
}

/// The origins of a file, each with its levels by their indices. What is on none is on the first.
fn origins(network: &Network<'_>, rest: &Rest<'_>) -> Vec<(Map<String, Value>, Vec<usize>)> {
    let origin_of = |id: &String| rest.origins.iter().position(|(_, ids)| ids.contains(id));
    let known = rest
        .origins
        .iter()
        .map(|(origin, _)| (origin.clone(), Vec::new()));
    let mut origins: Vec<_> = known.collect();
    if origins.is_empty() {
        origins.push(Default::default());
    }
    for (index, level) in network.levels().enumerate() {
        origins[origin_of(&level.id).unwrap_or(0)].1.push(index);
    }
    origins.retain(|(_, levels)| !levels.is_empty());
    origins
}

/// Begins an object that goes on behind its members.
fn begin(out: &mut impl Write, members: Map<String, Value>) -> io::Result<()> {
    let text = Value::Object(members).to_string();
    write!(out, "{}", text.strip_suffix('}').unwrap_or(&text))
}

/// What a file has.
struct File<'a> {
    layout: &'a Layout,
    network: &'a Network<'a>,
    edges: &'a Edges<'a>,
    rest: &'a Rest<'a>,
    version: Version,
}

impl File<'_> {
    fn level<W: Write>(&self, index: usize, out: &mut W) -> io::Result<()> {
        let (layout, network, version) = (self.layout, self.network, self.version);
        let Some(level) = network.levels().nth(index) else {
            return Ok(());
        };
        let mut members = self.rest.level(&level.id);
        members.insert("layoutId".into(), level.id.as_str().into());
        if let Some(name) = &level.name {
            members.insert("layoutName".into(), name.as_str().into());
        }
        members.entry("layoutVersion").or_insert_with(|| "1".into());
        begin(out, members)?;
        table(out, "nodes", network.nodes_on(index), |&node, line| {
            let id = network.node_id(node);
            let object = network.node(layout, node, version);
            self.object(level, "nodeId", id, &object, line)
        })?;
        let edges = network
            .paths_on(index)
            .flat_map(|path| self.edges.of_path(path));
        let edges = edges.map(EdgeLine::OfPath);
        let refused = self.rest.refused(&level.id).map(EdgeLine::Refused);
        table(
            out,
            "edges",
            edges.chain(refused),
            |edge, line| match edge {
                EdgeLine::OfPath(edge) => {
                    self.object(level, "edgeId", edge.id, &self.edges.object(edge), line)
                }
                EdgeLine::Refused(edge) => serde_json::to_writer(line, edge),
            },
        )?;
        table(
            out,
            "stations",
            network.stations_on(index),
            |&station, line| {
                let id = layout.stations.id(station);
                self.object(level, "stationId", id, &self.station(station), line)
            },
        )?;
        write!(out, "}}")
    }

    /// Writes an object of a level, with what it had in the file.
    fn object(
        &self,
        level: &Level,
        id_key: &str,
        id: &str,
        new: &impl Serialize,
        line: &mut Vec<u8>,
    ) -> serde_json::Result<()> {
        match self.rest.kept(&level.id, id_key, id, new) {
            Some(kept) => serde_json::to_writer(line, &kept),
            None => serde_json::to_writer(line, new),
        }
    }

    fn station(&self, station: u32) -> Map<String, Value> {
        let stations = &self.layout.stations;
        let nodes = stations.nodes(station).iter();
        let nodes: Vec<&str> = nodes.map(|&node| self.network.node_id(node)).collect();
        let mut object = Map::new();
        object.insert("stationId".into(), stations.id(station).into());
        object.insert("interactionNodeIds".into(), nodes.into());
        for &name in station_names(self.version) {
            let column = stations.attributes.get(name);
            if let Some(value) = column.and_then(|c| column_json(&c.values, station as usize)) {
                object.insert(name.into(), value);
            }
        }
        if let Some(position) = stations.position_m(station) {
            object.insert("stationPosition".into(), json!(Position::from(position)));
        }
        object
    }
}

/// A line of the list of edges.
enum EdgeLine<'a> {
    OfPath(EdgeRef<'a>),
    /// What is no path, as it was.
    Refused(Value),
}

/// Writes a list of a name, behind other members.
fn list<T, W: Write>(
    out: &mut W,
    name: &str,
    items: impl Iterator<Item = T>,
    mut write_item: impl FnMut(T, &mut W) -> io::Result<()>,
) -> io::Result<()> {
    write!(out, ",\n\"{name}\": [")?;
    for (i, item) in items.enumerate() {
        writeln!(out, "{}", if i == 0 { "" } else { "," })?;
        write_item(item, out)?;
    }
    write!(out, "]")
}

/// Writes a list of a name with a line for each item, which several threads write at once.
fn table<T: Send + Sync, W: Write>(
    out: &mut W,
    name: &str,
    mut items: impl Iterator<Item = T>,
    write_line: impl Fn(&T, &mut Vec<u8>) -> serde_json::Result<()> + Sync,
) -> io::Result<()> {
    let lines = |items: &[T]| -> serde_json::Result<Vec<u8>> {
        let mut text = Vec::new();
        for (i, item) in items.iter().enumerate() {
            text.extend_from_slice(if i == 0 { b"" } else { b",\n" });
            write_line(item, &mut text)?;
        }
        Ok(text)
    };
    let parts = iter::from_fn(|| {
        let part: Vec<T> = items.by_ref().take(AT_ONCE * TASK).collect();
        (!part.is_empty()).then_some(part)
    });
    let texts = parts.flat_map(|part| part.par_chunks(TASK).map(lines).collect::<Vec<_>>());
    list(out, name, texts, |text, out| out.write_all(&text?))
}

/// A name for the project: that of the file that it was read from.
fn source_name(layout: &Layout) -> &str {
    let source = &layout.provenance.source;
    source.rsplit(['/', '\\']).next().unwrap_or(source)
}

/// What a station has beside its identifier, its nodes and its place.
fn station_names(version: Version) -> &'static [&'static str] {
    match version {
        Version::V1 => &["stationName", "stationHeight"],
        Version::V2 => &["stationName", "stationHeight", "stationType"],
    }
}
