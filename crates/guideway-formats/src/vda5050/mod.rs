//! Orders of VDA 5050, the interface between fleet control and vehicles: JSON, meters, y up.
//!
//! In 1.1 to 2.1 an edge names its nodes; from 3.0 on it connects the nodes whose `sequenceId` is
//! one less and one more than its own. The keys of a file decide, not the stated version.
//!
//! | stage | input | output | file |
//! |---|---|---|---|
//! | read | text | records | `read`, `model` |
//! | map | records | levels, nodes, paths | `mapper`, `map`, `edges` |

mod edges;
mod map;
mod mapper;
mod model;
mod read;

pub(crate) use self::read::read;
