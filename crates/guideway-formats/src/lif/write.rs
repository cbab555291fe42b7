//! LIF writer: writes a layout as JSON, one line per node, edge and station, in batches on all
//! cores.

use std::io::{self, Write};
use std::iter;
use std::time::SystemTime;

use guideway_layout::{Layout, Level};
use rayon::prelude::*;
use serde::Serialize;
use serde_json::{Map, Value, json};

use super::passthrough::{Unmodeled, merge};
use super::version::Version;
use super::write_columns::column_json;
use super::write_edges::{EdgeRef, Edges};
use super::write_network::Network;
use super::write_objects::Position;
use crate::Losses;
use crate::common_losses::common_losses;

/// Lines per task of a thread.
const TASK_LINES: usize = 1 << 8;

/// Tasks per batch, which bounds the text in memory.
const BATCH_TASKS: usize = 1 << 5;

/// Options of [`write_layout`].
#[derive(Clone, Copy, Debug)]
pub struct WriteOptions {
    /// Version of the format.
    pub version: Version,
    /// Time of the export, for `exportTimestamp`.
    pub exported: SystemTime,
}

/// Writes a layout: levels as layouts, nodes, stations, and paths as edges. Returns the losses.
///
/// A path that is not the straight line between its nodes has a trajectory: the same curve with
/// clamped knots. Positions have a resolution of one micrometer. If the layout was read from a file
/// of the same version, the members that the model does not hold pass through unchanged: actions,
/// descriptions, values per vehicle type.
///
/// # Errors
/// When `out` fails.
pub fn write_layout(
    layout: &Layout,
    out: &mut impl Write,
    options: &WriteOptions,
) -> io::Result<Losses> {
    let version = options.version;
    let unmodeled = Unmodeled::of_layout(layout, version);
    let mut losses = match unmodeled {
        Some(ref unmodeled) => Losses::of_paths(layout, unmodeled.count_lost(layout)),
        None => common_losses(layout),
    };
    let unmodeled = unmodeled.unwrap_or_default();
    losses.add_widths(layout);
    losses.add_colors(layout);
    losses.add_ranks(layout);
    let is_held = |name: &str| matches!(name, "nodeName" | "mapId");
    losses.add_columns(&layout.nodes.attributes, "nodes", is_held);
    losses.add_columns(&layout.stations.attributes, "stations", |name| {
        station_names(version).contains(&name)
    });
    let network = Network::complete(layout, &mut losses);
    let edges = Edges::collect(layout, &network, version, &mut losses);

    let mut meta = unmodeled.meta.clone();
    let project = version.pick("projectIdentification", "lifId");
    meta.entry(project)
        .or_insert_with(|| source_name(layout).into());
    let exported = humantime::format_rfc3339_millis(options.exported).to_string();
    for (name, value) in [
        ("creator", concat!("Guideway ", env!("CARGO_PKG_VERSION"))),
        ("exportTimestamp", &exported),
        ("lifVersion", version.pick("1.0.0", "2.0.0")),
    ] {
        meta.insert(name.into(), value.into());
    }
    write!(out, "{{\"metaInformation\": {}", Value::Object(meta))?;
    for (name, value) in &unmodeled.root {
        write!(out, ",\n{}: {value}", json!(name))?;
    }
    let file = File {
        layout,
        network: &network,
        edges: &edges,
        unmodeled: &unmodeled,
        version,
    };
    let write_level = |index: usize, out: &mut _| file.write_level(index, out);
    match version {
        Version::V1 => {
            let levels = 0..network.levels().count();
            write_array(out, "layouts", levels, write_level)?;
        }
        Version::V2 => {
            let origins = origins(&network, &unmodeled);
            write_array(
                out,
                "origins",
                origins.into_iter(),
                |(mut origin, levels), out| {
                    origin.entry("originId").or_insert_with(|| "origin".into());
                    open_object(out, origin)?;
                    write_array(out, "layouts", levels.into_iter(), write_level)?;
                    write!(out, "}}")
                },
            )?;
        }
    }
    writeln!(out, "}}")?;
    Ok(losses)
}

