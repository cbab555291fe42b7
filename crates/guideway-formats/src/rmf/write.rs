//! Open-RMF writer: writes a layout as a navigation graph, as the fleet adapter loads it.
//!
//! Source: `parse_graph` of [`rmf_fleet_adapter`](https://github.com/open-rmf/rmf_ros2), and the
//! graphs that `rmf_building_map_tools` generates.

use std::io::{self, Write};

use guideway_layout::{Attributes, Layout, Member, PathRef, Value};
use guideway_spline::Point;

use super::graph_columns::{graph_of, is_of_lift, node_column, path_column};
use super::graph_losses::list_losses;
use super::graph_plan::{GraphPlan, LevelPlan};
use super::yaml_text::{key, number, quoted, value};
use crate::Losses;
use crate::clamped::rounded;
use crate::finite::check_finite;

/// Writes a layout as a navigation graph of Open-RMF: nodes as vertices, paths with nodes as
/// straight lanes, doors and lifts, in meters. Returns the losses.
///
/// A two-way path is two lanes, a block is a mutex group. Columns are written as parameters, which
/// the fleet adapter ignores where it does not know them.
///
/// # Errors
/// When `out` fails.
pub fn write_navigation_graph(layout: &Layout, out: &mut impl Write) -> io::Result<Losses> {
    check_finite(layout)?;
    let plan = GraphPlan::new(layout);
    let name = layout.attributes.value(0, "name");
    let name = match name {
        Some(Value::Text(name)) => name,
        _ => "building",
    };
    writeln!(out, "building_name: {}", quoted(name))?;
    for attribute in ["crs_name", "offset"] {
        let text = layout.attributes.value(0, attribute).and_then(value);
        if let Some(text) = text {
            writeln!(out, "{attribute}: {text}")?;
        }
    }
    write_doors(out, layout, &plan)?;
    write_levels(out, layout, &plan)?;
    write_lifts(out, layout, &plan)?;
    Ok(list_losses(layout, &plan))
}

fn write_doors(out: &mut impl Write, layout: &Layout, plan: &GraphPlan<'_>) -> io::Result<()> {
    if plan.doors.is_empty() {
        return writeln!(out, "doors: {{}}");
    }
    writeln!(out, "doors:")?;
    for (row, name) in &plan.doors {
        let path = layout.paths.get(*row);
        let Some((start, end)) = path.ends() else {
            continue;
        };
        let [start, end] = [start, end].map(position);
        writeln!(out, "  {}:\n    endpoints: [[{start}], [{end}]]", key(name))?;
        if let Some(level) = path.level() {
            let level = &plan.levels[level as usize].key;
            writeln!(out, "    map: {}", quoted(level))?;
        }
        let skip = |name: &str| matches!(name, "element" | "endpoints" | "map");
        let entries = row_entries(&layout.paths.attributes, *row, skip);
        write_block(out, entries)?;
    }
    Ok(())
}

fn write_levels(out: &mut impl Write, layout: &Layout, plan: &GraphPlan<'_>) -> io::Result<()> {
    writeln!(out, "levels:")?;
    let reverse_ids = plan.reverse_ids(layout);
    for level in &plan.levels {
        writeln!(out, "  {}:", key(&level.key))?;
        if let Some(level) = level.row.map(|row| &layout.levels[row]) {
            if let Some(name) = &level.name {
                writeln!(out, "    name: {}", quoted(name))?;
            }
            if let Some(elevation_m) = level.elevation_m {
                writeln!(out, "    elevation: {}", number(elevation_m))?;
            }
        }
        write_vertices(out, layout, plan, level)?;
        if level.lanes.is_empty() {
            writeln!(out, "    lanes: []")?;
            continue;
        }
        writeln!(out, "    lanes:")?;
        let mut count = 0;
        for &row in &level.lanes {
            let path = layout.paths.get(row);
            let Some([start, end]) = plan.ends(path) else {
                continue;
            };
            let reverse = reverse_ids.get(&row).map(String::as_str);
            let lanes = [(path.id(), [start, end], false)].into_iter();
            let lanes = lanes.chain(reverse.map(|id| (id, [end, start], true)));
            for (id, [start, end], is_reverse) in lanes {
                // The reader gives this identifier to a lane without one.
                let automatic = format!("{}.lanes[{count}]", level.key);
                count += 1;
                let id = (id != automatic).then_some(id);
                let options = lane_options(layout, plan, path, id, is_reverse);
                writeln!(out, "    - [{start}, {end}, {}]", flow(&options))?;
            }
        }
    }
    Ok(())
}

