//! Lists the changes from one layout to another, element by element.

use std::collections::BTreeSet;

use guideway_spline::Point;
use rayon::prelude::*;

use super::change::{Change, Changes, ElementChange};
use super::columns::{are_equal, names};
use super::curve_distance::{are_near, greatest_distance_m};
use super::difference::{CompareOptions, Differences};
use super::element_pairs::{level_id, match_nodes, match_paths, match_stations};
use super::groups::{self, MemberPairs};
use super::row_pairs::RowPairs;
use crate::{Attributes, Direction, ElementKind, Layout, PathRef, TypeEntries, Value};

/// Lists what changed from an old layout to a new one, element by element.
///
/// Elements are matched by identifier, in order among equal ones. Those that remain are matched by
/// place: a node or station at the same position, a path with the same ends and middle, on the same
/// level. They were renamed.
///
/// ```
/// use guideway_layout::{Change, CompareOptions, Layout, changes};
/// use guideway_spline::Point;
///
/// let mut old = Layout::default();
/// old.nodes.push("dock", Point::new(0.0, 0.0), None);
/// let mut new = old.clone();
/// new.nodes.set_position_m(0, Point::new(0.0, 2.0));
/// let found = changes(&old, &new, &CompareOptions::default());
/// assert_eq!(found.elements[0].change, Change::Moved { distance_m: 2.0 });
/// ```
pub fn changes(old: &Layout, new: &Layout, options: &CompareOptions) -> Changes {
    let layouts = [old, new];
    let nodes = match_nodes(layouts, options);
    let stations = match_stations(layouts, options);
    let paths = match_paths(layouts, options);
    let mut list = Lister {
        layouts,
        options,
        nodes: &nodes,
        found: Vec::new(),
    };
    list.nodes();
    list.paths(&paths);
    list.stations(&stations);
    let members = MemberPairs {
        paths: &paths,
        nodes: &nodes,
        stations: &stations,
    };
    let elements = list.found;
    let mut found = Differences::default();
    groups::compare(layouts, &members, options, &mut found);
    Changes {
        elements,
        groups: found.into_vec(),
    }
}

/// Collects the changes of two layouts.
struct Lister<'a> {
    layouts: [&'a Layout; 2],
    options: &'a CompareOptions,
    nodes: &'a RowPairs,
    found: Vec<ElementChange>,
}

/// The element whose changes are listed.
#[derive(Clone, Copy)]
struct Element<'a> {
    kind: ElementKind,
    id: &'a str,
    rows: [Option<u32>; 2],
}

/// A row whose values may differ per vehicle type.
#[derive(Clone, Copy)]
struct TypedRow<'a> {
    columns: &'a Attributes,
    types: &'a TypeEntries,
    row: usize,
}

impl<'a> TypedRow<'a> {
    /// The value for a vehicle type, else that for all.
    fn value(self, vehicle_type: Option<&str>, name: &str) -> Option<Value<'a>> {
        let of_type = || {
            let entry = self.types.entry_for(self.row, vehicle_type?)?;
            self.types.attributes.value(entry, name)
        };
        of_type().or_else(|| self.columns.value(self.row, name))
    }

    fn text(self, name: &str, value: Value<'_>) -> String {
        let table = match self.columns.get(name) {
            Some(_) => self.columns,
            None => &self.types.attributes,
        };
        text_of(table, name, value)
    }
}

impl<'a> Lister<'a> {
    fn add(&mut self, element: Element<'_>, change: Change) {
        self.found.push(ElementChange {
            element: element.kind,
            id: element.id.to_owned(),
            old_row: element.rows[0],
            new_row: element.rows[1],
            change,
        });
    }

