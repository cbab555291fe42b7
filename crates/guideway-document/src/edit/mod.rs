//! Edits of a document.
//!
//! | file | input | output |
//! |---|---|---|
//! | `transform`, `node_moves`, `points` | elements, nodes, control points | moved elements, and what follows them |
//! | `draw`, `create` | positions, nodes | new paths, nodes and stations |
//! | `properties`, `directions`, `rename` | elements | other properties |
//! | `levels`, `vehicle_types`, `groups` | names, elements | levels, vehicle types, and elements with them |
//! | `copies`, `clip`, `paste` | elements | copies in the same or another document |
//! | `delete` | elements | removed rows |
//! | `curves`, `lengths`, `names`, `property_value`, `elements`, `error` | | parts of the above |
//! | `shapes` | paths, nodes, radii | paths that are split, joined, welded, aligned, rounded |
//! | `perform` | [`Change`](crate::Change)s | the changed document and an undoable step |
//! | `together` | several edits | one undoable step |
//! | `preview` | an edit | what it does, until it is taken back |

mod cells;
mod clamped;
mod clip;
mod copies;
mod create;
mod curves;
mod delete;
mod directions;
mod draw;
mod elements;
mod error;
mod groups;
mod lengths;
mod levels;
mod names;
mod node_moves;
mod paste;
mod perform;
mod points;
mod preview;
mod properties;
mod property_value;
mod rename;
mod shapes;
mod together;
mod transform;
mod vehicle_types;

pub use cells::NewCells;
pub(crate) use clamped::clamped;
pub use clip::Clip;
pub use create::NewEdge;
pub(crate) use curves::runs_of;
pub use draw::drawn_path;
pub use error::OperationError;
pub use groups::LevelFact;
pub use levels::{LevelContent, LevelFacts, PropertyValues};
pub use points::PointRef;
pub use properties::PropertyRef;
pub use shapes::{AlignTo, Drawing, DrawnCurve, EdgeTemplate, Shape, ShapeError, Welded};
pub use transform::Neighbors;
pub use vehicle_types::TypeUse;
