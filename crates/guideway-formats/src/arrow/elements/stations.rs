//! Station rows: positions, nodes and levels of the stations.

use guideway_layout::{Code, Stations};

use super::element_rows::ElementRows;
use super::faults::Faults;
use crate::Problem;
use crate::arrow::batch::Batch;
use crate::arrow::element::Element;
use crate::arrow::level_column::{LevelColumn, Levels, level_at};
use crate::arrow::list_array::IndexLists;
use crate::arrow::numbering::Numbering;
use crate::arrow::reading::Reading;
use crate::arrow::schema::Role;

/// Stations under construction.
pub(super) struct StationRows<'a> {
    rows: ElementRows<'a>,
    levels: Option<LevelColumn<'a>>,
    index: Option<usize>,
    /// Numbers of the nodes of each station; `u32::MAX` for one that is no number.
    nodes: Vec<Vec<u32>>,
}

impl<'a> StationRows<'a> {
    pub(super) fn new(reading: Reading<'a>) -> Self {
        Self {
            rows: ElementRows::new(Element::Station, reading, &[Role::X, Role::Y]),
            levels: LevelColumn::new(reading, 0),
            index: reading.columns.get(Role::Nodes),
            nodes: Vec::new(),
        }
    }

    pub(super) fn add(&mut self, batch: &Batch) -> Result<(), Problem> {
        self.rows.add(batch)?;
        if let Some(levels) = &mut self.levels {
            levels.add(batch)?;
        }
        let Some(index) = self.index else {
            self.nodes
                .resize(self.nodes.len() + batch.drawn_rows(), Vec::new());
            return Ok(());
        };
        let lists = IndexLists::new(&batch.columns[index])?;
        for row in batch.drawn.iter().cloned().flatten() {
            let nodes = lists.get(row).map(|node| node.unwrap_or(u32::MAX));
            self.nodes.push(nodes.collect());
        }
        Ok(())
    }

    /// Returns the stations. `nodes` has the rows of the nodes by their numbers.
    pub(super) fn finish(
        self,
        nodes: &Numbering,
        levels: &mut Levels,
        faults: &mut Faults<'_>,
    ) -> Result<Stations, Problem> {
        let rows = self.rows.finish(faults.diagnostics)?;
        let of_stations = self.levels;
        let of_stations =
            of_stations.map(|column| column.finish(levels, "stations", faults.diagnostics));
        let mut stations = Stations::default();
        for (row, numbers) in self.nodes.into_iter().enumerate() {
            let id = rows.ids.get(row);
            let remedy = "The station is read without a position; write both coordinates or none";
            let position = match [Role::X, Role::Y].map(|role| rows.number(role, row)) {
                [None, None] => None,
                position => faults.position(Element::Station, id, position, remedy),
            };
            let count = numbers.iter().filter(|&&n| !nodes.is_skipped(n)).count();
            let known: Vec<u32> = numbers.into_iter().filter_map(|n| nodes.row(n)).collect();
            if known.len() < count {
                let unknown = count - known.len();
                faults.report(
                    Code::UnknownNode,
                    Element::Station,
                    id,
                    || format!("{unknown} of its nodes are not in the table"),
                    "They are left out; write the number of a row of the kind node, from 0",
                );
            }
            stations.push(id, position, known, level_at(of_stations.as_ref(), row));
        }
        stations.attributes = rows.into_attributes(faults.diagnostics);
        Ok(stations)
    }
}
