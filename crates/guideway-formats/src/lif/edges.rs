//! LIF edges: maps an edge to paths, one per distinct curve, because vehicle types may have curves
//! of their own.

use std::borrow::Cow;
use std::collections::HashMap;

use guideway_layout::{Code, NewPath};
use guideway_spline::{Point, Runs};

use super::mapper::Mapper;
use super::members::{EDGE_ID, OTHER};
use super::model::{EDGE_PROPERTIES, Edge, PHYSICAL_LINE};
use super::type_entries::{ColumnCell, TypesOfElement, other_cell};
use crate::ReadError;
use crate::builder::{PlaceFn, Table};
use crate::json::{Cell, Field, LazyItem, OtherMembers, field_place, items, member};
use crate::trajectory::Trajectory;

/// A curve of an edge, with the vehicle types that follow it.
struct Curve<'r> {
    /// `None` for the straight line between the nodes.
    trajectory: Option<&'r Trajectory>,
    /// Key and index of its first entry; `None` if the edge has no entry.
    entry: Option<(&'static str, usize)>,
    types: TypesOfElement,
    /// Index of the properties of its first entry.
    first_cells: usize,
}

/// The curves of an edge, and the properties of its entries.
struct EdgeEntries<'r, 'a> {
    curves: Vec<Curve<'r>>,
    cells: Vec<Vec<ColumnCell<'a>>>,
}

/// A node that an edge refers to.
struct End<'r> {
    name: Option<&'r str>,
    row: Option<u32>,
    position: Option<Point<f64>>,
    level: Option<u32>,
}

