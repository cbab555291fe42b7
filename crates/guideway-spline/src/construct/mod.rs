//! Curves built from what a person gives, and cut, joined and rounded.
//!
//! | module | input | output |
//! |---|---|---|
//! | `arc` | points, a start direction | an arc of a circle |
//! | `interpolate` | points | a curve through them without kinks |
//! | `handles` | points with handles | a curve of Beziers |
//! | `cut` | a curve, parameters | its parts |
//! | `join` | two consecutive curves | one curve |
//! | `cross` | two curves | where they cross |
//! | `fillet` | two curves that meet in a corner | their rests and the arc between |
//! | `side` | a curve at a corner | points, directions and curvatures along it |
//! | `error` | | the reason why there is no such curve |

mod arc;
mod cross;
mod cut;
mod error;
mod fillet;
mod handles;
mod interpolate;
mod join;
mod side;

pub use arc::Arc;
pub use cross::{Crossing, crossings};
pub use cut::{Parameter, cut, cut_all, nearest_parameter, parameter_at_length, point_at};
pub use error::ConstructError;
pub use fillet::{Fillet, fillet};
pub use handles::{Anchor, curve_of_anchors};
pub use interpolate::{Spacing, interpolate};
pub use join::join;
