//! Nav2 writer: writes a layout as a route graph, as the route server of Nav2 loads it.
//!
//! Source: the [route server](https://docs.nav2.org/configuration/packages/configuring-route-server.html)
//! and the conventions for metadata in its package.

use std::io::{self, Write};

use guideway_layout::{Attribute, Attributes, Layout, Value};

use super::json_writer::JsonWriter;
use super::lines::{is_of_lines, lines};
use super::names;
use super::nav2_ids::Nav2Ids;
use super::nav2_values::{Kind, Placement, is_metadata, placement};
use super::write::WriteOptions;
use crate::Losses;
use crate::finite::check_finite;
use crate::losses::common_losses;
use crate::source::WrittenPaths;

/// Writes a layout as a route graph of Nav2: nodes as points, paths as directed edges with whole
/// numbers as identifiers, columns as metadata. Returns the losses.
///
/// A two-way path is two edges. `maxSpeed` is `abs_speed_limit`, in meters per second; Nav2's
/// `speed_limit` is a percentage. Positions are meters, with a resolution of one micrometer.
///
/// # Errors
/// When `out` fails.
pub fn write_route_graph(
    layout: &Layout,
    out: &mut impl Write,
    options: &WriteOptions,
) -> io::Result<Losses> {
    write_route_graph_watched(layout, out, options, &WrittenPaths::unwatched())
}

/// Writes as [`write_route_graph`] does, and counts the paths.
pub(crate) fn write_route_graph_watched(
    layout: &Layout,
    out: &mut impl Write,
    options: &WriteOptions,
    written_paths: &WrittenPaths<'_>,
) -> io::Result<Losses> {
    check_finite(layout)?;
    let ids = Nav2Ids::new(layout);
    let mut json = JsonWriter::new(out, None);
    json.begin('{')?;
    json.field("type", "FeatureCollection")?;
    json.key("guideway")?;
    json.begin('{')?;
    json.field("format", names::ROUTE_GRAPH)?;
    json.end('}')?;
    json.key("crs")?;
    let crs = r#"{"type":"name","properties":{"name":"urn:ogc:def:crs:EPSG::3857"}}"#;
    json.value(Value::Json(crs))?;
    json.key("features")?;
    json.begin('[')?;
    let columns: Vec<&Attribute> = layout.nodes.attributes.iter().collect();
    for (node, number) in ids.nodes.iter().enumerate() {
        let Some(number) = *number else {
            continue;
        };
        let row = node as u32;
        begin(&mut json, number)?;
        let value = |name: &str| layout.nodes.attributes.value(node, name);
        let id = layout.nodes.id(row);
        write_properties(&mut json, Kind::Node, (number, id), &columns, value)?;
        json.end('}')?;
        json.point(layout.nodes.position_m(row))?;
    }
    let columns: Vec<&str> = layout.paths.column_names().collect();
    let columns = columns
        .into_iter()
        .filter_map(|name| layout.paths.column(name));
    let columns: Vec<&Attribute> = columns.collect();
    for path in layout.paths.iter() {
        written_paths.count();
        let ends = [path.start_node(), path.end_node()];
        let ends = ends.map(|node| ids.nodes[node? as usize]);
        let (Some(edge), [Some(start), Some(end)]) = (&ids.edges[path.row()], ends) else {
            continue;
        };
        let mut lines = lines(path, options.tolerance_m);
        let reverse = edge.reverse.as_ref();
        let reverse = reverse.map(|(number, id)| (*number, id.as_str(), [end, start]));
        let edges = [(edge.number, path.id(), [start, end])].into_iter();
        for (number, id, [start, end]) in edges.chain(reverse) {
            begin(&mut json, number)?;
            json.field("startid", &start)?;
            json.field("endid", &end)?;
            let value = |name: &str| layout.paths.value(path.row(), name);
            write_properties(&mut json, Kind::Edge, (number, id), &columns, value)?;
            json.end('}')?;
            json.lines(&lines)?;
            lines.reverse();
            lines.iter_mut().for_each(|line| line.reverse());
        }
    }
    json.end(']')?;
    json.end('}')?;
    out.write_all(b"\n")?;
    Ok(list_losses(layout, &ids, options.tolerance_m))
}

