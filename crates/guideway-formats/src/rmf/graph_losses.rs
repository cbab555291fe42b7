//! Losses of navigation graphs: lists the parts of a layout that a graph does not hold.

use guideway_layout::{Direction, Layout, Member, PathRef};
use guideway_spline::Point;

use super::graph_columns::{graph_of, is_of_lift, node_column, parameter, path_column};
use super::graph_plan::{GraphPlan, PathKind, is_lift};
use crate::Losses;
use crate::losses::common_losses;

/// Largest distance of a path from the straight line between its nodes, in meters.
const STRAIGHT_M: f64 = 1e-5;

/// Lists the parts of a layout that a navigation graph does not hold.
pub(super) fn list_losses(layout: &Layout, plan: &GraphPlan<'_>) -> Losses {
    let mut losses = common_losses(layout);
    let (paths, nodes) = (&layout.paths, &layout.nodes);
    let kind = |path: &PathRef<'_>| plan.kinds[path.row()];
    let absent = paths.iter().filter(|path| path.runs().len() > 0);
    let absent = absent.filter(|path| kind(path) == PathKind::Absent).count();
    let detail = "paths that are no lanes: walls, lanes of humans, and paths without two nodes on \
                  one level";
    losses.add("paths", absent, detail);
    losses.add_two_way(layout, |path| kind(path) == PathKind::Lane);
    let one_way = paths.iter().filter(|path| kind(path) == PathKind::Door);
    let one_way = one_way.filter(|path| path.direction() == Direction::Forward);
    losses.add("directions", one_way.count(), "doors: open both ways");
    let curved = paths.iter().filter(|path| is_bent(layout, plan, *path));
    let detail = "curved paths: written as straight lanes from node to node";
    losses.add("curves", curved.count(), detail);
    let of_doors = paths.iter().filter(|path| kind(path) == PathKind::Door);
    let of_doors = of_doors.filter(|path| path.start_node().or(path.end_node()).is_some());
    losses.add("ends", of_doors.count(), "doors: their nodes");
    let unwritten = plan.vertices.iter().filter(|vertex| vertex.is_none());
    let detail = "nodes of walls and doors only";
    losses.add("nodes", unwritten.count(), detail);
    add_renamed(&mut losses, layout, plan);
    add_levels(&mut losses, layout, plan);
    let detail = "a navigation graph is for one fleet";
    let is_limited = |row: usize| match plan.kinds[row] {
        PathKind::Lane => graph_of(layout, row).is_none(),
        PathKind::Door => true,
        PathKind::Absent => false,
    };
    losses.add_types(paths.vehicle_types(), is_limited, ("paths", detail));
    let has_vertex = |row: usize| plan.vertices[row].is_some();
    losses.add_types(nodes.vehicle_types(), has_vertex, ("nodes", detail));
    losses.add_styles(layout, |row| plan.kinds[row] != PathKind::Absent);
    losses.add_values(
        &paths.attributes,
        "values of paths",
        |row, name, value| match plan.kinds[row] {
            PathKind::Lane => path_column(name, value).is_none(),
            PathKind::Door => name != "element" && parameter(name, value).is_none(),
            PathKind::Absent => false,
        },
    );
    losses.add_values(&nodes.attributes, "values of nodes", |row, name, value| {
        plan.vertices[row].is_some() && node_column(name, value).is_none()
    });
    let stations = &layout.stations;
    let others = (0..stations.len() as u32).filter(|&row| !is_lift(layout, row));
    losses.add("stations", others.count(), "stations other than lifts");
    losses.add_values(
        &stations.attributes,
        "values of lifts",
        |row, name, value| {
            is_lift(layout, row as u32) && !is_of_lift(name) && parameter(name, value).is_none()
        },
    );
    add_blocks(&mut losses, layout, plan);
    losses.add_groups(layout);
    let of_layout = layout.attributes.iter();
    let of_layout = of_layout
        .filter(|column| !is_of_graph(&column.name))
        .count();
    losses.add("layout properties", of_layout, "properties of the layout");
    losses
}

fn is_of_graph(name: &str) -> bool {
    matches!(name, "name" | "crs_name" | "offset")
}

