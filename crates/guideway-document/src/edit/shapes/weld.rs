//! Welds: one node of nodes and ends of paths that lie within a distance.

use std::collections::{BTreeMap, BTreeSet, HashMap};

use guideway_layout::Member;
use guideway_scene::Table;
use guideway_spline::Point;
use guideway_spline::bezier::SAME_M;

use super::error::ShapeError;
use super::plan::Plan;
use crate::PathSet;
use crate::document::Document;
use crate::edit::curves::{runs_of, with_moved_ends};
use crate::edit::lengths::length_m;

/// The numbers of elements that a weld changed.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Welded {
    /// Nodes that went.
    pub nodes: usize,
    /// Ends of paths without a node that got one.
    pub ends: usize,
    /// Paths that went, because the weld left them no length.
    pub paths: usize,
    /// Values that went with their nodes, by property: the nodes that stay have others, or none.
    pub values: BTreeMap<String, usize>,
}

/// A node, or the end of a path without one: row and side of the path.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Spot {
    Node(u32),
    End(u32, usize),
}

impl Document {
    /// Welds the nodes of the paths, and their ends without a node, that lie within
    /// `tolerance_m` of each other. The node of the lowest row stays where it is, with its name and
    /// properties; paths, stations and blocks of the others come to it. Ends without any node near
    /// get a new one in common.
    ///
    /// # Errors
    /// When no path is given, the tolerance is not positive, elements of different levels lie
    /// within it, or as for other edits.
    pub fn weld(&mut self, paths: &PathSet, tolerance_m: f64) -> Result<Welded, ShapeError> {
        if !tolerance_m.is_finite() || tolerance_m <= 0.0 {
            let (name, value) = ("tolerance", tolerance_m);
            return Err(ShapeError::Length { name, value });
        }
        self.check_paths(paths)?;
        let groups = self.groups(paths, tolerance_m)?;
        let (changes, welded) = self.welded(&groups, tolerance_m);
        self.perform("weld", changes)?;
        Ok(welded)
    }

    /// Nodes and ends that become one each, the one that stays first.
    fn groups(&self, paths: &PathSet, tolerance_m: f64) -> Result<Vec<Vec<Spot>>, ShapeError> {
        let mut spots: BTreeSet<Spot> = BTreeSet::new();
        for row in paths {
            let path = self.layout().paths.get(row as usize);
            for (side, node) in [path.start_node(), path.end_node()].into_iter().enumerate() {
                spots.insert(node.map_or(Spot::End(row, side), Spot::Node));
            }
        }
        // Cells of rounding errors would be no cells.
        let size_m = tolerance_m.max(SAME_M);
        let cell = |p: Point<f64>| [p.x, p.y].map(|v| (v / size_m).floor() as i64);
        let mut kept: HashMap<[i64; 2], Vec<usize>> = HashMap::new();
        let mut groups: Vec<Vec<Spot>> = Vec::new();
        for spot in spots {
            let Some(at_m) = self.spot_m(spot) else {
                continue;
            };
            let [x, y] = cell(at_m);
            let cells = (x - 1..=x + 1).flat_map(|x| (y - 1..=y + 1).map(move |y| [x, y]));
            let near = cells.filter_map(|cell| kept.get(&cell)).flatten();
            let distance_m = |group: &usize| {
                let keeper_m = self.spot_m(groups[*group][0])?;
                let distance_m = keeper_m.distance(at_m);
                (distance_m <= tolerance_m).then_some((distance_m, *group))
            };
            let nearest = near.filter_map(distance_m);
            match nearest.min_by(|a, b| a.0.total_cmp(&b.0)) {
                Some((_, group)) => {
                    self.check_levels(groups[group][0], spot)?;
                    groups[group].push(spot);
                }
                None => {
                    kept.entry([x, y]).or_default().push(groups.len());
                    groups.push(vec![spot]);
                }
            }
        }
        groups.retain(|group| group.len() > 1);
        Ok(groups)
    }

