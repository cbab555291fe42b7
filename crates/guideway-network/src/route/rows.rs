//! [`Route`]: the rows of a route, its sums, and its layout.

use std::collections::HashMap;

use guideway_layout::{
    Direction, Geometry, Layout, Provenance, WrittenCurve, WrittenCurves, element_name,
};
use guideway_spline::Runs;

use super::router::Router;
use super::search::Found;
use super::{Place, RouteError};

/// One path of a route.
#[derive(Clone, Debug, PartialEq)]
pub struct RouteRow {
    /// Row of the path.
    pub path: u32,
    /// The vehicle drives from the end of the path to its start.
    pub is_backward: bool,
    /// Row of the node where the vehicle enters.
    pub from: u32,
    /// Row of the node where the vehicle leaves.
    pub to: u32,
    /// Turn in place before the path, in radians.
    pub turn_rad: f64,
    /// Time of that turn.
    pub turn_s: f64,
    /// Length of the path.
    pub length_m: f64,
    /// Permitted speed.
    pub speed_m_s: f64,
    /// Time along the path.
    pub drive_s: f64,
    /// Time from the start of the route to the end of the path.
    pub end_s: f64,
}

/// A way from one place to another one.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Route {
    /// Its paths in order; empty when start and goal are one place.
    pub rows: Vec<RouteRow>,
    /// Length of all paths.
    pub length_m: f64,
    /// Time of all paths and turns.
    pub time_s: f64,
    /// Turns that the search compared, a measure of its work.
    pub turns_compared: u64,
}

impl Router<'_> {
    /// The rows of a way.
    pub(super) fn rows(&self, found: &Found) -> Route {
        let mut route = Route {
            turns_compared: found.turns,
            ..Route::default()
        };
        let mut before = None;
        for &row in &found.arcs {
            let (arc, cost) = (self.arcs.get(row), &self.costs.of_arc[row as usize]);
            let turn = before.and_then(|before| self.costs.turn(before, row));
            let (turn_rad, turn_s) = turn.unwrap_or_default();
            before = Some(row);
            route.length_m += cost.length_m;
            route.time_s += turn_s + cost.drive_s;
            route.rows.push(RouteRow {
                path: arc.path,
                is_backward: arc.is_backward,
                from: arc.from,
                to: arc.to,
                turn_rad,
                turn_s,
                length_m: cost.length_m,
                speed_m_s: cost.speed_m_s,
                drive_s: cost.drive_s,
                end_s: route.time_s,
            });
        }
        route
    }

    /// The error of a search that reached some nodes. `detour` is a way that ignores rotation
    /// rules.
    pub(super) fn no_way(
        &self,
        from: &Place,
        to: &Place,
        reached: u32,
        detour: Option<&[u32]>,
    ) -> RouteError {
        let forbidden = detour.and_then(|detour| {
            let mut pairs = detour.windows(2);
            pairs.find(|pair| self.costs.turn(pair[0], pair[1]).is_none())
        });
        let why = match forbidden {
            Some(pair) => {
                let node = self.arcs.get(pair[0]).to;
                let node = element_name("node", node as usize, self.layout.nodes.id(node));
                format!("rotation is forbidden at {node}")
            }
            None => {
                let of = self
                    .vehicle_type
                    .map_or(String::new(), |t| format!(" of type \"{t}\""));
                let is_away = |place: &&Place| !place.nodes.iter().any(|&n| self.arcs.has(n));
                match [from, to].into_iter().find(is_away) {
                    Some(place) => format!("no path of vehicles{of} is at \"{}\"", place.name),
                    None => {
                        let nodes = (0..self.arcs.node_count()).filter(|&n| self.arcs.has(n));
                        let all = nodes.count();
                        format!("vehicles{of} reach {reached} of {all} nodes from there")
                    }
                }
            }
        };
        RouteError::NoWay {
            from: from.name.clone(),
            to: to.name.clone(),
            why,
        }
    }
}

impl Route {
    /// The paths and nodes of the route in order, each path directed as it is driven.
    ///
    /// # Panics
    /// When `layout` is not the one of the router.
    pub fn layout(&self, layout: &Layout) -> Layout {
        let mut route = Layout {
            provenance: Provenance {
                source: layout.provenance.source.clone(),
                format: "route".to_owned(),
                ..Provenance::default()
            },
            levels: layout.levels.clone(),
            vehicle_types: layout.vehicle_types.clone(),
            geo_origin: layout.geo_origin,
            ..Layout::default()
        };
        let mut nodes: Vec<usize> = self.rows.iter().map(|row| row.from as usize).collect();
        nodes.extend(self.rows.last().map(|row| row.to as usize));
        let mut first = HashMap::new();
        nodes.retain(|&node| {
            let next = first.len() as u32;
            let is_new = !first.contains_key(&(node as u32));
            first.entry(node as u32).or_insert(next);
            is_new
        });
        route.nodes = layout.nodes.select(&nodes);
        let rows: Vec<usize> = self.rows.iter().map(|row| row.path as usize).collect();
        let selected = layout.paths.select(&rows, |node| first.get(&node).copied());
        route.paths = selected;
        for (path, row) in self.rows.iter().enumerate() {
            route.paths.set_direction(path, Direction::Forward);
            if row.is_backward {
                turn_around(&mut route, path, &first, row);
            }
        }
        let stations = 0..layout.stations.len();
        let is_on = |&station: &usize| {
            let nodes = layout.stations.nodes(station as u32);
            nodes.iter().any(|node| first.contains_key(node))
        };
        let stations: Vec<usize> = stations.filter(is_on).collect();
        route.stations = layout
            .stations
            .select(&stations, |node| first.get(&node).copied());
        route
    }
}

/// Directs a path from its end to its start.
fn turn_around(route: &mut Layout, path: usize, nodes: &HashMap<u32, u32>, row: &RouteRow) {
    let mut runs = Runs::default();
    route.paths.get(path).copy_runs(&mut runs);
    let mut geometry = Geometry::default();
    geometry.push(&runs.reversed());
    let mut written = WrittenCurves::default();
    let curve = route.paths.written_curve(path).map(WrittenCurve::reversed);
    written.set(0, curve.map(Into::into));
    let paths = &mut route.paths;
    paths.replace_curves(&[path as u32], &geometry, &written);
    let node = |row: u32| nodes.get(&row).copied();
    route.paths.set_nodes(path, node(row.from), node(row.to));
}
