//! Edits of shapes in a network. Each one is one undoable step: paths stay on their nodes, stations
//! follow their nodes, and pieces of a path keep its properties.
//!
//! | file | input | output |
//! |---|---|---|
//! | `split`, `crossings` | selected paths, a point | pieces of paths between nodes |
//! | `join` | a node with two paths | one path |
//! | `weld` | selected paths, a distance | fewer nodes |
//! | `reshape` | selected paths | paths that end at their nodes; lines |
//! | `align` | nodes | nodes on a line, or evenly spaced |
//! | `fillet`, `arms` | a node at a corner, a radius | an arc between two nodes |
//! | `connect` | two nodes, tangents | a curve between them: arc or spline |
//! | `drawing`, `template` | points, a kind of curve, properties | nodes and the paths between them |
//! | `plan` | parts of a step | [`Change`](crate::Change)s in their order |
//! | `error` | | why a step cannot be done |

mod align;
mod arms;
mod connect;
mod crossings;
mod drawing;
mod error;
mod fillet;
mod join;
mod plan;
mod reshape;
mod split;
mod template;
mod weld;

pub use align::AlignTo;
pub use connect::Shape;
pub use drawing::{Drawing, DrawnCurve};
pub use error::ShapeError;
pub use template::EdgeTemplate;
pub use weld::Welded;
