//! Network columns: nodes, direction, vehicle types and written curves of the paths.

use arrow_array::Array;
use guideway_layout::{Code, Diagnostics, Direction, Paths, Place};

use super::batch::Batch;
use super::column_names::{BOTH, DIRECTION, END_NODE, FORWARD, START_NODE};
use super::list_array::indices;
use super::numbering::Numbering;
use super::reading::Reading;
use super::schema::Role;
use super::text_array::TextArray;
use super::type_lists::TypeLists;
use super::written_curves::CurveColumn;
use crate::Problem;

/// Number that means "no node".
const NONE: u32 = u32::MAX;

/// Network of the paths under construction.
pub(super) struct NetworkColumns<'a> {
    start_nodes: Option<NodeColumn>,
    end_nodes: Option<NodeColumn>,
    directions: Option<DirectionColumn>,
    types: Option<TypeLists>,
    curves: Option<CurveColumn<'a>>,
}

/// Numbers of nodes.
struct NodeColumn {
    index: usize,
    name: &'static str,
    values: Vec<u32>,
    /// Number of values that are no row number.
    invalid: u64,
}

struct DirectionColumn {
    index: usize,
    values: Vec<Direction>,
    /// Number of texts that are no direction.
    unknown: u64,
}

impl<'a> NetworkColumns<'a> {
    /// Makes the columns with capacity for an estimated number of rows.
    pub(super) fn new(reading: Reading<'a>, rows: usize) -> Self {
        let nodes = |role, name| {
            Some(NodeColumn {
                index: reading.columns.get(role)?,
                name,
                values: Vec::with_capacity(rows),
                invalid: 0,
            })
        };
        let directions = reading.columns.get(Role::Direction);
        Self {
            start_nodes: nodes(Role::StartNode, START_NODE),
            end_nodes: nodes(Role::EndNode, END_NODE),
            directions: directions.map(|index| DirectionColumn {
                index,
                values: Vec::with_capacity(rows),
                unknown: 0,
            }),
            types: TypeLists::new(reading),
            curves: CurveColumn::new(reading),
        }
    }

    /// Appends the drawn rows of a batch.
    pub(super) fn add(&mut self, batch: &Batch) -> Result<(), Problem> {
        for nodes in [&mut self.start_nodes, &mut self.end_nodes]
            .into_iter()
            .flatten()
        {
            nodes.add(batch)?;
        }
        if let Some(directions) = &mut self.directions {
            directions.add(batch)?;
        }
        if let Some(types) = &mut self.types {
            types.add(batch)?;
        }
        if let Some(curves) = &mut self.curves {
            curves.add(batch)?;
        }
        Ok(())
    }

    /// Sets the columns of the paths. `nodes` has the rows of the nodes by their numbers.
    pub(super) fn finish(
        self,
        paths: &mut Paths,
        nodes: &Numbering,
        diagnostics: &mut Diagnostics,
    ) {
        let mut rows = |column: Option<NodeColumn>| column.map(|c| c.finish(nodes, diagnostics));
        let (starts, ends) = (rows(self.start_nodes), rows(self.end_nodes));
        if starts.is_some() || ends.is_some() {
            let node = |rows: &Option<Vec<u32>>, path: usize| {
                let row = rows.as_ref().map_or(NONE, |rows| rows[path]);
                Some(row).filter(|&row| row != NONE)
            };
            for path in 0..paths.len() {
                paths.set_nodes(path, node(&starts, path), node(&ends, path));
            }
        }
        if let Some(directions) = self.directions {
            directions.finish(paths, diagnostics);
        }
        if let Some(types) = self.types {
            *paths.vehicle_types_mut() = types.finish(diagnostics);
        }
        if let Some(curves) = self.curves {
            curves.finish(paths, diagnostics);
        }
    }
}

impl NodeColumn {
    fn add(&mut self, batch: &Batch) -> Result<(), Problem> {
        let column = &batch.columns[self.index];
        let numbers = indices(column)?;
        let first = self.values.len();
        batch.extend(&mut self.values, &numbers, |node| node.unwrap_or(NONE));
        // A number that does not fit is null after the cast.
        let rows = batch.drawn.iter().cloned().flatten();
        let missing = rows
            .zip(&self.values[first..])
            .filter(|(_, node)| **node == NONE);
        self.invalid += missing.filter(|(row, _)| column.is_valid(*row)).count() as u64;
        Ok(())
    }

    /// Returns the rows of the nodes.
    fn finish(mut self, nodes: &Numbering, diagnostics: &mut Diagnostics) -> Vec<u32> {
        for value in self.values.iter_mut().filter(|value| **value != NONE) {
            let number = *value;
            *value = nodes.row(number).unwrap_or(NONE);
            self.invalid += u64::from(*value == NONE && !nodes.is_skipped(number));
        }
        if self.invalid > 0 {
            diagnostics.push(
                Code::UnknownNode,
                || Place::element(format!("column {}", self.name)),
                || {
                    format!(
                        "{} paths name a node that the table does not have",
                        self.invalid
                    )
                },
                "They are read without it; write the number of a row of the kind node, from 0",
            );
        }
        self.values
    }
}

impl DirectionColumn {
    fn add(&mut self, batch: &Batch) -> Result<(), Problem> {
        let texts = TextArray::new(&batch.columns[self.index])?;
        for row in batch.drawn.iter().cloned().flatten() {
            self.values.push(match texts.get(row) {
                None | Some(FORWARD) => Direction::Forward,
                Some(BOTH) => Direction::Both,
                Some(_) => {
                    self.unknown += 1;
                    Direction::Forward
                }
            });
        }
        Ok(())
    }

    fn finish(self, paths: &mut Paths, diagnostics: &mut Diagnostics) {
        for (path, &direction) in self.values.iter().enumerate() {
            paths.set_direction(path, direction);
        }
        if self.unknown > 0 {
            diagnostics.push(
                Code::UnknownValue,
                || Place::element(format!("column {DIRECTION}")),
                || format!("{} values are neither {FORWARD} nor {BOTH}", self.unknown),
                "The paths are read as one-way; correct the values",
            );
        }
    }
}