/// Adds elements that were renamed. They count as others, unless no identifier of their table is
/// kept.
fn add_renamed(losses: &mut Losses, layout: &Layout, plan: &GraphPlan<'_>) {
    let renamed = &plan.renamed;
    for (what, count, all) in [
        ("levels", renamed.levels, usize::MAX),
        ("nodes", renamed.nodes, layout.nodes.len()),
        ("paths", renamed.doors, usize::MAX),
        ("stations", renamed.lifts, layout.stations.len()),
    ] {
        let what = if count == all { "identifiers" } else { what };
        losses.add(
            what,
            count,
            "elements with a repeated or empty name: renamed",
        );
    }
}

fn add_levels(losses: &mut Losses, layout: &Layout, plan: &GraphPlan<'_>) {
    let detail = "nodes without a level: written on the first one";
    losses.add("levels", plan.without_level, detail);
    let moved = layout.paths.iter().filter(|path| {
        let node = path
            .start_node()
            .filter(|_| plan.kinds[path.row()] == PathKind::Lane);
        node.is_some_and(|node| {
            layout.nodes.level(node).is_none() || path.level() != layout.nodes.level(node)
        })
    });
    losses.add(
        "levels",
        moved.count(),
        "lanes: on the level of their nodes",
    );
    let of_lifts = plan
        .lifts
        .iter()
        .filter(|(row, _)| layout.stations.level(*row).is_some());
    losses.add("levels", of_lifts.count(), "lifts: their level");
    for level in &layout.levels {
        losses.add_columns(&level.attributes, "levels", |_| false);
    }
}

/// Adds blocks that a mutex does not hold as they are: an element has one mutex, and the lane
/// against the direction of a path is in that of its path.
fn add_blocks(losses: &mut Losses, layout: &Layout, plan: &GraphPlan<'_>) {
    let is_held = |row: usize, member: &Member| {
        let is_written = match member {
            Member::Path(path) => {
                let path = layout.paths.get(*path as usize);
                let is_one_way = path.direction() == Direction::Forward;
                plan.kinds[path.row()] == PathKind::Lane && is_one_way
            }
            Member::Node(node) => plan.vertices[*node as usize].is_some(),
            Member::Station(_) => false,
        };
        is_written && plan.mutex_of.get(member) == Some(&row)
    };
    let changed = layout.blocks.iter().enumerate().filter(|(row, block)| {
        block.members.is_empty() || !block.members.iter().all(|m| is_held(*row, m))
    });
    let detail = "blocks: members that no mutex group holds";
    losses.add("blocks", changed.count(), detail);
    let blocks = layout.blocks.iter().enumerate();
    for (_, block) in blocks.filter(|(row, block)| {
        let mut members = block.members.iter();
        members.any(|member| plan.mutex_of.get(member) == Some(row))
    }) {
        losses.add_columns(&block.attributes, "blocks", |_| false);
    }
}

/// Returns whether a path that is written is not the straight line between its nodes.
fn is_bent(layout: &Layout, plan: &GraphPlan<'_>, path: PathRef<'_>) -> bool {
    let ends = match plan.kinds[path.row()] {
        PathKind::Lane => {
            let node = |node: Option<u32>| node.map(|node| layout.nodes.position_m(node));
            node(path.start_node()).zip(node(path.end_node()))
        }
        PathKind::Door => path.ends(),
        PathKind::Absent => return false,
    };
    let Some((start, end)) = ends else {
        return false;
    };
    let is_at = |(a, b): (Point<f64>, Point<f64>)| {
        a.distance(start) <= STRAIGHT_M && b.distance(end) <= STRAIGHT_M
    };
    layout.paths.written_curve(path.row()).is_some()
        || !path.ends().is_some_and(is_at)
        || !is_straight(path, start, end)
}

/// Returns whether all of a path lies on a line.
fn is_straight(path: PathRef<'_>, start: Point<f64>, end: Point<f64>) -> bool {
    let length = start.distance(end);
    let is_on = |p: Point<f64>| {
        if length <= STRAIGHT_M {
            return p.distance(start) <= STRAIGHT_M;
        }
        let along = (p - start).dot(end - start) / length;
        let aside = (p - start).cross(end - start).abs() / length;
        aside <= STRAIGHT_M && along >= -STRAIGHT_M && along <= length + STRAIGHT_M
    };
    let segments = path.runs().flat_map(|run| run.segments());
    let beziers = segments.map(|segment| guideway_spline::uniform::to_bezier(&segment));
    let mut points = beziers.flatten();
    points.all(is_on)
}
