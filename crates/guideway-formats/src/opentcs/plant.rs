//! Completes a layout to a plant of openTCS: unique names, and points at both ends of every path.

use std::borrow::Cow;
use std::collections::{HashMap, HashSet};

use guideway_layout::Layout;
use guideway_spline::Point;
use serde_json::{Map, Value as Json};

use super::group_mapper::{LOCATION_TYPES, VEHICLES};
use crate::Losses;
use crate::end_nodes::EndNodes;
use crate::unique_names::UniqueNames;
use crate::xml_text::is_xml_char;

/// Name of the location type of stations without a kind.
const DEFAULT_KIND: &str = "Station";

/// A point as written.
pub(super) struct PlantPoint<'a> {
    pub(super) name: Cow<'a, str>,
    /// Position in whole millimeters.
    pub(super) position_mm: [i64; 2],
    /// Path that a new point was made for.
    pub(super) path: Option<usize>,
}

/// Points, path ends and names as written. Names are unique in the whole plant, as openTCS
/// requires.
pub(super) struct Plant<'a> {
    /// The nodes of the layout, then new points.
    pub(super) points: Vec<PlantPoint<'a>>,
    /// Start and end point per path; `None` for a path without a curve, which is not written.
    pub(super) ends: Vec<Option<[u32; 2]>>,
    pub(super) path_names: Vec<Cow<'a, str>>,
    are_paths_renamed: bool,
    pub(super) station_names: Vec<Cow<'a, str>>,
    pub(super) block_names: Vec<Cow<'a, str>>,
    /// Location types, as objects.
    pub(super) types: Vec<Map<String, Json>>,
    /// Name of the type per kind.
    type_names: HashMap<&'a str, String>,
    /// Name of the type of stations without a kind.
    default_kind: String,
    /// Vehicles, as objects.
    pub(super) vehicles: Vec<Map<String, Json>>,
}

impl<'a> Plant<'a> {
    /// Completes a layout; adds each change to the losses.
    pub(super) fn complete(layout: &'a Layout, losses: &mut Losses) -> Self {
        let (nodes, paths) = (&layout.nodes, &layout.paths);
        let stations = 0..layout.stations.len() as u32;
        let kinds = kinds(layout);
        let objects = [VEHICLES, LOCATION_TYPES].map(|name| objects(layout, name));
        let [vehicles, type_objects] = objects;
        let node_ids = (0..nodes.len() as u32).map(|row| nodes.id(row));
        let path_ids = (0..paths.len()).map(|row| paths.id(row));
        let station_ids = stations.map(|row| layout.stations.id(row));
        let block_ids = layout.blocks.iter().map(|block| block.id.as_str());
        let all = node_ids.clone().chain(path_ids.clone());
        let all = all.chain(station_ids.clone()).chain(block_ids.clone());
        let mut names = UniqueNames::new(all.chain(kinds.iter().flatten().copied()));
        let node_names = take_names("nodes", node_ids, &mut names, losses);
        let path_names = take_names("paths", path_ids, &mut names, losses);
        let station_names = take_names("stations", station_ids, &mut names, losses);
        let block_names = take_names("blocks", block_ids, &mut names, losses);
        let renamed_nodes = (0..nodes.len() as u32).zip(&node_names);
        let renamed_nodes = renamed_nodes.filter(|(row, name)| **name != nodes.id(*row));
        let renamed_nodes: HashSet<u32> = renamed_nodes.map(|(row, _)| row).collect();
        let points = node_names
            .into_iter()
            .zip(0..)
            .map(|(name, node)| PlantPoint {
                name,
                position_mm: to_mm(nodes.position_m(node)),
                path: None,
            });
        let mut plant = Self {
            points: points.collect(),
            ends: vec![None; paths.len()],
            are_paths_renamed: (0..)
                .zip(&path_names)
                .all(|(row, name)| *name != paths.id(row)),
            path_names,
            station_names,
            block_names,
            types: Vec::new(),
            type_names: HashMap::new(),
            default_kind: String::new(),
            vehicles: Vec::new(),
        };
        plant.add_types(&kinds, type_objects, &mut names, losses);
        let mut renamed = 0;
        for mut vehicle in vehicles {
            let name = vehicle
                .get("name")
                .and_then(Json::as_str)
                .unwrap_or("Vehicle");
            let unique = names.make_unique(name);
            renamed += usize::from(unique != name);
            vehicle.insert("name".into(), unique.into());
            plant.vehicles.push(vehicle);
        }
        losses.add("layout properties", renamed, renamed_detail(VEHICLES));
        plant.add_ends(layout, &mut names, losses);
        plant.add_other_ends(layout, &renamed_nodes, losses);
        plant
    }

