//! Layout Interchange Format (LIF) of the VDMA, versions 1.0 and 2.0: JSON, meters, y up.
//!
//! The structure of a file decides its version, because the stated one is often wrong: the official
//! examples of 1.0 state 0.11.0.
//!
//! | stage | input | output | file |
//! |---|---|---|---|
//! | read | text | records | `read`, `model` |
//! | map | records | layout | `mapper`, `map`, `edges` |
//! | passthrough | text of the file read | members that the model does not hold | `passthrough/` |
//! | prepare | layout | levels, nodes, edges, columns of the format | `write_network`, `write_edges`, `write_columns`, `end_nodes`, `unique_names` |
//! | write | all of these | text, losses | `write`, `write_objects` |

mod edges;
mod end_nodes;
mod map;
mod mapper;
mod model;
mod passthrough;
mod read;
mod unique_names;
mod version;
mod write;
mod write_columns;
mod write_edges;
mod write_network;
mod write_objects;

pub(crate) use self::passthrough::count_unmodeled;
pub(crate) use self::read::read;
pub use self::version::Version;
pub use self::write::{WriteOptions, write_layout};