    /// Adds the elements without a partner.
    fn add_unmatched(
        &mut self,
        kind: ElementKind,
        pairs: &RowPairs,
        ids: [&dyn Fn(u32) -> &'a str; 2],
    ) {
        for row in pairs.removed() {
            let (id, rows) = (ids[0](row), [Some(row), None]);
            self.add(Element { kind, id, rows }, Change::Removed);
        }
        for &row in pairs.added() {
            let (id, rows) = (ids[1](row), [None, Some(row)]);
            self.add(Element { kind, id, rows }, Change::Added);
        }
    }

    fn add_name(&mut self, element: Element<'_>, new_id: &str) {
        if element.id != new_id {
            let to = new_id.to_owned();
            self.add(element, Change::Renamed { to });
        }
    }

    fn add_position(&mut self, element: Element<'_>, positions: [Option<Point<f64>>; 2]) {
        match positions {
            [Some(p), Some(q)] => {
                let distance_m = p.distance(q);
                if distance_m > self.options.tolerance_m {
                    self.add(element, Change::Moved { distance_m });
                }
            }
            positions => {
                let texts = positions.map(|p| p.map(|p| format!("({}, {}) m", p.x, p.y)));
                self.add_set(element, "position", None, texts);
            }
        }
    }

    fn add_set(
        &mut self,
        element: Element<'_>,
        property: &str,
        vehicle_type: Option<&str>,
        [before, after]: [Option<String>; 2],
    ) {
        if before != after {
            let change = Change::Set {
                property: property.to_owned(),
                vehicle_type: vehicle_type.map(str::to_owned),
                before,
                after,
            };
            self.add(element, change);
        }
    }

    /// Adds the values of one row of two tables that differ.
    fn add_cells(&mut self, element: Element<'_>, tables: [(&Attributes, usize); 2]) {
        for name in names(&tables.map(|(table, _)| table)) {
            let cells = tables.map(|(table, row)| table.value(row, name));
            if !are_equal(cells, self.options.relative_tolerance) {
                let texts = [0, 1].map(|i| Some(text_of(tables[i].0, name, cells[i]?)));
                self.add_set(element, name, None, texts);
            }
        }
    }

    /// Adds the values of two elements that differ, and their vehicle types. A value of all vehicle
    /// types counts once, wherever the layouts hold it.
    fn add_typed_cells(&mut self, element: Element<'_>, tables: [TypedRow<'_>; 2]) {
        let [before, after] = tables.map(|of| of.types.of(of.row).collect::<BTreeSet<&str>>());
        if before != after {
            let texts = [&before, &after].map(|names| Some(type_list(names)));
            self.add_set(element, "vehicle types", None, texts);
        }
        let common: Vec<&str> = before.intersection(&after).copied().collect();
        let [a, b] = tables.map(|of| [of.columns, &of.types.attributes]);
        for name in names(&[a[0], a[1], b[0], b[1]]) {
            let texts = |of: Option<&str>| {
                let cells = tables.map(|row| row.value(of, name));
                let is_same = are_equal(cells, self.options.relative_tolerance);
                (!is_same).then(|| [0, 1].map(|i| Some(tables[i].text(name, cells[i]?))))
            };
            let per_type: Vec<_> = common.iter().map(|&of| (of, texts(Some(of)))).collect();
            let own = match per_type.split_first() {
                None => texts(None),
                Some(((_, first), rest)) if rest.iter().all(|(_, of)| of == first) => first.clone(),
                Some(_) => {
                    for (of, texts) in per_type {
                        if let Some(texts) = texts {
                            self.add_set(element, name, Some(of), texts);
                        }
                    }
                    None
                }
            };
            if let Some(texts) = own {
                self.add_set(element, name, None, texts);
            }
        }
    }

    fn add_level(&mut self, element: Element<'_>, levels: [Option<u32>; 2]) {
        let ids = [0, 1].map(|i| level_id(self.layouts[i], levels[i]).map(str::to_owned));
        self.add_set(element, "level", None, ids);
    }

    fn nodes(&mut self) {
        let ([a, b], pairs) = (self.layouts, self.nodes);
        for (p, q) in pairs.pairs() {
            let element = Element {
                kind: ElementKind::Node,
                id: a.nodes.id(p),
                rows: [Some(p), Some(q)],
            };
            self.add_name(element, b.nodes.id(q));
            self.add_position(
                element,
                [a.nodes.position_m(p), b.nodes.position_m(q)].map(Some),
            );
            self.add_level(element, [a.nodes.level(p), b.nodes.level(q)]);
            let tables = [(&a.nodes, p), (&b.nodes, q)].map(|(nodes, row)| TypedRow {
                columns: &nodes.attributes,
                types: nodes.vehicle_types(),
                row: row as usize,
            });
            self.add_typed_cells(element, tables);
        }
        self.add_unmatched(
            ElementKind::Node,
            pairs,
            [&|row| a.nodes.id(row), &|row| b.nodes.id(row)],
        );
    }

    fn stations(&mut self, pairs: &RowPairs) {
        let [a, b] = self.layouts;
        for (p, q) in pairs.pairs() {
            let element = Element {
                kind: ElementKind::Station,
                id: a.stations.id(p),
                rows: [Some(p), Some(q)],
            };
            self.add_name(element, b.stations.id(q));
            self.add_position(
                element,
                [a.stations.position_m(p), b.stations.position_m(q)],
            );
            self.add_level(element, [a.stations.level(p), b.stations.level(q)]);
            let nodes = a
                .stations
                .nodes(p)
                .iter()
                .map(|&node| self.nodes.partner(node));
            if !nodes.eq(b.stations.nodes(q).iter().map(|&node| Some(node))) {
                let texts =
                    [(a, a.stations.nodes(p)), (b, b.stations.nodes(q))].map(|(of, rows)| {
                        let ids: Vec<&str> = rows.iter().map(|&row| of.nodes.id(row)).collect();
                        (!ids.is_empty()).then(|| ids.join(", "))
                    });
                self.add_set(element, "nodes", None, texts);
            }
            let tables = [
                (&a.stations.attributes, p as usize),
                (&b.stations.attributes, q as usize),
            ];
            self.add_cells(element, tables);
        }
        self.add_unmatched(
            ElementKind::Station,
            pairs,
            [&|row| a.stations.id(row), &|row| b.stations.id(row)],
        );
    }

