//! Orders of VDA 5050, the interface between fleet control and vehicles: JSON, meters, y up.
//!
//! In 1.1 to 2.1 an edge names its nodes; from 3.0 on it connects the nodes whose `sequenceId` is
//! one less and one more than its own. The keys of a file decide, not the stated version.
//!
//! | stage | input | output | file |
//! |---|---|---|---|
//! | read | text | records | `read`, `model`, `version`, `places` |
//! | map | records | levels, nodes, paths, columns | `mapper`, `map`, `edges`, `members` |
//! | order | layout | paths and nodes as one route | `route` |
//! | write | route | text | `write`, `objects`, `held`, `actions` |
//! | account | layout, route | losses | `write_losses` |

mod actions;
mod edges;
mod held;
mod map;
mod mapper;
mod members;
mod model;
mod objects;
mod places;
mod read;
mod route;
mod version;
mod write;
mod write_losses;

pub(crate) use self::read::read;
pub use self::version::Version;
pub use self::write::{WriteOptions, write_layout};
