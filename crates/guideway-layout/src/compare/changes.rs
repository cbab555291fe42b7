//! Lists the changes from one layout to another, element by element.

use guideway_spline::Point;
use rayon::prelude::*;

use super::cells::{Cells, Table};
use super::change::{Change, ChangeGroup, ChangedValue, Changes, ElementChanges};
use super::curve_distance::{are_near, greatest_distance_m};
use super::difference::{CompareOptions, Differences};
use super::element_pairs::level_id;
use super::groups::{self, MemberPairs};
use super::moved_pairs::ElementPairs;
use super::row_pairs::RowPairs;
use crate::{ElementKind, Layout, PathRef};

/// Pairs of elements that a task of a thread compares.
const TASK_PAIRS: usize = 1024;

/// Lists what changed from an old layout to a new one, element by element.
///
/// Elements are matched by identifier, in order among equal ones. Those that remain were renamed if
/// one element is at their place: a node or station at the same position, a path with the same ends
/// and middle, on the same level. They were renamed and moved if one element alone fits: a node at
/// the same ends of paths, between the same nodes or within a meter; a path between the same nodes,
/// or one without nodes with the same shape within its length; a station with the same nodes or
/// within a meter.
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
/// let change = found.elements.iter().next().map(|of| of.change);
/// assert_eq!(change, Some(Change::Moved { distance_m: 2.0 }));
/// ```
pub fn changes<'a>(old: &'a Layout, new: &'a Layout, options: &CompareOptions) -> Changes<'a> {
    let layouts = [old, new];
    let pairs = ElementPairs::of(layouts, options);
    let mut columns = Vec::new();
    let mut elements = ElementChanges::default();
    for (kind, of_kind) in [
        (ElementKind::Node, &pairs.nodes),
        (ElementKind::Path, &pairs.paths),
        (ElementKind::Station, &pairs.stations),
    ] {
        let tables = layouts.map(|layout| Table::of(layout, kind));
        let list = Lister {
            layouts,
            options,
            nodes: &pairs.nodes,
            kind,
            cells: Cells::new(tables, options.relative_tolerance, &mut columns),
        };
        list.add_to(of_kind, &mut elements);
    }
    let members = MemberPairs {
        paths: &pairs.paths,
        nodes: &pairs.nodes,
        stations: &pairs.stations,
    };
    let mut found = Differences::default();
    groups::compare(layouts, &members, options, &mut found);
    Changes {
        elements,
        groups: found.into_vec(),
        layouts,
        columns,
    }
}

/// Lists the changes of one kind of element.
struct Lister<'a> {
    layouts: [&'a Layout; 2],
    options: &'a CompareOptions,
    nodes: &'a RowPairs,
    kind: ElementKind,
    cells: Cells<'a>,
}

impl Lister<'_> {
    /// Appends the changes of all pairs, then the elements without a partner.
    fn add_to(&self, pairs: &RowPairs, all: &mut ElementChanges) {
        let rows: Vec<(u32, u32)> = pairs.pairs().collect();
        let of_task = |rows: &[(u32, u32)]| {
            let mut found = ChangeGroup::new(self.kind);
            for &(p, q) in rows {
                let rows = [Some(p), Some(q)];
                self.compare([p, q], &mut |change| found.push(rows, change));
            }
            found.shrunk()
        };
        let tasks = rows.par_chunks(TASK_PAIRS).map(of_task);
        all.extend(tasks.collect::<Vec<ChangeGroup>>());
        let mut rest = ChangeGroup::new(self.kind);
        for row in pairs.removed() {
            rest.push([Some(row), None], Change::Removed);
        }
        for &row in pairs.added() {
            rest.push([None, Some(row)], Change::Added);
        }
        all.extend([rest.shrunk()]);
    }

    /// Finds the changes of one element.
    fn compare(&self, rows: [u32; 2], found: &mut impl FnMut(Change)) {
        match self.kind {
            ElementKind::Path => self.compare_paths(rows, found),
            ElementKind::Station => self.compare_stations(rows, found),
            _ => self.compare_nodes(rows, found),
        }
        let rows = rows.map(|row| row as usize);
        let mut set = |value| found(Change::Set(value));
        self.cells.compare(rows, &mut set);
    }

    fn compare_nodes(&self, [p, q]: [u32; 2], found: &mut impl FnMut(Change)) {
        let [a, b] = self.layouts.map(|layout| &layout.nodes);
        if a.id(p) != b.id(q) {
            found(Change::Renamed);
        }
        self.compare_positions([a.position_m(p), b.position_m(q)].map(Some), found);
        self.compare_levels([a.level(p), b.level(q)], found);
    }

    fn compare_stations(&self, [p, q]: [u32; 2], found: &mut impl FnMut(Change)) {
        let [a, b] = self.layouts.map(|layout| &layout.stations);
        if a.id(p) != b.id(q) {
            found(Change::Renamed);
        }
        self.compare_positions([a.position_m(p), b.position_m(q)], found);
        self.compare_levels([a.level(p), b.level(q)], found);
        let expected = a.nodes(p).iter().map(|&node| self.nodes.partner(node));
        if !expected.eq(b.nodes(q).iter().map(|&node| Some(node))) {
            found(Change::Set(ChangedValue::Nodes));
        }
    }

    fn compare_paths(&self, [p, q]: [u32; 2], found: &mut impl FnMut(Change)) {
        let [a, b] = self.layouts;
        let paths = [a.paths.get(p as usize), b.paths.get(q as usize)];
        if paths[0].id() != paths[1].id() {
            found(Change::Renamed);
        }
        if let Some(change) = curve_change(paths, self.options.tolerance_m) {
            found(change);
        }
        self.compare_levels(paths.map(PathRef::level), found);
        if paths[0].direction() != paths[1].direction() {
            found(Change::Set(ChangedValue::Direction));
        }
        for (value, ends) in [
            (ChangedValue::StartNode, paths.map(PathRef::start_node)),
            (ChangedValue::EndNode, paths.map(PathRef::end_node)),
        ] {
            let is_same = match ends {
                [Some(p), q] => self.nodes.partner(p).is_some_and(|p| Some(p) == q),
                [None, q] => q.is_none(),
            };
            if !is_same {
                found(Change::Set(value));
            }
        }
    }

    fn compare_positions(
        &self,
        positions: [Option<Point<f64>>; 2],
        found: &mut impl FnMut(Change),
    ) {
        match positions {
            [Some(p), Some(q)] => {
                let distance_m = p.distance(q);
                if distance_m > self.options.tolerance_m {
                    found(Change::Moved { distance_m });
                }
            }
            [None, None] => {}
            _ => found(Change::Set(ChangedValue::Position)),
        }
    }

    fn compare_levels(&self, levels: [Option<u32>; 2], found: &mut impl FnMut(Change)) {
        let [before, after] = [0, 1].map(|i| level_id(self.layouts[i], levels[i]));
        if before != after {
            found(Change::Set(ChangedValue::Level));
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