fn begin<W: Write>(json: &mut JsonWriter<'_, W>, id: u32) -> io::Result<()> {
    json.begin_line()?;
    json.field("type", "Feature")?;
    json.key("properties")?;
    json.begin('{')?;
    json.field("id", &id)
}

/// Writes columns as the properties that the route server knows, and the rest as metadata.
fn write_properties<'v, W: Write>(
    json: &mut JsonWriter<'_, W>,
    kind: Kind,
    (number, id): (u32, &str),
    columns: &[&Attribute],
    value: impl Fn(&str) -> Option<Value<'v>>,
) -> io::Result<()> {
    let mut metadata = Vec::new();
    for name in columns.iter().map(|column| column.name.as_str()) {
        match value(name).and_then(|value| placement(kind, name, value)) {
            Some(Placement::Property(value)) => {
                json.key(name)?;
                json.value(value)?;
            }
            Some(Placement::Metadata(key, value)) => metadata.push((key, value)),
            None => {}
        }
    }
    if number.to_string() != id {
        metadata.push((names::ORIGINAL_ID, Value::Text(id)));
    }
    if metadata.is_empty() {
        return Ok(());
    }
    json.key("metadata")?;
    json.begin('{')?;
    for (key, value) in metadata {
        json.key(key)?;
        match value {
            Value::Json(text) if !is_metadata(text) => json.any(text)?,
            value => json.value(value)?,
        }
    }
    json.end('}')
}

/// Lists the parts of a layout that a route graph does not hold.
fn list_losses(layout: &Layout, ids: &Nav2Ids, tolerance_m: f64) -> Losses {
    let mut losses = common_losses(layout);
    let (paths, nodes) = (&layout.paths, &layout.nodes);
    let has_edge = |row: usize| ids.edges[row].is_some();
    let has_node = |row: usize| ids.nodes[row].is_some();
    let absent = paths.iter().filter(|path| path.runs().len() > 0);
    let absent = absent.filter(|path| !has_edge(path.row())).count();
    let detail = "paths that are no edges: walls, doors, and those without a start or an end node";
    losses.add("paths", absent, detail);
    losses.add_two_way(layout, |path| has_edge(path.row()));
    let curved = paths.iter().filter(|path| has_edge(path.row()));
    let curved = curved
        .filter(|path| !is_of_lines(*path) || paths.written_curve(path.row()).is_some())
        .count();
    let detail = format!(
        "curved paths: written as lines within {tolerance_m} m; Nav2 drives straight from node to \
         node"
    );
    losses.add("curves", curved, detail);
    let absent = ids.nodes.iter().filter(|number| number.is_none()).count();
    losses.add("nodes", absent, "nodes of walls and doors only");
    let detail = "Nav2 has no vehicle types";
    losses.add_types(paths.vehicle_types(), has_edge, ("paths", detail));
    losses.add_types(nodes.vehicle_types(), has_node, ("nodes", detail));
    losses.add_styles(layout, has_edge);
    add_columns(
        &mut losses,
        &paths.attributes,
        (Kind::Edge, "paths"),
        has_edge,
    );
    add_columns(
        &mut losses,
        &nodes.attributes,
        (Kind::Node, "nodes"),
        has_node,
    );
    losses.add_stations(layout);
    losses.add(
        "levels",
        layout.levels.len(),
        "levels: all nodes are on one map",
    );
    losses.add_blocks(layout);
    losses.add_groups(layout);
    let values = layout.attributes.iter().count();
    losses.add("layout properties", values, "properties of the layout");
    losses
}

/// Adds the values of columns that are not written, and those that are written in another type.
fn add_columns(
    losses: &mut Losses,
    attributes: &Attributes,
    (kind, of): (Kind, &str),
    is_written: impl Fn(usize) -> bool,
) {
    losses.add_values(
        attributes,
        &format!("values of {of}"),
        |row, name, value| is_written(row) && placement(kind, name, value).is_none(),
    );
    let detail = format!("values of {of}: written as text, for Nav2 reads plain lists only");
    losses.add_values(attributes, &detail, |row, name, value| {
        let placement = placement(kind, name, value).filter(|_| is_written(row));
        let Some(Placement::Metadata(_, Value::Json(json))) = placement else {
            return false;
        };
        !is_metadata(json)
    });
}
