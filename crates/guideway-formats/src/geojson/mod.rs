//! GeoJSON: plain, with the whole layout of Guideway, and as route graphs of Nav2.
//!
//! In a route graph, points are nodes, and lines with the properties `startid` and `endid` are
//! edges. Its positions are meters, regardless of the stated coordinate reference system.
//!
//! | stage | input | output | file |
//! |---|---|---|---|
//! | read | text | records | `read`, `model`, `coordinates`, `properties`, `extension` |
//! | map | records | layout | `features`, `geometry`, `elements`, `columns`, `member`; `feature_source`, `mapper` |
//! | interpret | names, curves | units, types, lines | `crs`, `unit`, `declared`, `curve_check`, `names` |
//! | write | layout | text, losses | `write*`, `references`, `nav2_ids`, `lines`, `json_writer` |

mod columns;
mod coordinates;
mod crs;
mod curve_check;
mod declared;
mod elements;
mod extension;
mod feature_source;
mod features;
mod geometry;
mod json_writer;
mod lines;
mod mapper;
mod member;
mod model;
mod names;
mod nav2_ids;
mod nav2_values;
mod properties;
mod read;
mod references;
mod unit;
mod write;
mod write_losses;
mod write_member;
mod write_nav2;

pub(crate) use self::names::ROUTE_GRAPH;
pub(crate) use self::read::read;
pub(crate) use self::write::write_watched;
pub use self::write::{WriteOptions, write_layout};
pub use self::write_nav2::write_route_graph;
pub(crate) use self::write_nav2::write_route_graph_watched;
