//! Node rows: positions, levels and vehicle types of the nodes.

use std::iter;
use std::ops::Range;

use guideway_layout::Nodes;
use guideway_spline::Point;

use super::element_rows::ElementRows;
use super::faults::Faults;
use crate::Problem;
use crate::arrow::batch::Batch;
use crate::arrow::element::Element;
use crate::arrow::level_column::{LevelColumn, Levels, level_at};
use crate::arrow::numbering::Numbering;
use crate::arrow::reading::Reading;
use crate::arrow::schema::Role;
use crate::arrow::type_lists::TypeLists;

/// Nodes under construction.
pub(super) struct NodeRows<'a> {
    rows: ElementRows<'a>,
    levels: Option<LevelColumn<'a>>,
    types: Option<TypeLists>,
    /// Numbers of the nodes that were not read.
    skipped: Vec<Range<u32>>,
}

impl<'a> NodeRows<'a> {
    pub(super) fn new(reading: Reading<'a>) -> Self {
        Self {
            rows: ElementRows::new(Element::Node, reading, &[Role::X, Role::Y]),
            levels: LevelColumn::new(reading, 0),
            types: TypeLists::new(reading),
            skipped: Vec::new(),
        }
    }

    /// Counts nodes that are not read.
    pub(super) fn skip(&mut self, count: u32) {
        let skipped: u32 = self
            .skipped
            .iter()
            .map(|numbers| numbers.len() as u32)
            .sum();
        let start = (self.rows.len() as u32).saturating_add(skipped);
        let end = start.saturating_add(count);
        match self.skipped.last_mut() {
            Some(last) if last.end == start => last.end = end,
            _ if start < end => self.skipped.push(start..end),
            _ => {}
        }
    }

    pub(super) fn add(&mut self, batch: &Batch) -> Result<(), Problem> {
        self.rows.add(batch)?;
        if let Some(levels) = &mut self.levels {
            levels.add(batch)?;
        }
        match &mut self.types {
            Some(types) => types.add(batch),
            None => Ok(()),
        }
    }

    /// Returns the nodes, and their rows by their numbers: one without a position is left out.
    pub(super) fn finish(
        self,
        levels: &mut Levels,
        faults: &mut Faults<'_>,
    ) -> Result<(Nodes, Numbering), Problem> {
        let rows = self.rows.finish(faults.diagnostics)?;
        let of_nodes = self.levels;
        let of_nodes = of_nodes.map(|column| column.finish(levels, "nodes", faults.diagnostics));
        let mut nodes = Nodes::default();
        let (mut kept, mut missing) = (Vec::new(), Vec::new());
        let numbers = read_numbers(&self.skipped);
        for (row, number) in (0..rows.len()).zip(numbers) {
            let id = rows.ids.get(row);
            let position = [Role::X, Role::Y].map(|role| rows.number(role, row));
            let remedy = "The node is left out; write its position in meters";
            let position = faults.position(Element::Node, id, position, remedy);
            match position {
                Some(_) => kept.push(row),
                None => missing.push(number),
            }
            let position = position.unwrap_or(Point::new(0.0, 0.0));
            nodes.push(id, position, level_at(of_nodes.as_ref(), row));
        }
        if let Some(types) = self.types {
            *nodes.vehicle_types_mut() = types.finish(faults.diagnostics);
        }
        nodes.attributes = rows.into_attributes(faults.diagnostics);
        if !missing.is_empty() {
            nodes = nodes.select(&kept);
        }
        let count = nodes.len();
        Ok((nodes, Numbering::new(missing, self.skipped, count)))
    }
}

/// The numbers between those that were not read; a number that no row has beyond those of 32 bits.
fn read_numbers(skipped: &[Range<u32>]) -> impl Iterator<Item = u32> + use<> {
    let starts = [0]
        .into_iter()
        .chain(skipped.iter().map(|numbers| numbers.end));
    let ends = skipped.iter().map(|numbers| numbers.start);
    let ranges: Vec<_> = starts.zip(ends.chain([u32::MAX])).collect();
    let numbers = ranges.into_iter().flat_map(|(start, end)| start..end);
    numbers.chain(iter::repeat(u32::MAX))
}