    /// Name of the location type of a station.
    pub(super) fn type_name(&self, kind: Option<&str>) -> &str {
        let name = kind.and_then(|kind| self.type_names.get(kind));
        name.unwrap_or(&self.default_kind)
    }

    /// Tells if a path has its name, or none has: others count as lost and new.
    pub(super) fn keeps_path(&self, layout: &Layout, row: usize) -> bool {
        self.are_paths_renamed || self.path_names[row] == layout.paths.id(row)
    }

    /// Position of a point as written, in meters.
    pub(super) fn position_m(&self, point: u32) -> Point<f64> {
        let [x, y] = self.points[point as usize].position_mm;
        Point::new(x as f64 / 1e3, y as f64 / 1e3)
    }

    fn take_kind(&mut self, kind: &'a str, names: &mut UniqueNames<'a>) -> String {
        let name = names.take(kind).into_owned();
        self.type_names.insert(kind, name.clone());
        name
    }

    /// Adds the types of the layout, then those of further kinds.
    fn add_types(
        &mut self,
        kinds: &[Option<&'a str>],
        objects: Vec<Map<String, Json>>,
        names: &mut UniqueNames<'a>,
        losses: &mut Losses,
    ) {
        let mut renamed = 0;
        let mut further: Vec<Option<&'a str>> = kinds.to_vec();
        for mut object in objects {
            let name = object
                .get("name")
                .and_then(Json::as_str)
                .unwrap_or_default();
            let used = further.iter().position(|kind| *kind == Some(name));
            let unique = match used.and_then(|index| further.remove(index)) {
                Some(kind) => self.take_kind(kind, names),
                None => names.make_unique(name),
            };
            renamed += usize::from(unique != name);
            object.insert("name".into(), unique.into());
            self.types.push(object);
        }
        for kind in further {
            let unique = match kind {
                Some(kind) => self.take_kind(kind, names),
                None => {
                    let unique = names.make_unique(DEFAULT_KIND);
                    self.default_kind.clone_from(&unique);
                    unique
                }
            };
            renamed += usize::from(kind.is_some_and(|kind| kind != unique));
            self.types
                .push([("name".to_owned(), unique.into())].into_iter().collect());
        }
        losses.add("column kind", renamed, renamed_detail("location types"));
    }

    /// Lists the paths and stations whose points are new, or have another name than others of their
    /// table.
    fn add_other_ends(&self, layout: &Layout, renamed: &HashSet<u32>, losses: &mut Losses) {
        let nodes = layout.nodes.len();
        let are_all = renamed.len() == nodes && self.points.len() == nodes;
        let is_other =
            |point: &u32| *point as usize >= nodes || renamed.contains(point) && !are_all;
        let paths = layout.paths.iter().zip(&self.ends);
        let paths = paths.filter(|(path, ends)| {
            if !self.keeps_path(layout, path.row()) {
                return false;
            }
            let stated = [path.start_node(), path.end_node()];
            let are_kept = |ends: &[u32; 2]| stated == ends.map(Some);
            ends.is_some_and(|ends| !are_kept(&ends) || ends.iter().any(is_other))
        });
        losses.add(
            "ends",
            paths.count(),
            "paths: written between points with other names",
        );
        let stations = 0..layout.stations.len() as u32;
        let is_linked = |station: &u32| layout.stations.nodes(*station).iter().any(is_other);
        let count = stations.filter(is_linked).count();
        losses.add(
            "ends",
            count,
            "stations: written with links to points with other names",
        );
    }

    /// Finds the points of all paths; adds new ones at ends without a node.
    fn add_ends(&mut self, layout: &'a Layout, names: &mut UniqueNames<'a>, losses: &mut Losses) {
        let mut end_nodes = EndNodes::default();
        let mut new_points = 0;
        for path in layout.paths.iter() {
            let Some((start, end)) = path.ends() else {
                continue;
            };
            let level = path.level().map_or(usize::MAX, |level| level as usize);
            let mut points = [0; 2];
            let ends = [(path.start_node(), start), (path.end_node(), end)];
            for (point, (node, position)) in points.iter_mut().zip(ends) {
                *point = node
                    .or_else(|| end_nodes.near(level, position))
                    .unwrap_or_else(|| {
                        new_points += 1;
                        let row = self.points.len() as u32;
                        self.points.push(PlantPoint {
                            name: names.make_unique(&format!("Point {new_points}")).into(),
                            position_mm: to_mm(position),
                            path: Some(path.row()),
                        });
                        end_nodes.add(level, position, row);
                        row
                    });
            }
            self.ends[path.row()] = Some(points);
        }
        let detail = "new points: written at path ends without a node";
        losses.add("nodes", new_points, detail);
    }
}

/// Takes the names of the elements of a table; lists those that change.
fn take_names<'a>(
    of: &str,
    ids: impl Iterator<Item = &'a str>,
    names: &mut UniqueNames<'a>,
    losses: &mut Losses,
) -> Vec<Cow<'a, str>> {
    let before = names.renamed;
    let mut replaced = 0;
    let mut take = |id: &'a str| match id.chars().all(is_xml_char) {
        true => names.take(id),
        false => {
            replaced += 1;
            let id: String = id
                .chars()
                .map(|c| if is_xml_char(c) { c } else { '_' })
                .collect();
            names.make_unique(&id).into()
        }
    };
    let taken: Vec<_> = ids.map(&mut take).collect();
    let renamed = names.renamed - before + replaced;
    // Elements that all have new names are still known by their order.
    let what = if renamed == taken.len() {
        "identifiers"
    } else {
        of
    };
    losses.add(what, renamed, renamed_detail(of));
    taken
}

