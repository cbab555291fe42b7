//! Joins: one path in place of the two at a node.

use std::sync::Arc;

use guideway_layout::{Attributes, Direction, Member};
use guideway_scene::Table;
use guideway_spline::construct;

use super::error::ShapeError;
use super::plan::Plan;
use crate::PathSet;
use crate::document::Document;
use crate::edit::curves::runs_of;
use crate::edit::lengths::{LENGTH, stated_lengths_m};
use crate::elements::Elements;

/// Largest gap between two paths at one node, in meters. Files round positions to a millimeter, and
/// curves may end that far from their node.
const LARGEST_GAP_M: f64 = 0.01;

/// Properties that depend on the direction of a path.
const ONE_SIDED: [&str; 7] = [
    "maxReverseSpeed",
    "vehicleOrientation",
    "vehicleOrientations",
    "rotationAtStartNodeAllowed",
    "rotationAtEndNodeAllowed",
    "corridor.leftWidth",
    "corridor.rightWidth",
];

impl Document {
    /// Joins the two paths at a node, which goes. The first one stays, with the curve of both;
    /// pieces named `id.1` and `id.2` become `id` again. Selects the path and returns its row.
    ///
    /// A two-way path may be turned around for it, unless it has a property with a direction, such
    /// as
    /// `maxReverseSpeed`.
    ///
    /// # Errors
    /// When not exactly two paths meet at the node, they differ in a property, lead both to the
    /// node or both from it, the second one leads back to where the first one begins, a station is
    /// at the node, or as for other edits.
    pub fn join_at(&mut self, node: u32) -> Result<u32, ShapeError> {
        let [first, second] = self.two_paths_at(node)?;
        self.refuse_station_at(node)?;
        let name = |path: u32| self.layout().paths.id(path as usize).to_owned();
        let leads_to = |path: u32| self.layout().paths.get(path as usize).end_node() == Some(node);
        // The path that leads to the node comes first.
        let [first, second] = if leads_to(first) {
            [first, second]
        } else {
            [second, first]
        };
        let turns = [!leads_to(first), leads_to(second)];
        let mut what = self.different_properties(first, second);
        let is_two_way = self.layout().paths.get(first as usize).direction() == Direction::Both;
        if is_two_way {
            let turned = [first, second]
                .into_iter()
                .zip(turns)
                .filter(|(_, turns)| *turns);
            what.extend(turned.flat_map(|(path, _)| self.one_sided_properties(path)));
        }
        let (first_name, second_name) = (name(first), name(second));
        if !what.is_empty() {
            return Err(ShapeError::Differ {
                first: first_name,
                second: second_name,
                what,
            });
        }
        if turns != [false, false] && !is_two_way {
            return Err(ShapeError::HeadToHead {
                first: first_name,
                second: second_name,
                node: self.layout().nodes.id(node).to_owned(),
            });
        }
        let changes = self.joined([first, second], turns, node)?;
        self.perform("join", changes)?;
        self.selection = Arc::new(Elements::of_paths([first]));
        Ok(first)
    }

    fn joined(
        &self,
        [first, second]: [u32; 2],
        turns: [bool; 2],
        node: u32,
    ) -> Result<Vec<crate::Change>, ShapeError> {
        let mut plan = Plan::new(self);
        let curve = |path: u32, turns: bool| {
            let runs = runs_of(self.layout().paths.get(path as usize));
            if turns { runs.reversed() } else { runs }
        };
        let far_end = |path: u32, at_end: bool| plan.ends_of(path)[usize::from(at_end)];
        let ends = [far_end(first, turns[0]), far_end(second, !turns[1])];
        if ends[0] == ends[1] && ends[0].is_some() {
            let path = self.layout().paths.id(second as usize).to_owned();
            return Err(ShapeError::TurnsBack { path });
        }
        let (before, after) = (curve(first, turns[0]), curve(second, turns[1]));
        let joined = construct::join(&before, &after, LARGEST_GAP_M);
        let joined = joined.map_err(|reason| ShapeError::Curve {
            path: self.layout().paths.id(first as usize).to_owned(),
            reason,
        })?;
        let [of_first, of_second] = [first, second].map(|path| stated_lengths_m(self, path));
        for (vehicle_type, a) in of_first {
            let other = of_second.iter().find(|(other, _)| *other == vehicle_type);
            if let Some((_, b)) = other {
                plan.set_length_m(first, vehicle_type, a + b);
            }
        }
        plan.set_curve(first, joined);
        plan.set_ends(first, ends);
        let names = [first, second].map(|path| self.layout().paths.id(path as usize));
        if let Some(whole) = common_name(names).filter(|whole| !plan.path_names.is_taken(whole)) {
            plan.set_id(first, whole.to_owned());
        }
        plan.replace_member(Member::Path(second), vec![Member::Path(first)]);
        plan.remove_path(second);
        plan.remove_node(node);
        Ok(plan.changes())
    }