    fn welded(&self, groups: &[Vec<Spot>], tolerance_m: f64) -> (Vec<crate::Change>, Welded) {
        let mut plan = Plan::new(self);
        let mut welded = Welded::default();
        let mut node_of: BTreeMap<Spot, u32> = BTreeMap::new();
        for group in groups {
            let keeper = match group[0] {
                Spot::Node(node) => node,
                Spot::End(path, _) => {
                    plan.add_node(path, self.spot_m(group[0]).unwrap_or_default())
                }
            };
            node_of.extend(group.iter().map(|spot| (*spot, keeper)));
        }
        let mut paths: BTreeSet<u32> = BTreeSet::new();
        let mut stations: BTreeSet<u32> = BTreeSet::new();
        for (spot, keeper) in &node_of {
            match spot {
                Spot::End(path, _) => {
                    welded.ends += 1;
                    paths.insert(*path);
                }
                Spot::Node(node) if node != keeper => {
                    welded.nodes += 1;
                    paths.extend(self.existing_paths_at(*node));
                    stations.extend(self.index.stations_at(*node));
                    self.count_values(*node, *keeper, &mut welded.values);
                    plan.replace_member(Member::Node(*node), vec![Member::Node(*keeper)]);
                    plan.remove_node(*node);
                }
                Spot::Node(_) => {}
            }
        }
        let after = |spot: Spot| node_of.get(&spot).copied();
        for row in paths {
            let path = self.layout().paths.get(row as usize);
            let before = [path.start_node(), path.end_node()];
            let spots = [0, 1].map(|side| before[side].map_or(Spot::End(row, side), Spot::Node));
            let ends = [0, 1].map(|side| after(spots[side]).or(before[side]));
            let by = [0, 1].map(|side| match (ends[side], self.spot_m(spots[side])) {
                (Some(node), Some(from)) => plan.node_position_m(node) - from,
                _ => Point::new(0.0, 0.0),
            });
            let runs = runs_of(path);
            let is_new_loop = ends[0] == ends[1] && (before[0] != before[1] || before[0].is_none());
            if is_new_loop && length_m(&runs) <= 2.0 * tolerance_m {
                welded.paths += 1;
                plan.remove_path(row);
                continue;
            }
            plan.set_ends(row, ends);
            plan.set_curve(row, with_moved_ends(&runs, by[0], by[1]));
        }
        for station in stations {
            let nodes = self.layout().stations.nodes(station).iter();
            let mut known = BTreeSet::new();
            let nodes = nodes.map(|&node| after(Spot::Node(node)).unwrap_or(node));
            let nodes: Box<[u32]> = nodes.filter(|node| known.insert(*node)).collect();
            plan.set_station_nodes(station, nodes);
        }
        (plan.changes(), welded)
    }

    /// Counts the values of a node that goes which the node that stays does not have. A node that
    /// the weld makes has none.
    fn count_values(&self, node: u32, keeper: u32, values: &mut BTreeMap<String, usize>) {
        let nodes = &self.layout().nodes;
        for column in nodes.attributes.iter() {
            let value = column.values.get(node as usize);
            if value.is_some() && value != column.values.get(keeper as usize) {
                *values.entry(column.name.clone()).or_default() += 1;
            }
        }
        let types = nodes.vehicle_types();
        for column in types.attributes.iter() {
            let entries = types.entries(node as usize);
            let count = entries.filter(|&entry| column.values.get(entry).is_some());
            let count = count.count();
            if count > 0 {
                *values.entry(column.name.clone()).or_default() += count;
            }
        }
    }

    /// Position of a node or an end, in meters; `None` for a path without a curve.
    fn spot_m(&self, spot: Spot) -> Option<Point<f64>> {
        match spot {
            Spot::Node(node) => Some(self.node_position_m(node)),
            Spot::End(path, side) => {
                let (start, end) = self.layout().paths.get(path as usize).ends()?;
                Some([start, end][side])
            }
        }
    }

    fn check_levels(&self, first: Spot, second: Spot) -> Result<(), ShapeError> {
        let layout = self.layout();
        let level_and_name = |spot: Spot| {
            let (of, row) = match spot {
                Spot::Node(node) => (Table::Nodes, node),
                Spot::End(path, _) => (Table::Paths, path),
            };
            (of.level(layout, row), of.id(layout, row).to_owned())
        };
        let [(level, first), (other, second)] = [first, second].map(level_and_name);
        if level == other {
            return Ok(());
        }
        Err(ShapeError::Levels { first, second })
    }
}
