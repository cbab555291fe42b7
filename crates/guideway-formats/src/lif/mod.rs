//! Layout Interchange Format (LIF) of the VDMA, versions 1.0 and 2.0: JSON, meters, y up.
//!
//! The structure of a file decides its version, because the stated one is often wrong: the official
//! examples of 1.0 state 0.11.0.
//!
//! | stage | input | output | file |
//! |---|---|---|---|
//! | read | input | records | `read`, `model` |
//! | map | records | layout | `mapper`, `map`, `nodes`, `edges`, `stations`, `type_entries`, `members` |
//! | write | layout | text of a new file, losses | `write/` |
//! | save | layout, text of its file | text with the edited parts, losses | `save/` |

mod edges;
mod map;
mod mapper;
mod members;
mod model;
mod nodes;
mod read;
mod save;
mod stations;
mod type_entries;
mod version;
mod write;

pub(crate) use self::read::read;
pub use self::version::Version;
pub(crate) use self::write::write_watched;
pub use self::write::{WriteOptions, write_layout};
