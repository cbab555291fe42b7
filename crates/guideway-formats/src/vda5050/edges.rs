//! VDA 5050 edges: maps an edge of an order to a path.

use std::borrow::Cow;

use guideway_layout::{Code, NewPath, Severity};
use guideway_spline::Runs;

use super::mapper::Mapper;
use super::model::Edge;
use crate::ReadError;
use crate::builder::{PlaceFn, Table};
use crate::json::{Field, OtherMembers, field_place};

/// A node at an end of an edge.
struct End {
    /// Description of the node for messages; empty if the order names none.
    name: String,
    row: Option<u32>,
    level: Option<u32>,
    /// True for a node of the order that has no position.
    is_unplaced: bool,
}

impl Mapper<'_> {
    /// Maps an edge to a path, or to a refused path.
    pub(super) fn map_edge(
        &mut self,
        edge: &Field<Edge<'_>>,
        at: PlaceFn<'_>,
    ) -> Result<(), ReadError> {
        let Some(edge) = self.builder.record(edge, at) else {
            let detail = "the edge is not an object";
            return self.builder.refuse(&at().element, Code::WrongType, detail);
        };
        self.builder.check_repeated(edge.repeated, at);
        let id = self.builder.id(&edge.id, at, "edgeId")?;
        let sequence = self.sequence(&edge.sequence, at);
        let before = sequence.and_then(|number| number.checked_sub(1));
        let after = sequence.map(|number| number + 1);
        let start = self.end(&edge.start, before, &id, &|| field_place(at, "startNodeId"))?;
        let end = self.end(&edge.end, after, &id, &|| field_place(at, "endNodeId"))?;
        if let (Some(from), Some(to)) = (start.level, end.level)
            && from != to
        {
            return self.refuse_between_levels(&id, from, to, at);
        }
        let mut runs = Runs::default();
        let mut read = None;
        let at_curve: PlaceFn<'_> = &|| field_place(at, "trajectory");
        self.builder
            .check_type(&edge.trajectory, at_curve, "an object");
        if let Some(trajectory) = edge.trajectory.get() {
            let builder = &mut self.builder;
            let curve = builder.append_trajectory(&trajectory.record, at_curve, &mut runs)?;
            read = Some((curve, trajectory.text));
        }
        let nodes = &self.builder.layout.nodes;
        let positions = start.row.zip(end.row);
        let positions = positions.map(|(from, to)| [from, to].map(|row| nodes.position_m(row)));
        if runs.is_empty() {
            let Some([from, to]) = positions else {
                return self.refuse_without_ends(&id, [&start, &end], at);
            };
            runs.push_line(from, to);
        }
        let row = self.builder.push_path(&NewPath {
            id: &id,
            runs: &runs,
            start_node: start.row,
            end_node: end.row,
            level: start.level.or(end.level),
            ..NewPath::default()
        })?;
        if let Some((curve, text)) = read {
            let mut rows = [start.row, end.row].into_iter().flatten();
            let is_derived = rows.any(|row| self.derived.contains(&row));
            let ends = positions.filter(|_| !is_derived);
            let builder = &mut self.builder;
            builder.keep_written_curve(row, curve, ends, || Some(text))?;
        }
        self.set_sequence(Table::Paths, row, sequence)?;
        let mut other = OtherMembers::default();
        self.set_members(Table::Paths, row, &edge.attributes, &mut other, at)?;
        self.set_other(Table::Paths, row, other)
    }

    /// Returns the node at an end: by `sequenceId`, else by identifier. An identifier beside a
    /// `sequenceId` only confirms it, because an identifier may have several positions.
    fn end(
        &mut self,
        field: &Field<Cow<'_, str>>,
        sequence: Option<u64>,
        edge: &str,
        at: PlaceFn<'_>,
    ) -> Result<End, ReadError> {
        let name = self.builder.text(field, at)?;
        let by_sequence = sequence.and_then(|number| self.sequence.get(&number).copied());
        let by_name = name.and_then(|name| self.nodes.get(&self.builder.layout.nodes, name));
        match (by_sequence, by_name, name) {
            (Some(row), _, Some(name)) => self.check_name(row, name, edge, at),
            (None, Some(_), Some(name)) if self.ambiguous.contains(name) => {
                let message =
                    || format!("`{edge}` needs the node `{name}`, which has several positions");
                let remedy = "The first one is used; give nodes and edges a sequenceId";
                let (severity, code) = (Severity::Error, Code::DuplicateId);
                self.builder.report_as(severity, code, at, message, remedy);
            }
            _ => {}
        }
        let row = by_sequence.or(by_name);
        let is_unplaced = row.is_none()
            && (sequence.is_some_and(|number| self.unplaced.sequence.contains(&number))
                || name.is_some_and(|name| self.unplaced.ids.contains(name)));
        let name = match (name, sequence) {
            (Some(name), _) => format!("`{name}`"),
            (None, Some(number)) => format!("with sequenceId {number}"),
            (None, None) => String::new(),
        };
        match (row, name.is_empty()) {
            (Some(_), _) => {}
            _ if is_unplaced => {}
            (None, true) => self.builder.report_missing(at, "the identifier of a node"),
            (None, false) => {
                let message = || format!("`{edge}` needs the node {name}, which does not exist");
                let remedy = "Add the node with its position, or correct the name";
                self.builder.report(Code::UnknownNode, at, message, remedy);
            }
        }
        let level = row.and_then(|row| self.builder.layout.nodes.level(row));
        Ok(End {
            name,
            row,
            level,
            is_unplaced,
        })
    }

    /// Reports an identifier that is not that of the node at the place in the order.
    fn check_name(&mut self, row: u32, name: &str, edge: &str, at: PlaceFn<'_>) {
        let id = self.builder.layout.nodes.id(row);
        if id == name {
            return;
        }
        let id = id.to_owned();
        let message =
            || format!("`{edge}` names the node `{name}`, but by sequenceId the node is `{id}`");
        let remedy = "The sequenceId decides; correct the application that wrote the order";
        self.builder.report(Code::UnknownValue, at, message, remedy);
    }

    /// Refuses a straight line of which an end is unknown.
    fn refuse_without_ends(
        &mut self,
        id: &str,
        ends: [&End; 2],
        at: PlaceFn<'_>,
    ) -> Result<(), ReadError> {
        let detail = missing_ends(ends);
        let mut missing = ends.into_iter().filter(|end| end.row.is_none());
        if missing.all(|end| end.is_unplaced) {
            let remedy = "The format allows it; give the nodes positions or the edge a trajectory";
            let builder = &mut self.builder;
            return builder.refuse_at(id, Code::NotDrawn, &detail, at, remedy);
        }
        self.builder.refuse(id, Code::UnknownNode, &detail)
    }

    fn refuse_between_levels(
        &mut self,
        id: &str,
        from: u32,
        to: u32,
        at: PlaceFn<'_>,
    ) -> Result<(), ReadError> {
        let levels = &self.builder.layout.levels;
        let [from, to] = [from, to].map(|level| &levels[level as usize].id);
        let detail =
            format!("connects the maps `{from}` and `{to}`; paths between levels are not drawn");
        let remedy = "A lift is not drawn; else correct the mapId of the node";
        let builder = &mut self.builder;
        builder.refuse_at(id, Code::CrossLevel, &detail, at, remedy)
    }
}

/// Describes the missing end nodes of a straight line.
fn missing_ends(ends: [&End; 2]) -> String {
    let missing = ends.into_iter().zip(["start", "end"]);
    let missing = missing.filter(|(end, _)| end.row.is_none());
    let texts: Vec<String> = missing
        .map(|(end, which)| match (end.name.as_str(), end.is_unplaced) {
            ("", _) => format!("the {which} node is missing"),
            (name, true) => format!("the {which} node {name} has no position"),
            (name, false) => format!("the {which} node {name} is unknown"),
        })
        .collect();
    texts.join(", and ")
}
