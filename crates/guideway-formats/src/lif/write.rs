//! A layout as LIF 1.0 or 2.0: a line for each node, edge and station, written as it comes.

use std::io::{self, Write};
use std::time::SystemTime;

use guideway_layout::{Layout, Values};
use guideway_spline::Point;
use serde_json::{Map, Value, json};

use super::rest::Rest;
use super::write_columns::Version;
use super::write_edges::Edges;
use super::write_network::Network;
use crate::Losses;
use crate::clamped::rounded;

/// How to write a layout.
#[derive(Clone, Copy, Debug)]
pub struct WriteOptions {
    /// Which version of the format.
    pub version: Version,
    /// When the file was exported, as it will state.
    pub exported: SystemTime,
}

/// Writes a layout: levels as layouts, nodes, stations, and paths as edges. What is no straight line from
/// node to node gets a trajectory, the same curve over clamped knots. Positions are to a micrometre. What the layout
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
    losses.widths(layout);
    losses.colors(layout);
    losses.ranks(layout);
    let is_held = |name: &str| matches!(name, "nodeName" | "mapId");
    losses.columns(&layout.nodes.attributes, "nodes", is_held);
    losses.columns(&layout.stations.attributes, "stations", |name| {
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
        let keep = |id_key, new: Value, out: &mut W| {
            let kept = self.rest.keep(&level.id, id_key, new);
            write!(out, "{kept}")
        };
        list(out, "nodes", network.nodes_on(index), |node, out| {
            keep("nodeId", network.node_json(layout, node, version), out)
        })?;
        let refused = self.rest.refused(&level.id);
        let edges = network
            .paths_on(index)
            .flat_map(|path| self.edges.json(path))
            .chain(refused);
        list(out, "edges", edges, |edge, out| keep("edgeId", edge, out))?;
        list(
            out,
            "stations",
            network.stations_on(index),
            |station, out| {
                keep(
                    "stationId",
                    station_json(layout, network, station, version),
                    out,
                )
            },
        )?;
        write!(out, "}}")
    }
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

/// A name for the project: that of the file that it was read from.
fn source_name(layout: &Layout) -> &str {
    let source = &layout.provenance.source;
    source.rsplit(['/', '\\']).next().unwrap_or(source)
}

pub(super) fn position_json(position: Point<f64>) -> Value {
    json!({ "x": rounded(position.x), "y": rounded(position.y) })
}

/// What a station has beside its identifier, its nodes and its place.
fn station_names(version: Version) -> &'static [&'static str] {
    match version {
        Version::V1 => &["stationName", "stationHeight"],
        Version::V2 => &["stationName", "stationHeight", "stationType"],
    }
}

fn station_json(layout: &Layout, network: &Network<'_>, station: u32, version: Version) -> Value {
    let stations = &layout.stations;
    let nodes = stations.nodes(station).iter();
    let nodes: Vec<&str> = nodes.map(|&node| network.node_id(node)).collect();
    let mut json = Map::new();
    json.insert("stationId".into(), stations.id(station).into());
    json.insert("interactionNodeIds".into(), nodes.into());
    for &name in station_names(version) {
        let column = stations.attributes.get(name);
        if let Some(value) = column.and_then(|c| column_json(&c.values, station as usize)) {
            json.insert(name.into(), value);
        }
    }
    if let Some(position) = stations.position_m(station) {
        json.insert("stationPosition".into(), position_json(position));
    }
    Value::Object(json)
}

/// A value of a column as it is.
pub(super) fn column_json(values: &Values, row: usize) -> Option<Value> {
    use guideway_layout::Value as Of;
    match values.get(row)? {
        Of::Bool(value) => Some(value.into()),
        Of::Int(value) => Some(value.into()),
        // JSON has no other numbers.
        Of::Float(value) => value.is_finite().then(|| value.into()),
        Of::Text(value) => Some(value.into()),
    }
}