impl Mapper<'_> {
    /// Maps an edge to paths, or to refused paths.
    pub(super) fn map_edge(
        &mut self,
        item: &LazyItem<'_, Edge<'_>>,
        level: u32,
        at: PlaceFn<'_>,
    ) -> Result<(), ReadError> {
        let Some(edge) = self.builder.record(&item.record, at) else {
            self.counts.edges += 1;
            let detail = "the edge is not an object";
            return self.builder.refuse(&at().element, Code::WrongType, detail);
        };
        self.builder.check_repeated(edge.repeated, at);
        let id = self.builder.id(&edge.id, at, "edgeId")?;
        self.counts.edges += 1;
        let start = self.end(&edge.start, &id, level, &|| field_place(at, "startNodeId"))?;
        let end = self.end(&edge.end, &id, level, &|| field_place(at, "endNodeId"))?;
        let mut other = OtherMembers::default();
        let entries = self.entries(item, edge, &mut other, at)?;
        let mut cells = self.cells(&edge.attributes, &self.columns.edge, &mut other, at)?;
        cells.extend(other_cell(other, OTHER));
        let is_single = entries.curves.len() == 1;
        if !is_single {
            cells.push(ColumnCell {
                column: EDGE_ID,
                quantity: None,
                cell: Cell::Text(Cow::Borrowed(&id)),
            });
        }
        for (i, curve) in entries.curves.iter().enumerate() {
            let name = match (is_single, curve.types.list.as_slice()) {
                (true, _) => Cow::Borrowed(id.as_ref()),
                (false, []) => format!("{id} [{}]", i + 1).into(),
                (false, types) => {
                    let names: Vec<&str> = types.iter().map(|of| of.name.as_str()).collect();
                    format!("{id} [{}]", names.join(", ")).into()
                }
            };
            let at_curve: PlaceFn<'_> = &|| match curve.entry {
                Some((key, i)) => field_place(at, &format!("{key}[{i}]")),
                None => at(),
            };
            let row = self.map_curve(item, &name, curve, [&start, &end], level, at_curve)?;
            if let Some(row) = row {
                self.set_properties(row, &cells, curve, &entries.cells, at_curve)?;
            }
        }
        Ok(())
    }

    fn end<'r>(
        &mut self,
        field: &'r Field<Cow<'_, str>>,
        edge: &str,
        level: u32,
        at: PlaceFn<'_>,
    ) -> Result<End<'r>, ReadError> {
        let name = self.builder.text(field, at)?;
        if field.is_absent() {
            self.builder.report_missing(at, "the identifier of a node");
        }
        let row = name.and_then(|name| self.node(name, level));
        if let (Some(name), None) = (name, row) {
            self.builder.report_unknown_node(name, edge, at);
        }
        let nodes = &self.builder.layout.nodes;
        Ok(End {
            name,
            row,
            position: row.map(|row| nodes.position_m(row)),
            level: row.and_then(|row| nodes.level(row)),
        })
    }

    /// Groups the entries of an edge by curve. Vehicle types without a trajectory share the
    /// straight line. Surplus entries are added to `other`.
    fn entries<'r, 'a>(
        &mut self,
        item: &LazyItem<'_, Edge<'a>>,
        edge: &'r Edge<'a>,
        other: &mut OtherMembers,
        at: PlaceFn<'_>,
    ) -> Result<EdgeEntries<'r, 'a>, ReadError> {
        let mut entries = EdgeEntries {
            curves: Vec::new(),
            cells: Vec::new(),
        };
        let curves = &mut entries.curves;
        let mut index_by_curve: HashMap<Vec<u64>, usize> = HashMap::new();
        let lists = [&edge.types_1, &edge.types_2];
        let count: usize = lists.iter().map(|list| items(list).len()).sum();
        for (v, list) in lists.into_iter().enumerate() {
            let key = EDGE_PROPERTIES[v];
            self.builder.check_array(list, at, key);
            for (i, field) in items(list) {
                let at_entry: PlaceFn<'_> = &|| field_place(at, &format!("{key}[{i}]"));
                let Some(entry) = self.builder.record(field, at_entry) else {
                    continue;
                };
                self.builder.check_repeated(entry.repeated, at_entry);
                let types =
                    self.vehicle_types(&entry.vehicle_type, &entry.robot_types, at_entry)?;
                for name in &types {
                    if !self.vehicle_types.contains(name) {
                        self.vehicle_types.insert(name.clone());
                    }
                }
                let at_curve: PlaceFn<'_> = &|| field_place(at_entry, "trajectory");
                self.builder
                    .check_type(&entry.trajectory, at_curve, "an object");
                let trajectory = entry.trajectory.get().map(AsRef::as_ref);
                if trajectory.is_some() {
                    self.counts.trajectories += 1;
                }
                let index = match count {
                    1 => 0,
                    _ => {
                        let known = curve_key(trajectory, || item.array_item(key, i));
                        *index_by_curve.entry(known).or_insert(curves.len())
                    }
                };
                let is_new = index == curves.len();
                if is_new {
                    curves.push(Curve {
                        trajectory,
                        entry: Some((key, i)),
                        types: TypesOfElement::default(),
                        first_cells: entries.cells.len(),
                    });
                }
                let curve = &mut curves[index];
                let (is_open, first_name) = (types.is_empty(), types.first().cloned());
                let has_new = curve.types.add_all(types, entries.cells.len());
                if !(has_new || is_open && is_new) {
                    self.report_surplus_entry(first_name.as_deref(), at_entry);
                    other.add_item(key, item.array_item(key, i));
                }
                let columns = &self.columns.edge_type[v];
                let cells = self.type_cells(&entry.attributes, columns, at_entry)?;
                entries.cells.push(cells);
            }
        }
        if entries.curves.is_empty() {
            self.builder.report_missing(
                &|| field_place(at, EDGE_PROPERTIES[0]),
                "an entry for a vehicle type",
            );
            entries.curves.push(Curve {
                trajectory: None,
                entry: None,
                types: TypesOfElement::default(),
                first_cells: 0,
            });
        }
        Ok(entries)
    }

    /// Maps a curve to a path, and returns its row; or to a refused path.
    fn map_curve(
        &mut self,
        item: &LazyItem<'_, Edge<'_>>,
        name: &str,
        curve: &Curve<'_>,
        ends: [&End<'_>; 2],
        level: u32,
        at: PlaceFn<'_>,
    ) -> Result<Option<usize>, ReadError> {
        let [start, end] = ends;
        if start.row.is_some() && end.row.is_some() && start.level != end.level {
            let detail = self.between_levels(start, end);
            let detail = format!("`{name}` {detail}");
            let remedy = "A lift is not drawn; else move the node to the other layout";
            let builder = &mut self.builder;
            builder.refuse_at(name, Code::CrossLevel, &detail, at, remedy)?;
            return Ok(None);
        }
        let mut runs = Runs::default();
        let mut read = None;
        if let Some(trajectory) = curve.trajectory {
            let at_curve: PlaceFn<'_> = &|| field_place(at, "trajectory");
            read = Some(
                self.builder
                    .append_trajectory(trajectory, at_curve, &mut runs)?,
            );
        }
        let positions = start.position.zip(end.position);
        if runs.is_empty() {
            let Some((from, to)) = positions else {
                let detail = missing_ends(ends);
                self.builder.refuse(name, Code::UnknownNode, &detail)?;
                return Ok(None);
            };
            runs.push_line(from, to);
        }
        let vehicle_types: Vec<&str> = curve.types.list.iter().map(|of| of.name.as_str()).collect();
        let row = self.builder.push_path(&NewPath {
            id: name,
            runs: &runs,
            start_node: start.row,
            end_node: end.row,
            level: Some(level),
            vehicle_types: &vehicle_types,
            ..NewPath::default()
        })?;
        if let Some(read) = read {
            let text = || {
                let (key, i) = curve.entry?;
                let entry = item.array_item(key, i);
                member(entry, 0, "trajectory").map(|range| &entry[range])
            };
            let ends = positions.map(Into::into);
            self.builder.keep_written_curve(row, read, ends, text)?;
        }
        Ok(Some(row))
    }

    fn between_levels(&self, start: &End<'_>, end: &End<'_>) -> String {
        let name = |end: &End<'_>| {
            let level = end
                .level
                .and_then(|l| self.builder.layout.levels.get(l as usize));
            level.map_or_else(String::new, |l| l.id.clone())
        };
        format!(
            "connects the layouts `{}` and `{}`; paths between levels are not drawn",
            name(start),
            name(end)
        )
    }

    fn set_properties(
        &mut self,
        row: usize,
        of_edge: &[ColumnCell<'_>],
        curve: &Curve<'_>,
        cells: &[Vec<ColumnCell<'_>>],
        at: PlaceFn<'_>,
    ) -> Result<(), ReadError> {
        for cell in of_edge {
            cell.set(self, Table::Paths, row)?;
        }
        let tables = [Table::Paths, Table::PathTypes];
        let first_entry = self.builder.layout.paths.vehicle_types().entries(row).start;
        let first_cells = cells.get(curve.first_cells).map_or(&[][..], Vec::as_slice);
        if curve.types.list.is_empty() {
            for cell in first_cells {
                cell.set(self, Table::Paths, row)?;
            }
        }
        self.set_type_cells(tables, row, first_entry, &curve.types.list, cells)?;
        let mut used = first_cells.iter();
        let is_line_guided = used.any(|cell| cell.column.starts_with(PHYSICAL_LINE));
        if is_line_guided && curve.trajectory.is_none() {
            let message =
                || "vehicles follow a physical line, whose shape the file does not contain".into();
            let remedy = "A straight line is drawn";
            self.builder
                .report(Code::ApproximateShape, at, message, remedy);
        }
        Ok(())
    }
}

/// Describes the missing end nodes of a straight line.
fn missing_ends(ends: [&End<'_>; 2]) -> String {
    let parts = ends.into_iter().zip(["start", "end"]);
    let parts = parts.filter(|(end, _)| end.row.is_none());
    let texts: Vec<String> = parts
        .map(|(end, which)| match end.name {
            Some(name) => format!("the {which} node `{name}` is unknown or has no position"),
            None => format!("the {which} node is missing"),
        })
        .collect();
    texts.join(", and ")
}

/// Returns the bits of all numbers of a trajectory, equal for equal curves; empty for the straight
/// line. Trajectories with other members are equal if their texts are.
fn curve_key<'t>(trajectory: Option<&Trajectory>, entry: impl Fn() -> &'t str) -> Vec<u64> {
    let Some(trajectory) = trajectory else {
        return Vec::new();
    };
    let number = |field: &Field<f64>| field.get().map_or(u64::MAX, |n| n.to_bits());
    let mut bits = vec![number(&trajectory.degree)];
    if trajectory.is_odd() {
        let entry = entry();
        let text = member(entry, 0, "trajectory").map(|range| &entry[range]);
        bits.extend(text.unwrap_or_default().bytes().map(u64::from));
    }
    bits.extend(items(&trajectory.knots).map(|(_, knot)| number(knot)));
    for (_, point) in items(&trajectory.points) {
        match point.get() {
            Some(p) => bits.extend([number(&p.x), number(&p.y), number(&p.weight)]),
            None => bits.push(u64::MAX),
        }
    }
    bits
}
