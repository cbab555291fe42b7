//! GeoJSON, plain and as route graphs of Nav2: positions in meters or degrees, y up.
//!
//! In a route graph, points are nodes, and lines with the properties `startid` and `endid` are
//! edges. Its positions are meters, regardless of the stated coordinate reference system.
//!
//! | stage | input | output | file |
//! |---|---|---|---|
//! | read | text | records | `read`, `model`, `coordinates`, `properties` |
//! | map | records | nodes, paths, columns | `unit`, `mapper`, `features`, `geometry` |
//! | write | layout | text, losses | `write`, `write_feature` |

mod coordinates;
mod features;
mod geometry;
mod mapper;
mod model;
mod properties;
mod read;
mod unit;
mod write;
mod write_feature;

pub(crate) use self::read::read;
pub use self::write::{WriteOptions, write_layout};
