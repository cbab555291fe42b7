//! VDA 5050 mapper state: the layout under construction, the lookups that nodes and edges share,
//! and the conversion of members to columns.

use std::collections::{HashMap, HashSet};

use guideway_layout::{Code, Value};
use guideway_spline::Point;

use super::members::{OTHER, REFERENCE_POINT, SEQUENCE};
use super::version::Version;
use crate::ReadError;
use crate::builder::{Builder, PlaceFn, Table};
use crate::json::{Attributes, Cell, CellResult, Field, OtherMembers, field_place};
use crate::node_rows::NodeRows;
use crate::source::Source;

/// Layout under construction from the records of an order.
pub(super) struct Mapper<'a> {
    pub(super) builder: Builder<'a>,
    pub(super) version: Version,
    /// Rows of nodes by identifier. An order may pass a node more than once.
    pub(super) nodes: NodeRows,
    /// Rows of nodes of earlier orders by identifier.
    pub(super) earlier: NodeRows,
    /// First row of the nodes of this order.
    first_node: u32,
    /// Identifiers that have several positions.
    pub(super) ambiguous: HashSet<String>,
    /// Rows of nodes by `sequenceId`.
    pub(super) sequence: HashMap<u64, u32>,
    /// Levels by `mapId`.
    pub(super) maps: HashMap<String, u32>,
    /// Further passes of a node, as JSON.
    pub(super) passes: HashMap<u32, Vec<String>>,
    /// Nodes whose position is the end of a trajectory.
    pub(super) derived: HashSet<u32>,
    pub(super) unplaced: Unplaced,
}

/// Nodes that have no position, and no trajectory that leads to them.
#[derive(Default)]
pub(super) struct Unplaced {
    pub(super) ids: HashSet<String>,
    pub(super) sequence: HashSet<u64>,
}

/// Ends of trajectories, which are positions of nodes that have none.
#[derive(Default)]
pub(super) struct TrajectoryEnds<'r> {
    pub(super) by_sequence: HashMap<u64, Point<f64>>,
    pub(super) by_id: HashMap<&'r str, Point<f64>>,
}

impl<'a> Mapper<'a> {
    /// Makes an empty layout for a file of `file_bytes` bytes.
    pub(super) fn new(source: Source<'a>, file_bytes: usize, version: Version) -> Self {
        Self {
            builder: Builder::new(source, file_bytes),
            version,
            nodes: NodeRows::default(),
            earlier: NodeRows::default(),
            first_node: 0,
            ambiguous: HashSet::new(),
            sequence: HashMap::new(),
            maps: HashMap::new(),
            passes: HashMap::new(),
            derived: HashSet::new(),
            unplaced: Unplaced::default(),
        }
    }

    /// Begins an order: its identifiers and numbers are its own. A node of an earlier order at the
    /// same place is the same node.
    pub(super) fn begin_order(&mut self) {
        let nodes = &self.builder.layout.nodes;
        for row in self.first_node..nodes.len() as u32 {
            self.earlier.insert(nodes, row);
        }
        self.first_node = nodes.len() as u32;
        self.nodes = NodeRows::default();
        self.ambiguous.clear();
        self.sequence.clear();
        self.unplaced = Unplaced::default();
    }

    /// Returns a `sequenceId`; reports it if it is not an integer from 0.
    pub(super) fn sequence(&mut self, field: &Field<f64>, at: PlaceFn<'_>) -> Option<u64> {
        let at: PlaceFn<'_> = &|| field_place(at, SEQUENCE);
        self.builder.check_type(field, at, "an integer");
        let &number = field.get()?;
        let sequence = whole(number);
        if sequence.is_none() {
            let message = || format!("the sequenceId is {number:?}; expected an integer from 0");
            let remedy = "The value is ignored; correct the application that wrote the order";
            self.builder.report(Code::UnknownValue, at, message, remedy);
        }
        sequence
    }

    /// Sets the column of the `sequenceId` of a row.
    pub(super) fn set_sequence(
        &mut self,
        table: Table,
        row: usize,
        sequence: Option<u64>,
    ) -> Result<(), ReadError> {
        match sequence {
            Some(number) => {
                let value = Value::Int(number as i64);
                self.builder.set(table, row, SEQUENCE, value)
            }
            None => Ok(()),
        }
    }

    /// Sets the members of an object as columns of a row. Members that the format does not define,
    /// and values of another type, are added to `other`.
    pub(super) fn set_members(
        &mut self,
        table: Table,
        row: usize,
        attributes: &Attributes<'_>,
        other: &mut OtherMembers,
        at: PlaceFn<'_>,
    ) -> Result<(), ReadError> {
        let mut done: Vec<&'static str> = Vec::new();
        for field in attributes.iter() {
            let member = self.version.member_of_any(field.name);
            let result = match member {
                Some(member) => self.builder.cell(field, member.kind, at)?,
                None => CellResult::Unfit,
            };
            match (member, result) {
                (Some(member), CellResult::Cell(cell)) if !done.contains(&member.column) => {
                    done.push(member.column);
                    match (member.quantity, &cell) {
                        (Some(quantity), Cell::Number(number)) => {
                            let attributes = self.builder.attributes(table);
                            attributes.set_quantity(row, member.column, *number, quantity);
                        }
                        (_, Cell::Text(text))
                            if member.name == REFERENCE_POINT && text == "KINEMATIC_CENTER" =>
                        {
                            let value = Value::Text("KINEMATICCENTER");
                            self.builder.set(table, row, member.column, value)?;
                        }
                        (_, cell) => {
                            self.builder.set(table, row, member.column, cell.value())?;
                        }
                    }
                }
                (_, CellResult::Absent) => {}
                _ => match field.name.split_once('.') {
                    Some((group, name)) => other.add(Some(group), name, field.text),
                    None => other.add(None, field.name, field.text),
                },
            }
        }
        attributes.add_other(other);
        Ok(())
    }

    /// Sets the members that the format does not define.
    pub(super) fn set_other(
        &mut self,
        table: Table,
        row: usize,
        other: OtherMembers,
    ) -> Result<(), ReadError> {
        let Some(text) = other.into_text() else {
            return Ok(());
        };
        self.builder.check_text(&text)?;
        self.builder.set(table, row, OTHER, Value::Json(&text))
    }
}

/// Returns a whole number from 0 on.
pub(super) fn whole(number: f64) -> Option<u64> {
    /// Integers up to 2^53 are exact in double precision.
    const MAX: f64 = (1_u64 << 53) as f64;
    let is_whole = number.fract() == 0.0 && (0.0..=MAX).contains(&number);
    is_whole.then_some(number as u64)
}
