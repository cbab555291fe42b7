//! Performs a fix.

use guideway_layout::Direction;
use guideway_scene::EditError;

use super::Fix;
use crate::document::Document;
use crate::edit::{NewEdge, OperationError, ShapeError};

/// The reason why a fix changes nothing.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FixError {
    /// The scene rejects the edit.
    #[error(transparent)]
    Edit(#[from] EditError),
    /// The document refuses the operation.
    #[error(transparent)]
    Operation(#[from] OperationError),
    /// The curves cannot be changed so.
    #[error(transparent)]
    Shape(#[from] ShapeError),
}

impl Document {
    /// Performs a fix as one undoable step.
    ///
    /// # Errors
    /// When an element has gone since the fix was proposed, or the edit is refused; the document
    /// is unchanged.
    pub fn fix(&mut self, fix: &Fix) -> Result<(), FixError> {
        match fix {
            Fix::AttachEnds(paths) => self.attach_ends(paths)?,
            Fix::Weld { paths, tolerance_m } => {
                self.weld(paths, *tolerance_m)?;
            }
            Fix::Connect { nodes, like } => {
                let types = like.map(|path| self.layout().paths.vehicle_types().of(path as usize));
                let vehicle_types = types.into_iter().flatten().map(str::to_owned).collect();
                self.create_edge(&NewEdge {
                    start_node: nodes[0],
                    end_node: nodes[1],
                    direction: Direction::Both,
                    vehicle_types,
                    attributes_of: *like,
                    ..NewEdge::default()
                })?;
            }
            Fix::MakeTwoWay(paths) => self.set_direction(paths, Direction::Both)?,
            Fix::Reverse(paths) => self.reverse(paths)?,
            Fix::Delete(elements) => self.delete(elements, true)?,
            Fix::Rename { element, id } => {
                let (of, row) = element.table_row();
                self.rename(of, row, id)?;
            }
        }
        Ok(())
    }
}