/// Returns the origins of a file, each with the indices of its levels. The first one has the levels
/// without an origin.
fn origins(
    network: &Network<'_>,
    unmodeled: &Unmodeled<'_>,
) -> Vec<(Map<String, Value>, Vec<usize>)> {
    let origin_of = |id: &String| {
        let mut origins = unmodeled.origins.iter();
        origins.position(|(_, ids)| ids.contains(id))
    };
    let known = unmodeled
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

/// Writes the members of an object without its closing brace.
fn open_object(out: &mut impl Write, members: Map<String, Value>) -> io::Result<()> {
    let text = Value::Object(members).to_string();
    write!(out, "{}", text.strip_suffix('}').unwrap_or(&text))
}

/// Parts of a file.
struct File<'a> {
    layout: &'a Layout,
    network: &'a Network<'a>,
    edges: &'a Edges<'a>,
    unmodeled: &'a Unmodeled<'a>,
    version: Version,
}

impl File<'_> {
    fn write_level<W: Write>(&self, index: usize, out: &mut W) -> io::Result<()> {
        let (layout, network, version) = (self.layout, self.network, self.version);
        let Some(level) = network.levels().nth(index) else {
            return Ok(());
        };
        let mut members = self.unmodeled.level_members(&level.id);
        members.insert("layoutId".into(), level.id.as_str().into());
        if let Some(name) = &level.name {
            members.insert("layoutName".into(), name.as_str().into());
        }
        members.entry("layoutVersion").or_insert_with(|| "1".into());
        open_object(out, members)?;
        write_lines(out, "nodes", network.nodes_on(index), |&node, line| {
            let id = network.node_id(node);
            let object = network.node(layout, node, version);
            self.write_object(level, "nodeId", id, &object, line)
        })?;
        let edges = network
            .paths_on(index)
            .flat_map(|path| self.edges.of_path(path));
        let edges = edges.map(EdgeLine::OfPath);
        let refused = self
            .unmodeled
            .refused_edges(&level.id)
            .map(EdgeLine::Refused);
        write_lines(
            out,
            "edges",
            edges.chain(refused),
            |edge, line| match edge {
                EdgeLine::OfPath(edge) => {
                    self.write_object(level, "edgeId", edge.id, &self.edges.object(edge), line)
                }
                EdgeLine::Refused(edge) => serde_json::to_writer(line, edge),
            },
        )?;
        write_lines(
            out,
            "stations",
            network.stations_on(index),
            |&station, line| {
                let id = layout.stations.id(station);
                self.write_object(level, "stationId", id, &self.station(station), line)
            },
        )?;
        write!(out, "}}")
    }

    /// Writes an object of a level, merged with its unmodeled members.
    fn write_object(
        &self,
        level: &Level,
        id_key: &str,
        id: &str,
        new: &impl Serialize,
        line: &mut Vec<u8>,
    ) -> serde_json::Result<()> {
        match merge(self.unmodeled, &level.id, id_key, id, new) {
            Some(merged) => serde_json::to_writer(line, &merged),
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

/// A line of the array of edges.
enum EdgeLine<'a> {
    OfPath(EdgeRef<'a>),
    /// A refused edge of the file, unchanged.
    Refused(Value),
}

/// Writes a member `name` with an array, after other members.
fn write_array<T, W: Write>(
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

/// Writes a member `name` with an array of one line per item, formatted on several threads.
fn write_lines<T: Send + Sync, W: Write>(
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
    let batches = iter::from_fn(|| {
        let batch: Vec<T> = items.by_ref().take(BATCH_TASKS * TASK_LINES).collect();
        (!batch.is_empty()).then_some(batch)
    });
    let texts =
        batches.flat_map(|batch| batch.par_chunks(TASK_LINES).map(lines).collect::<Vec<_>>());
    write_array(out, name, texts, |text, out| out.write_all(&text?))
}

/// Returns the name of the source file, for the project identifier.
fn source_name(layout: &Layout) -> &str {
    let source = &layout.provenance.source;
    source.rsplit(['/', '\\']).next().unwrap_or(source)
}

/// Returns the columns that a version has a station member for.
fn station_names(version: Version) -> &'static [&'static str] {
    match version {
        Version::V1 => &["stationName", "stationHeight"],
        Version::V2 => &["stationName", "stationHeight", "stationType"],
    }
}
