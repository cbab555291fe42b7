//! VDA 5050 mapper state: the layout under construction, and the lookups that nodes and edges
//! share.

use std::collections::HashMap;

use guideway_layout::{Code, Value};

use crate::ReadError;
use crate::builder::{Builder, PlaceFn, Table};
use crate::json::{Field, field_place};
use crate::node_rows::NodeRows;
use crate::source::Source;

/// Layout under construction from the records of an order.
pub(super) struct Mapper<'a> {
    pub(super) builder: Builder<'a>,
    /// Rows of nodes by identifier. An order may pass a node more than once.
    pub(super) nodes: NodeRows,
    /// Rows of nodes by `sequenceId`.
    pub(super) sequence: HashMap<u64, u32>,
    /// Levels by `mapId`.
    pub(super) maps: HashMap<String, u32>,
}

impl<'a> Mapper<'a> {
    /// Makes an empty layout for a file of `file_bytes` bytes.
    pub(super) fn new(source: Source<'a>, file_bytes: usize) -> Self {
        Self {
            builder: Builder::new(source, file_bytes),
            nodes: NodeRows::default(),
            sequence: HashMap::new(),
            maps: HashMap::new(),
        }
    }

    /// Returns a `sequenceId`; reports it if it is not an integer from 0.
    pub(super) fn sequence(&mut self, field: &Field<f64>, at: PlaceFn<'_>) -> Option<u64> {
        /// Integers up to 2^53 are exact in double precision.
        const MAX: f64 = (1_u64 << 53) as f64;
        let at: PlaceFn<'_> = &|| field_place(at, "sequenceId");
        self.builder.check_type(field, at, "an integer");
        let &number = field.get()?;
        if number.fract() == 0.0 && (0.0..=MAX).contains(&number) {
            return Some(number as u64);
        }
        let message = || format!("the sequenceId is {number:?}; expected an integer from 0");
        let remedy = "The value is ignored; correct the application that wrote the order";
        self.builder.report(Code::UnknownValue, at, message, remedy);
        None
    }

    /// Sets the column `sequenceId` of a row.
    pub(super) fn set_sequence(
        &mut self,
        table: Table,
        row: usize,
        sequence: Option<u64>,
    ) -> Result<(), ReadError> {
        match sequence {
            Some(number) => {
                let value = Value::Int(number as i64);
                self.builder.set(table, row, "sequenceId", value)
            }
            None => Ok(()),
        }
    }
}