    fn paths(&mut self, pairs: &RowPairs) {
        let [a, b] = self.layouts;
        let paired: Vec<(u32, u32)> = pairs.pairs().collect();
        let paths_of = |(p, q): (u32, u32)| [a.paths.get(p as usize), b.paths.get(q as usize)];
        let tolerance_m = self.options.tolerance_m;
        let curves = paired
            .par_iter()
            .map(|&pair| curve_change(paths_of(pair), tolerance_m));
        let curves: Vec<Option<Change>> = curves.collect();
        for ((p, q), curve) in paired.into_iter().zip(curves) {
            let paths = paths_of((p, q));
            let element = Element {
                kind: ElementKind::Path,
                id: paths[0].id(),
                rows: [Some(p), Some(q)],
            };
            self.add_name(element, paths[1].id());
            if let Some(change) = curve {
                self.add(element, change);
            }
            self.add_level(element, paths.map(PathRef::level));
            let directions = paths.map(|path| {
                Some(match path.direction() {
                    Direction::Forward => "one way".to_owned(),
                    Direction::Both => "two ways".to_owned(),
                })
            });
            self.add_set(element, "direction", None, directions);
            self.add_end(element, "start node", paths.map(PathRef::start_node));
            self.add_end(element, "end node", paths.map(PathRef::end_node));
            let tables = [(&a.paths, p), (&b.paths, q)].map(|(paths, row)| TypedRow {
                columns: &paths.attributes,
                types: paths.vehicle_types(),
                row: row as usize,
            });
            self.add_typed_cells(element, tables);
        }
        let ids: [&dyn Fn(u32) -> &'a str; 2] = [&|row| a.paths.id(row as usize), &|row| {
            b.paths.id(row as usize)
        }];
        self.add_unmatched(ElementKind::Path, pairs, ids);
    }

    fn add_end(&mut self, element: Element<'_>, name: &str, ends: [Option<u32>; 2]) {
        let is_same = match ends {
            [Some(p), q] => self.nodes.partner(p).is_some() && self.nodes.partner(p) == q,
            [None, q] => q.is_none(),
        };
        if !is_same {
            let id = |i: usize| Some(self.layouts[i].nodes.id(ends[i]?).to_owned());
            self.add_set(element, name, None, [id(0), id(1)]);
        }
    }
}

/// The change of the curve of a path, if it is not the same within a tolerance.
fn curve_change(paths: [PathRef<'_>; 2], tolerance_m: f64) -> Option<Change> {
    let [p, q] = paths;
    if are_near(p, q, tolerance_m) {
        return None;
    }
    if let Some(distance_m) = shift_m(paths, tolerance_m) {
        return Some(Change::Moved { distance_m });
    }
    let greatest_m = greatest_distance_m(p, q).unwrap_or(f64::INFINITY);
    Some(Change::Reshaped { greatest_m })
}

/// Returns the length of the shift of a path that was moved as a whole.
fn shift_m([p, q]: [PathRef<'_>; 2], tolerance_m: f64) -> Option<f64> {
    let points = |path: PathRef<'_>| -> Vec<Point<f64>> {
        path.runs()
            .flat_map(|run| run.iter().collect::<Vec<_>>())
            .collect()
    };
    let (before, after) = (points(p), points(q));
    let shift = *after.first()? - *before.first()?;
    let is_shifted = before.len() == after.len()
        && p.runs().len() == q.runs().len()
        && before
            .iter()
            .zip(&after)
            .all(|(&b, &a)| (b + shift).distance(a) <= tolerance_m);
    is_shifted.then(|| shift.norm())
}

/// A value with the unit of its column.
fn text_of(table: &Attributes, name: &str, value: Value<'_>) -> String {
    match table.get(name).and_then(|column| column.quantity) {
        Some(quantity) => format!("{value} {}", quantity.unit()),
        None => value.to_string(),
    }
}

fn type_list(names: &BTreeSet<&str>) -> String {
    if names.is_empty() {
        return "all".to_owned();
    }
    let names: Vec<&str> = names.iter().copied().collect();
    names.join(", ")
}
