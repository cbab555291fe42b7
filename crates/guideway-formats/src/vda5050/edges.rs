//! VDA 5050 edges: maps an edge of an order to a path.

use std::borrow::Cow;

use guideway_layout::{Code, NewPath};
use guideway_spline::Runs;

use super::mapper::Mapper;
use super::model::Edge;
use crate::ReadError;
use crate::builder::{PlaceFn, Table};
use crate::json::{Field, field_place};

/// A node at an end of an edge.
struct End {
    /// Description of the node for messages; empty if the order names none.
    name: String,
    row: Option<u32>,
    level: Option<u32>,
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
        let at_curve: PlaceFn<'_> = &|| field_place(at, "trajectory");
        self.builder
            .check_type(&edge.trajectory, at_curve, "an object");
        if let Some(trajectory) = edge.trajectory.get() {
            self.builder
                .append_trajectory(trajectory, at_curve, &mut runs)?;
        }
        if runs.is_empty() {
            let (Some(from), Some(to)) = (start.row, end.row) else {
                let detail = missing_ends([&start, &end]);
                return self.builder.refuse(&id, Code::UnknownNode, &detail);
            };
            let nodes = &self.builder.layout.nodes;
            runs.push_line(nodes.position_m(from), nodes.position_m(to));
        }
        let row = self.builder.push_path(&NewPath {
            id: &id,
            runs: &runs,
            start_node: start.row,
            end_node: end.row,
            level: start.level.or(end.level),
            ..NewPath::default()
        })?;
        self.set_sequence(Table::Paths, row, sequence)?;
        self.builder
            .set_attributes(Table::Paths, row, &edge.attributes)
    }

    /// Returns the node at an end: by identifier if the edge has one, else by `sequenceId`.
    fn end(
        &mut self,
        field: &Field<Cow<'_, str>>,
        sequence: Option<u64>,
        edge: &str,
        at: PlaceFn<'_>,
    ) -> Result<End, ReadError> {
        let name = self.builder.text(field, at)?;
        let row_of = |name| self.nodes.get(&self.builder.layout.nodes, name);
        let (name, row) = match (name, sequence) {
            (Some(name), _) => (format!("`{name}`"), row_of(name)),
            (None, Some(number)) => {
                let row = self.sequence.get(&number).copied();
                (format!("with sequenceId {number}"), row)
            }
            (None, None) => (String::new(), None),
        };
        match (row, name.is_empty()) {
            (Some(_), _) => {}
            (None, true) => self.builder.report_missing(at, "the identifier of a node"),
            (None, false) => {
                let message = || {
                    format!(
                        "`{edge}` needs the node {name}, which does not exist or has no position"
                    )
                };
                let remedy = "Add the node with its position, or correct the name";
                self.builder.report(Code::UnknownNode, at, message, remedy);
            }
        }
        let level = row.and_then(|row| self.builder.layout.nodes.level(row));
        Ok(End { name, row, level })
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
        .map(|(end, which)| match end.name.as_str() {
            "" => format!("the {which} node is missing"),
            name => format!("the {which} node {name} is unknown or has no position"),
        })
        .collect();
    texts.join(", and ")
}