fn renamed_detail(of: &str) -> String {
    format!(
        "{of} whose name is empty, that of another element, or has characters that XML forbids: \
         written with a number at the end, or with `_`"
    )
}

/// A position in whole millimeters.
pub(super) fn to_mm(position: Point<f64>) -> [i64; 2] {
    [position.x, position.y].map(|meters| (meters * 1e3).round() as i64)
}

/// The JSON objects of an attribute of the layout.
pub(super) fn objects(layout: &Layout, name: &str) -> Vec<Map<String, Json>> {
    let value = layout.attributes.value(0, name);
    let text = match value {
        Some(guideway_layout::Value::Json(text)) => text,
        _ => return Vec::new(),
    };
    serde_json::from_str(text).unwrap_or_default()
}

/// The kinds of all stations, in order of first use.
fn kinds(layout: &Layout) -> Vec<Option<&str>> {
    let mut kinds = Vec::new();
    let mut known = HashSet::new();
    for station in 0..layout.stations.len() {
        let kind = kind_of(layout, station);
        if known.insert(kind) {
            kinds.push(kind);
        }
    }
    kinds
}

/// The kind of a station, if it is a text.
pub(super) fn kind_of(layout: &Layout, station: usize) -> Option<&str> {
    match layout.stations.attributes.value(station, "kind") {
        Some(guideway_layout::Value::Text(kind)) => Some(kind),
        _ => None,
    }
}
