//! [`Layout`]: the contents of one layout file, and [`Provenance`], its origin.

use std::cmp::Ordering;
use std::collections::BTreeSet;
use std::sync::Arc;

use guideway_spline::{Affine, Point};

use crate::{
    Attributes, Block, Diagnostics, GeoOrigin, Level, Nodes, Note, PathRef, Paths, Refused,
    SourceFile, Stations, VehicleType, Zone,
};

/// A layout, as read from one file or merged from several.
#[derive(Clone, Debug, Default)]
pub struct Layout {
    /// Origin of the layout.
    pub provenance: Provenance,
    /// The paths that are drawn.
    pub paths: Paths,
    /// Paths of the input that cannot be drawn, each with its reason.
    pub refused: Refused,
    /// Named points where paths begin, end and meet.
    pub nodes: Nodes,
    /// Named places where vehicles load, unload, park or charge.
    pub stations: Stations,
    /// Floors of the building, or the layouts of a file that has several.
    pub levels: Vec<Level>,
    /// Properties of vehicle types. A type without properties may be missing: the entries of paths
    /// and nodes name types by their identifier.
    pub vehicle_types: Vec<VehicleType>,
    /// Sets of elements with a common rule.
    pub blocks: Vec<Block>,
    /// Areas with a rule.
    pub zones: Vec<Zone>,
    /// Texts, points and placed blocks of a drawing.
    pub notes: Vec<Note>,
    /// Properties of the layout as a whole, in one row.
    pub attributes: Attributes,
    /// Place on earth of the origin, if the positions of the file were degrees.
    pub geo_origin: Option<GeoOrigin>,
    /// Findings about the file, made by its reader.
    pub diagnostics: Diagnostics,
}

impl Layout {
    /// Number of paths in the input: drawn and refused ones.
    pub fn path_count(&self) -> usize {
        self.paths.len() + self.refused.len()
    }

