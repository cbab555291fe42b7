//! Node rows: positions, levels and vehicle types of the nodes.

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
}

impl<'a> NodeRows<'a> {
    pub(super) fn new(reading: Reading<'a>) -> Self {
        Self {
            rows: ElementRows::new(Element::Node, reading, &[Role::X, Role::Y]),
            levels: LevelColumn::new(reading, 0),
            types: TypeLists::new(reading),
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
        for row in 0..rows.len() {
            let id = rows.ids.get(row);
            let position = [Role::X, Role::Y].map(|role| rows.number(role, row));
            let remedy = "The node is left out; write its position in meters";
            let position = faults.position(Element::Node, id, position, remedy);
            match position {
                Some(_) => kept.push(row),
                None => missing.push(row as u32),
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
        Ok((nodes, Numbering::new(missing, count)))
    }
}
