//! Merge: joins several layouts into one.

use crate::{
    Attributes, Block, Code, Diagnostics, Layout, Level, Place, Provenance, Stations, Value, Zone,
};

/// Names for the column with the source of each row; the first one that no input uses applies.
const SOURCE: [&str; 2] = ["source", "source_file"];

/// Merges layouts in their order: at equal rank, paths of later layouts cover those of earlier
/// ones.
///
/// Identifiers do not change, even if several layouts use the same; paths refer to the nodes of
/// their own layout. Layouts with a place on earth get the origin of the first one, and lie as on
/// earth. Levels of different layouts with the same identifier or name become one. The
/// column `source` of paths, nodes and stations states [`Provenance::source`]. Columns of the same
/// name become one, in the narrowest type that can represent all values. A single layout is
/// returned unchanged.
pub fn merge(layouts: Vec<Layout>) -> Layout {
    let layouts = match <[Layout; 1]>::try_from(layouts) {
        Ok([one]) => return one,
        Err(layouts) => layouts,
    };
    let has_column = |name: &str| layouts.iter().any(|layout| layout.has_column(name));
    let source = SOURCE.into_iter().find(|name| !has_column(name));
    let mut merged = Merged {
        layout: Layout {
            provenance: provenance(&layouts),
            diagnostics: Diagnostics::default(),
            ..Layout::default()
        },
        source: source.unwrap_or(SOURCE[0]),
    };
    let unplaced = unplaced(&layouts);
    for layout in layouts {
        merged.add(layout);
    }
    for source in unplaced {
        merged.layout.diagnostics.push(
            Code::AssumedUnit,
            || Place::element(source),
            || "the layout has no place on earth, but others that are merged with it have".into(),
            "Its positions are read as meters from the origin of the first layout that has one",
        );
    }
    merged.layout
}

/// The merge of the layouts so far.
struct Merged {
    layout: Layout,
    source: &'static str,
}

impl Merged {
    /// Appends all elements of a layout; their references keep pointing to their own elements.
    fn add(&mut self, mut other: Layout) {
        if let Some(origin) = self.layout.geo_origin {
            other.move_origin(origin);
        }
        let levels = self.add_levels(&other.levels);
        let level = |level: u32| levels[level as usize];
        let all = &mut self.layout;
        let firsts = Firsts {
            path: all.paths.len() as u32,
            node: all.nodes.len() as u32,
            station: all.stations.len() as u32,
        };
        all.nodes.append(&other.nodes, |row| row.map(level));
        add_stations(&mut all.stations, &other.stations, firsts, level);
        all.paths
            .append(&other.paths, |node| firsts.node + node, level);
        let source = (self.source, other.provenance.source.as_str());
        set_source(
            &mut all.paths.attributes,
            firsts.path,
            other.paths.len(),
            source,
        );
        set_source(
            &mut all.nodes.attributes,
            firsts.node,
            other.nodes.len(),
            source,
        );
        let stations = other.stations.len();
        set_source(
            &mut all.stations.attributes,
            firsts.station,
            stations,
            source,
        );
        for refused in other.refused.iter() {
            all.refused.push(refused.id, refused.code, refused.detail);
        }
        for vehicle_type in std::mem::take(&mut other.vehicle_types) {
            match all
                .vehicle_types
                .iter_mut()
                .find(|t| t.id == vehicle_type.id)
            {
                Some(known) => fill(&mut known.attributes, &vehicle_type.attributes),
                None => all.vehicle_types.push(vehicle_type),
            }
        }
        let blocks = other.blocks.drain(..);
        all.blocks
            .extend(blocks.map(|block| firsts.renumber(block)));
        all.zones.extend(other.zones.drain(..).map(|zone| Zone {
            level: zone.level.map(level),
            ..zone
        }));
        all.notes.append(&mut other.notes);
        fill(&mut all.attributes, &other.attributes);
        all.geo_origin = all.geo_origin.or(other.geo_origin);
        all.diagnostics
            .append(std::mem::take(&mut other.diagnostics));
    }