    /// The two paths at a node.
    pub(super) fn two_paths_at(&self, node: u32) -> Result<[u32; 2], ShapeError> {
        self.check_node(node)?;
        let paths: Vec<u32> = self.existing_paths_at(node).collect();
        let &[first, second] = paths.as_slice() else {
            return Err(ShapeError::NotTwo {
                node: self.layout().nodes.id(node).to_owned(),
                count: paths.len(),
            });
        };
        let is_loop = |path: &u32| {
            let path = self.layout().paths.get(*path as usize);
            path.start_node() == path.end_node()
        };
        match [first, second].into_iter().find(is_loop) {
            Some(path) => Err(ShapeError::Loop {
                path: self.layout().paths.id(path as usize).to_owned(),
            }),
            None => Ok([first, second]),
        }
    }

    /// Refuses no paths, and paths that do not exist.
    pub(super) fn check_paths(&self, paths: &PathSet) -> Result<(), ShapeError> {
        if paths.is_empty() {
            return Err(ShapeError::NoPath);
        }
        Ok(self.check_rows_exist(Table::Paths, paths)?)
    }

    /// Refuses nodes that do not exist.
    pub(super) fn check_node(&self, node: u32) -> Result<(), ShapeError> {
        Ok(self.check_rows_exist(Table::Nodes, &PathSet::from_iter([node]))?)
    }

    /// Refuses a node that serves a station.
    pub(super) fn refuse_station_at(&self, node: u32) -> Result<(), ShapeError> {
        let mut stations = self.index.stations_at(node);
        let station = stations.find(|&station| self.scene.exists(Table::Stations, station));
        match station {
            Some(station) => Err(ShapeError::Station {
                station: self.layout().stations.id(station).to_owned(),
                node: self.layout().nodes.id(node).to_owned(),
            }),
            None => Ok(()),
        }
    }

    /// The properties of a path that would mean something else if it were turned around.
    fn one_sided_properties(&self, path: u32) -> Vec<String> {
        let paths = &self.layout().paths;
        let is_set = |name: &&str| paths.value(path as usize, name).is_some();
        let names = ONE_SIDED.into_iter().filter(is_set);
        names
            .map(|name| format!("{name}, which has a direction"))
            .collect()
    }

    /// Names of the properties in which two paths differ.
    fn different_properties(&self, first: u32, second: u32) -> Vec<String> {
        let (first, second) = (first as usize, second as usize);
        let paths = &self.layout().paths;
        let (a, b) = (paths.get(first), paths.get(second));
        let entries = paths.vehicle_types();
        let types = |row: usize| -> Vec<&str> {
            let mut types: Vec<&str> = entries.of(row).collect();
            types.sort_unstable();
            types
        };
        let mut what = Vec::new();
        let mut add = |differs: bool, name: &str| {
            if differs {
                what.push(name.to_owned());
            }
        };
        add(a.direction() != b.direction(), "direction");
        add(a.level() != b.level(), "level");
        add(
            paths.own_style(first) != paths.own_style(second),
            "color or width",
        );
        add(types(first) != types(second), "vehicle types");
        for name in different_columns(&paths.attributes, first, second) {
            // The length of the whole is that of both.
            add(name != LENGTH, name);
        }
        for vehicle_type in entries.of(first) {
            let of = |row: usize| entries.entry_for(row, vehicle_type);
            if let (Some(a), Some(b)) = (of(first), of(second)) {
                for name in different_columns(&entries.attributes, a, b) {
                    add(name != LENGTH, &format!("{name} ({vehicle_type})"));
                }
            }
        }
        what
    }
}

/// Names of the columns in which two rows differ.
fn different_columns(
    columns: &Attributes,
    first: usize,
    second: usize,
) -> impl Iterator<Item = &str> {
    let differs = move |column: &&guideway_layout::Attribute| {
        column.values.get(first) != column.values.get(second)
    };
    columns
        .iter()
        .filter(differs)
        .map(|column| column.name.as_str())
}

/// The name whose numbered pieces two names are.
fn common_name([first, second]: [&str; 2]) -> Option<&str> {
    let whole = |id: &'_ str| -> Option<usize> {
        let dot = id.rfind('.')?;
        let number = &id[dot + 1..];
        let is_number = !number.is_empty() && number.bytes().all(|b| b.is_ascii_digit());
        (is_number && dot > 0).then_some(dot)
    };
    let (a, b) = (&first[..whole(first)?], &second[..whole(second)?]);
    (a == b).then_some(a)
}