    /// The path (the edge, in the words of LIF) with this identifier, if any: the first one. Looks
    /// at all paths.
    pub fn edge(&self, id: &str) -> Option<PathRef<'_>> {
        self.paths.iter().find(|path| path.id() == id)
    }

    /// Index of the level with this identifier or name, if any.
    pub fn level_named(&self, name: &str) -> Option<u32> {
        let found = self
            .levels
            .iter()
            .position(|l| l.id == name || l.name.as_deref() == Some(name));
        found.map(|i| i as u32)
    }

    /// Inserts a level. The rows of the levels from `row` on grow by one.
    ///
    /// # Panics
    /// When `row` is greater than the number of levels.
    pub fn insert_level(&mut self, row: u32, level: Level) {
        self.levels.insert(row as usize, level);
        self.renumber_levels(|other| Some(other + u32::from(other >= row)));
    }

    /// Removes a level. The rows of the levels after it shrink by one; what is on it is on no level
    /// then.
    ///
    /// # Panics
    /// When the level does not exist.
    pub fn remove_level(&mut self, row: u32) -> Level {
        self.renumber_levels(|other| match other.cmp(&row) {
            Ordering::Less => Some(other),
            Ordering::Equal => None,
            Ordering::Greater => Some(other - 1),
        });
        self.levels.remove(row as usize)
    }

    fn renumber_levels(&mut self, row: impl Fn(u32) -> Option<u32>) {
        self.paths.renumber_levels(&row);
        self.nodes.renumber_levels(&row);
        self.stations.renumber_levels(&row);
        let zones = self.zones.iter_mut();
        zones.for_each(|zone| zone.level = zone.level.and_then(&row));
    }

    /// Names of the vehicle types that paths, nodes or the table of vehicle types name, in
    /// alphabetical order.
    pub fn vehicle_type_names(&self) -> BTreeSet<&str> {
        let of_elements = [&self.paths.vehicle_types(), &self.nodes.vehicle_types()];
        let of_elements = of_elements.into_iter().flat_map(|entries| entries.names());
        let of_table = self.vehicle_types.iter().map(|t| t.id.as_str());
        of_elements.map(String::as_str).chain(of_table).collect()
    }

    /// Position of a station, in meters: its own, or that of its first node. `None` without either.
    ///
    /// # Panics
    /// When the station is unknown.
    pub fn station_position_m(&self, station: u32) -> Option<Point<f64>> {
        let node = self.stations.nodes(station).first();
        let at_node = || node.map(|&node| self.nodes.position_m(node));
        self.stations.position_m(station).or_else(at_node)
    }

    /// Keeps the paths of the given rows, in this order, and removes all others.
    ///
    /// # Panics
    /// When a row is not below the number of paths.
    pub fn retain_paths(&mut self, rows: &[usize]) {
        let mut new_rows = vec![None; self.paths.len()];
        for (new, &old) in rows.iter().enumerate() {
            new_rows[old] = Some(new as u32);
        }
        self.paths = self.paths.select(rows, Some);
        for block in &mut self.blocks {
            let members = block.members.drain(..);
            let kept = members
                .filter_map(|member| member.renumbered(|path| new_rows[path as usize], Some, Some));
            block.members = kept.collect();
        }
    }

    /// Keeps the nodes and stations of the given rows, in this order, and removes all others.
    /// Paths, stations and blocks lose their references to removed ones.
    ///
    /// # Panics
    /// When a row is not below the number of nodes or stations.
    pub fn retain_nodes_and_stations(&mut self, nodes: &[usize], stations: &[usize]) {
        let new_rows = |len: usize, kept: &[usize]| {
            let mut rows = vec![None; len];
            for (new, &old) in kept.iter().enumerate() {
                rows[old] = Some(new as u32);
            }
            rows
        };
        let node_rows = new_rows(self.nodes.len(), nodes);
        let station_rows = new_rows(self.stations.len(), stations);
        let node = |row: u32| node_rows[row as usize];
        self.paths.renumber_nodes(node);
        self.nodes = self.nodes.select(nodes);
        self.stations = self.stations.select(stations, node);
        for block in &mut self.blocks {
            let members = block.members.drain(..);
            let station = |row: u32| station_rows[row as usize];
            let kept = members.filter_map(|member| member.renumbered(Some, node, station));
            block.members = kept.collect();
        }
    }

    /// A copy with the first rows of paths, nodes and stations, in no more memory than they need.
    /// Paths and stations lose their references to nodes beyond them; blocks are copied as they
    /// are.
    ///
    /// # Panics
    /// When a table has fewer rows.
    #[must_use]
    pub fn first_rows(&self, [paths, nodes, stations]: [usize; 3]) -> Self {
        let rows = |count: usize| (0..count).collect::<Vec<_>>();
        let node = |row: u32| ((row as usize) < nodes).then_some(row);
        Self {
            provenance: self.provenance.clone(),
            paths: self.paths.select(&rows(paths), node),
            refused: self.refused.clone(),
            nodes: self.nodes.select(&rows(nodes)),
            stations: self.stations.select(&rows(stations), node),
            levels: self.levels.clone(),
            vehicle_types: self.vehicle_types.clone(),
            blocks: self.blocks.clone(),
            zones: self.zones.clone(),
            notes: self.notes.clone(),
            attributes: self.attributes.clone(),
            geo_origin: self.geo_origin,
            diagnostics: self.diagnostics.clone(),
        }
    }

    /// Returns `true` if the layout is a drawing that is no network yet: lines without a direction.
    pub fn is_drawing(&self) -> bool {
        self.nodes.is_empty() && self.provenance.is_all_of(&DRAWING_FORMATS)
    }

    /// Heap bytes in use, approximately: it omits levels, diagnostics and provenance.
    pub fn heap_bytes(&self) -> usize {
        self.paths.heap_bytes()
            + self.refused.heap_bytes()
            + self.nodes.heap_bytes()
            + self.stations.heap_bytes()
    }

    /// Moves the origin to another place on earth; everything keeps its own. A layout without a
    /// place on earth, or at this one, does not change.
    pub fn move_origin(&mut self, origin: GeoOrigin) {
        let Some(before) = self.geo_origin.filter(|&before| before != origin) else {
            return;
        };
        let by = before.to_origin(origin);
        self.paths.transform(0..self.paths.len(), by);
        self.nodes.transform(by);
        self.stations.transform(by);
        self.zones.iter_mut().for_each(|zone| zone.transform(by));
        self.geo_origin = Some(origin);
    }

    /// Maps curves, nodes and stations, and scales widths by the square root of the area scale.
    /// Attributes do not change, whatever they measure.
    pub fn transform(&mut self, by: Affine) {
        self.paths.transform(0..self.paths.len(), by);
        self.nodes.transform(by);
        self.stations.transform(by);
        self.zones.iter_mut().for_each(|zone| zone.transform(by));
        self.notes.iter_mut().for_each(|note| note.transform(by));
        if let Some(widths_m) = self.paths.width_m() {
            let scale = by.x.cross(by.y).abs().sqrt() as f32;
            self.paths
                .set_width_m(widths_m.iter().map(|w| w * scale).collect());
        }
    }
}

/// Formats whose lines have no direction. One that holds networks too is a drawing without nodes.
const DRAWING_FORMATS: [&str; 4] = ["DXF", "SVG", "ROS map", "GeoJSON"];

/// Origin of a layout.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Provenance {
    /// Path of the file, or another name of the source, as given by the caller.
    pub source: String,
    /// Detected format, such as `LIF` or `openTCS`.
    pub format: String,
    /// Version of the format, derived from the structure of the file.
    pub format_version: String,
    /// Meters per unit of the numbers of a drawing that does not state it, as its reader assumed.
    pub assumed_unit_m: Option<f64>,
    /// Numbers of elements in the source, under the names of the format, such as `("edges", 12)`.
    pub counts: Vec<(String, u64)>,
    /// Text of the file, for formats whose writer copies what did not change.
    pub text: Option<Arc<str>>,
    /// The file, if its text is too large to keep.
    pub file: Option<SourceFile>,
}

impl Provenance {
    /// Text of the file, read again if it is too large to keep; `None` if the format has no use for
    /// it, or the file changed since.
    pub fn source_text(&self) -> Option<Arc<str>> {
        let read_again = || self.file.as_ref()?.read().map(Into::into);
        self.text.clone().or_else(read_again)
    }

    /// A count by its name.
    pub fn count(&self, name: &str) -> Option<u64> {
        let found = self.counts.iter().find(|(own, _)| own == name);
        found.map(|(_, count)| *count)
    }

    /// Returns `true` if all formats of the files are among these.
    pub(crate) fn is_all_of(&self, formats: &[&str]) -> bool {
        let mut own = self.format.split(" + ");
        own.all(|format| formats.contains(&format))
    }
}