    /// Adds the new levels of another layout and returns the merged row of each. Levels of one
    /// layout stay separate, even if they have the same name.
    fn add_levels(&mut self, others: &[Level]) -> Vec<u32> {
        let known = self.layout.levels.len();
        let levels = &mut self.layout.levels;
        let row = |level: &Level| {
            let same = levels[..known].iter().position(|l| is_same(l, level));
            let row = same.unwrap_or_else(|| {
                levels.push(level.clone());
                levels.len() - 1
            });
            let elevation_m = &mut levels[row].elevation_m;
            *elevation_m = elevation_m.or(level.elevation_m);
            fill(&mut levels[row].attributes, &level.attributes);
            row as u32
        };
        others.iter().map(row).collect()
    }
}

/// Merged rows of the first path, node and station of one layout.
#[derive(Clone, Copy)]
struct Firsts {
    path: u32,
    node: u32,
    station: u32,
}

impl Firsts {
    fn renumber(self, mut block: Block) -> Block {
        let member = |member: crate::Member| {
            member.renumbered(
                |row| Some(self.path + row),
                |row| Some(self.node + row),
                |row| Some(self.station + row),
            )
        };
        block.members = block.members.into_iter().filter_map(member).collect();
        block
    }
}

fn add_stations(all: &mut Stations, other: &Stations, firsts: Firsts, level: impl Fn(u32) -> u32) {
    for station in 0..other.len() as u32 {
        let nodes = other.nodes(station).iter();
        let nodes = nodes.map(|&node| firsts.node + node).collect();
        let level = other.level(station).map(&level);
        all.push(other.id(station), other.position_m(station), nodes, level);
    }
    all.attributes
        .extend(firsts.station as usize, &other.attributes);
}

/// Sets the column of the source for `rows` rows.
fn set_source(all: &mut Attributes, first: u32, rows: usize, (column, source): (&str, &str)) {
    for row in first as usize..first as usize + rows {
        all.set(row, column, Value::Text(source));
    }
}

/// Adds the values of a single row that `to` lacks.
fn fill(to: &mut Attributes, from: &Attributes) {
    for column in from.iter() {
        if to.value(0, &column.name).is_none() {
            to.insert(column.clone());
        }
    }
}

impl Layout {
    fn has_column(&self, name: &str) -> bool {
        let tables = [
            &self.paths.attributes,
            &self.nodes.attributes,
            &self.stations.attributes,
        ];
        tables.into_iter().any(|table| table.get(name).is_some())
    }
}

/// Returns `true` if two levels have the same identifier or the same name.
fn is_same(a: &Level, b: &Level) -> bool {
    a.id == b.id || a.name.is_some() && a.name == b.name
}

/// Sources of the layouts without a place on earth, if others have one.
fn unplaced(layouts: &[Layout]) -> Vec<String> {
    if layouts.iter().all(|layout| layout.geo_origin.is_none()) {
        return Vec::new();
    }
    let is_empty = |layout: &Layout| layout.paths.len() + layout.nodes.len() == 0;
    let unplaced = layouts.iter().filter(|layout| layout.geo_origin.is_none());
    let unplaced = unplaced.filter(|layout| !is_empty(layout));
    unplaced
        .map(|layout| layout.provenance.source.clone())
        .collect()
}

/// Provenance of several sources: each distinct name once, and the sums of the counts.
fn provenance(layouts: &[Layout]) -> Provenance {
    let of = |part: fn(&Provenance) -> &str, separator: &str| {
        let mut parts: Vec<&str> = Vec::new();
        for layout in layouts {
            let part = part(&layout.provenance);
            if !parts.contains(&part) {
                parts.push(part);
            }
        }
        parts.join(separator)
    };
    let mut counts: Vec<(String, u64)> = Vec::new();
    for (name, count) in layouts.iter().flat_map(|l| &l.provenance.counts) {
        match counts.iter_mut().find(|(known, _)| known == name) {
            Some((_, sum)) => *sum += count,
            None => counts.push((name.clone(), *count)),
        }
    }
    Provenance {
        source: of(|p| &p.source, ", "),
        format: of(|p| &p.format, " + "),
        format_version: of(|p| &p.format_version, " + "),
        // Drawings may differ in it.
        assumed_unit_m: None,
        counts,
        // A writer could copy the fields of one source only.
        text: None,
        file: None,
    }
}
