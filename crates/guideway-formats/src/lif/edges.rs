//! LIF edges: maps an edge to paths, one per distinct curve, because vehicle types may have curves
//! of their own.

use std::borrow::Cow;
use std::collections::{HashMap, HashSet};

use guideway_layout::{Code, NewPath};
use guideway_spline::{Point, Runs};

use super::mapper::Mapper;
use super::model::{EDGE_PROPERTIES, Edge, EdgeProperties, PHYSICAL_LINE};
use crate::ReadError;
use crate::builder::{PlaceFn, Table};
use crate::json::{Field, field_place, items};
use crate::trajectory::Trajectory;

/// A curve of an edge, with the vehicle types that follow it.
struct Curve<'r, 'a> {
    /// `None` for the straight line between the nodes.
    trajectory: Option<&'r Trajectory>,
    /// Key and index of its first entry; `None` if the edge has no entry.
    entry: Option<(&'static str, usize)>,
    types: Vec<String>,
    properties: Vec<&'r EdgeProperties<'a>>,
}

/// A node that an edge refers to.
struct End<'r> {
    name: Option<&'r str>,
    row: Option<u32>,
    position: Option<Point<f64>>,
    level: Option<u32>,
}

impl Curve<'_, '_> {
    /// Removes repeated types: a vehicle type may have several entries.
    fn deduplicate_types(&mut self) {
        if self.types.len() < 2 {
            return;
        }
        let mut seen = HashSet::new();
        self.types.retain(|name| seen.insert(name.clone()));
    }
}