fn write_vertices(
    out: &mut impl Write,
    layout: &Layout,
    plan: &GraphPlan<'_>,
    level: &LevelPlan<'_>,
) -> io::Result<()> {
    if level.vertices.is_empty() {
        return writeln!(out, "    vertices: []");
    }
    writeln!(out, "    vertices:")?;
    for (node, name) in &level.vertices {
        let mut options = vec![("name", quoted(name))];
        for column in layout.nodes.attributes.iter() {
            let of_node = column.values.get(*node as usize);
            options.extend(of_node.and_then(|value| node_column(&column.name, value)));
        }
        if let Some(&block) = plan.mutex_of.get(&Member::Node(*node)) {
            options.push(("mutex", quoted(&layout.blocks[block].id)));
        }
        if let Some(&lift) = plan.lift_of.get(node) {
            options.push(("lift", quoted(&plan.lifts[lift].1)));
        }
        let position = position(layout.nodes.position_m(*node));
        writeln!(out, "    - [{position}, {}]", flow(&options))?;
    }
    Ok(())
}

fn lane_options<'l>(
    layout: &'l Layout,
    plan: &GraphPlan<'_>,
    path: PathRef<'_>,
    id: Option<&str>,
    is_reverse: bool,
) -> Vec<(&'l str, String)> {
    let paths = &layout.paths;
    let mut options = Vec::new();
    options.extend(id.map(|id| ("id", quoted(id))));
    for name in paths.column_names() {
        let of_path = paths.value(path.row(), name);
        let of_path = of_path.map(|value| match (name, value) {
            ("orientation_constraint", value) if is_reverse => reversed(value),
            (_, value) => value,
        });
        options.extend(of_path.and_then(|value| path_column(name, value)));
    }
    if let Some(graph) = graph_of(layout, path.row()) {
        options.push(("graph_idx", graph.to_owned()));
    }
    if let Some(&block) = plan.mutex_of.get(&Member::Path(path.row() as u32)) {
        options.push(("mutex", quoted(&layout.blocks[block].id)));
    }
    options
}

/// The constraint of a lane that is driven against the direction of its path.
fn reversed(constraint: Value<'_>) -> Value<'_> {
    match constraint {
        Value::Text("forward") => Value::Text("backward"),
        Value::Text("backward") => Value::Text("forward"),
        other => other,
    }
}

fn write_lifts(out: &mut impl Write, layout: &Layout, plan: &GraphPlan<'_>) -> io::Result<()> {
    if plan.lifts.is_empty() {
        return writeln!(out, "lifts: {{}}");
    }
    writeln!(out, "lifts:")?;
    for (station, name) in &plan.lifts {
        let row = *station as usize;
        let attributes = &layout.stations.attributes;
        let value = |name| {
            let value = attributes.value(row, name).and_then(Value::number);
            value.unwrap_or(0.0)
        };
        let position = position(layout.stations.position_m(*station).unwrap_or_default());
        let [yaw, width, depth] = ["theta", "width", "depth"].map(|name| number(value(name)));
        writeln!(out, "  {}:", key(name))?;
        writeln!(out, "    position: [{position}, {yaw}]")?;
        writeln!(out, "    dims: [{width}, {depth}]")?;
        write_block(out, row_entries(attributes, row, is_of_lift))?;
    }
    Ok(())
}

fn row_entries(
    attributes: &Attributes,
    row: usize,
    skip: impl Fn(&str) -> bool,
) -> Vec<(&str, String)> {
    let columns = attributes.iter().filter(|column| !skip(&column.name));
    let entries = columns.filter_map(|column| {
        let text = value(column.values.get(row)?)?;
        Some((column.name.as_str(), text))
    });
    entries.collect()
}

/// Writes entries of an object of the second level.
fn write_block(out: &mut impl Write, entries: Vec<(&str, String)>) -> io::Result<()> {
    for (name, value) in entries {
        writeln!(out, "    {}: {value}", key(name))?;
    }
    Ok(())
}

/// Returns an object in flow style.
fn flow(entries: &[(&str, String)]) -> String {
    let entries = entries.iter();
    let entries = entries.map(|(name, value)| format!("{}: {value}", key(name)));
    format!("{{{}}}", entries.collect::<Vec<_>>().join(", "))
}

/// Returns the coordinates of a position.
fn position(position_m: Point<f64>) -> String {
    let [x, y] = [position_m.x, position_m.y].map(|meters| number(rounded(meters)));
    format!("{x}, {y}")
}
