//! A layout as LIF 1.0 or 2.0: a line for each node, edge and station, written as it comes.

use std::io::{self, Write};
use std::time::SystemTime;

use guideway_layout::{Layout, Values};
use guideway_spline::Point;
use serde_json::{Map, Value, json};

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
/// node to node gets a trajectory, the same curve over clamped knots. Positions are to a micrometre. Returns
/// what the format cannot hold.
///
/// # Errors
/// When `out` fails.
pub fn write_layout(
    layout: &Layout,
    out: &mut impl Write,
    options: &WriteOptions,
) -> io::Result<Losses> {
    let version = options.version;
    let mut losses = Losses::of(layout);
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

    let head = json!({
        version.of("projectIdentification", "lifId"): source_name(layout),
        "creator": concat!("Guideway ", env!("CARGO_PKG_VERSION")),
        "exportTimestamp": humantime::format_rfc3339_millis(options.exported).to_string(),
        "lifVersion": version.of("1.0.0", "2.0.0"),
    });
    write!(out, "{{\"metaInformation\": {head},\n\"")?;
    write!(
        out,
        "{}",
        version.of(
            "layouts",
            "origins\": [{\"originId\": \"origin\",\n\"layouts"
        )
    )?;
    write!(out, "\": [")?;
    for (index, level) in network.levels().enumerate() {
        let separator = if index == 0 { "" } else { "," };
        write!(out, "{separator}\n{{\"layoutId\": {}", json!(level.id))?;
        if let Some(name) = &level.name {
            write!(out, ", \"layoutName\": {}", json!(name))?;
        }
        write!(out, ", \"layoutVersion\": \"1\"")?;
        let nodes = network.nodes_on(index);
        list(
            out,
            "nodes",
            nodes.map(|node| network.node_json(layout, node, version)),
        )?;
        list(
            out,
            "edges",
            network.paths_on(index).flat_map(|path| edges.json(path)),
        )?;
        let stations = network.stations_on(index);
        let stations = stations.map(|station| station_json(layout, &network, station, version));
        list(out, "stations", stations)?;
        write!(out, "}}")?;
    }
    writeln!(out, "]{}}}", version.of("", "}]"))?;
    Ok(losses)
}

fn list(out: &mut impl Write, name: &str, items: impl Iterator<Item = Value>) -> io::Result<()> {
    write!(out, ",\n\"{name}\": [")?;
    for (i, item) in items.enumerate() {
        write!(out, "{}\n{item}", if i == 0 { "" } else { "," })?;
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