impl Mapper<'_> {
    /// Maps an edge to paths, or to refused paths.
    pub(super) fn map_edge(
        &mut self,
        edge: &Field<Edge<'_>>,
        level: u32,
        at: PlaceFn<'_>,
    ) -> Result<(), ReadError> {
        let Some(edge) = self.builder.record(edge, at) else {
            self.counts.edges += 1;
            let detail = "the edge is not an object";
            return self.builder.refuse(&at().element, Code::WrongType, detail);
        };
        self.builder.check_repeated(edge.repeated, at);
        let id = self.builder.id(&edge.id, at, "edgeId")?;
        self.counts.edges += 1;
        let start = self.end(&edge.start, &id, level, &|| field_place(at, "startNodeId"))?;
        let end = self.end(&edge.end, &id, level, &|| field_place(at, "endNodeId"))?;
        let curves = self.curves(edge, at)?;
        let is_single = curves.len() == 1;
        for (i, curve) in curves.iter().enumerate() {
            let name = match (is_single, curve.types.as_slice()) {
                (true, _) => Cow::Borrowed(id.as_ref()),
                (false, []) => format!("{id} [{}]", i + 1).into(),
                (false, types) => format!("{id} [{}]", types.join(", ")).into(),
            };
            let at_curve: PlaceFn<'_> = &|| match curve.entry {
                Some((key, i)) => field_place(at, &format!("{key}[{i}]")),
                None => at(),
            };
            self.map_curve(&name, curve, [&start, &end], level, at_curve)?;
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
    /// straight line.
    fn curves<'r, 'a>(
        &mut self,
        edge: &'r Edge<'a>,
        at: PlaceFn<'_>,
    ) -> Result<Vec<Curve<'r, 'a>>, ReadError> {
        let mut curves: Vec<Curve<'r, 'a>> = Vec::new();
        let mut index_by_curve: HashMap<Vec<u64>, usize> = HashMap::new();
        let lists = [
            (EDGE_PROPERTIES[0], &edge.types_1),
            (EDGE_PROPERTIES[1], &edge.types_2),
        ];
        let is_alone = lists
            .iter()
            .map(|(_, list)| items(list).len())
            .sum::<usize>()
            < 2;
        for (key, list) in lists {
            self.builder.check_array(list, at, key);
            for (i, field) in items(list) {
                let at_entry: PlaceFn<'_> = &|| field_place(at, &format!("{key}[{i}]"));
                let Some(entry) = self.builder.record(field, at_entry) else {
                    continue;
                };
                self.builder.check_repeated(entry.repeated, at_entry);
                let types =
                    self.vehicle_types(&entry.vehicle_type, &entry.robot_types, at_entry)?;
                let at_curve: PlaceFn<'_> = &|| field_place(at_entry, "trajectory");
                self.builder
                    .check_type(&entry.trajectory, at_curve, "an object");
                let trajectory = entry.trajectory.get().map(AsRef::as_ref);
                if trajectory.is_some() {
                    self.counts.trajectories += 1;
                }
                let index = match is_alone {
                    true => 0,
                    false => *index_by_curve
                        .entry(curve_key(trajectory))
                        .or_insert(curves.len()),
                };
                if index == curves.len() {
                    curves.push(Curve {
                        trajectory,
                        entry: Some((key, i)),
                        types: Vec::new(),
                        properties: Vec::new(),
                    });
                }
                curves[index].types.extend(types);
                curves[index].properties.push(entry);
            }
        }
        curves.iter_mut().for_each(Curve::deduplicate_types);
        if curves.is_empty() {
            self.builder.report_missing(
                &|| field_place(at, lists[0].0),
                "an entry for a vehicle type",
            );
            curves.push(Curve {
                trajectory: None,
                entry: None,
                types: Vec::new(),
                properties: Vec::new(),
            });
        }
        Ok(curves)
    }

    fn map_curve(
        &mut self,
        name: &str,
        curve: &Curve<'_, '_>,
        ends: [&End<'_>; 2],
        level: u32,
        at: PlaceFn<'_>,
    ) -> Result<(), ReadError> {
        let [start, end] = ends;
        if start.row.is_some() && end.row.is_some() && start.level != end.level {
            let detail = self.between_levels(start, end);
            let detail = format!("`{name}` {detail}");
            let remedy = "A lift is not drawn; else move the node to the other layout";
            let builder = &mut self.builder;
            return builder.refuse_at(name, Code::CrossLevel, &detail, at, remedy);
        }
        let mut runs = Runs::default();
        if let Some(trajectory) = curve.trajectory {
            let at_curve: PlaceFn<'_> = &|| field_place(at, "trajectory");
            self.builder
                .append_trajectory(trajectory, at_curve, &mut runs)?;
        }
        if runs.is_empty() {
            let (Some(from), Some(to)) = (start.position, end.position) else {
                let detail = missing_ends(ends);
                return self.builder.refuse(name, Code::UnknownNode, &detail);
            };
            runs.push_line(from, to);
        }
        let vehicle_types: Vec<&str> = curve.types.iter().map(String::as_str).collect();
        let row = self.builder.push_path(&NewPath {
            id: name,
            runs: &runs,
            start_node: start.row,
            end_node: end.row,
            level: Some(level),
            vehicle_types: &vehicle_types,
            ..NewPath::default()
        })?;
        self.set_attributes(row, curve, at)
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

    fn set_attributes(
        &mut self,
        row: usize,
        curve: &Curve<'_, '_>,
        at: PlaceFn<'_>,
    ) -> Result<(), ReadError> {
        let Some((first, others)) = curve.properties.split_first() else {
            return Ok(());
        };
        self.builder
            .set_attributes(Table::Paths, row, &first.attributes, at)?;
        let differs = others.iter().any(|p| p.attributes != first.attributes);
        if differs {
            let message = || "vehicle types share this curve but differ in attributes".to_owned();
            let remedy = "The attributes of the first vehicle type are used";
            self.builder.report(Code::Attribute, at, message, remedy);
        }
        let line_guided = first
            .attributes
            .iter()
            .any(|(n, _)| n.starts_with(PHYSICAL_LINE));
        if line_guided && curve.trajectory.is_none() {
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
/// line.
fn curve_key(trajectory: Option<&Trajectory>) -> Vec<u64> {
    let Some(trajectory) = trajectory else {
        return Vec::new();
    };
    let number = |field: &Field<f64>| field.get().map_or(u64::MAX, |n| n.to_bits());
    let mut bits = vec![number(&trajectory.degree)];
    bits.extend(items(&trajectory.knots).map(|(_, knot)| number(knot)));
    for (_, point) in items(&trajectory.points) {
        match point.get() {
            Some(p) => bits.extend([number(&p.x), number(&p.y), number(&p.weight)]),
            None => bits.push(u64::MAX),
        }
    }
    bits
}
