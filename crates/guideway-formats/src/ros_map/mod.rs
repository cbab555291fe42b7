//! Occupancy grids of ROS: reads a `map.yaml` of the map servers of ROS and Nav2 with its image.
//!
//! A map is a floor plan, not a layout: an image whose pixels are free, occupied or unknown, with
//! its own resolution and its own place on the floor.
//!
//! | module | input | output |
//! |---|---|---|
//! | `sniff` | first bytes | whether they begin a map file |
//! | `map_file` | YAML | [`MapFile`]: name of the image, placement, meaning of its pixels |
//! | `grid` | map file, image | [`OccupancyGrid`] |
//! | `outline` | occupancy grid | a layout of wall lines |

#[cfg(feature = "floor-plans")]
mod grid;
#[cfg(feature = "floor-plans")]
mod map_file;
#[cfg(feature = "floor-plans")]
mod outline;
mod sniff;

#[cfg(feature = "floor-plans")]
pub use grid::{OCCUPIED, OccupancyGrid, UNKNOWN, read_file};
#[cfg(feature = "floor-plans")]
pub use map_file::{MapFile, MapMode};
pub use sniff::is_ros_map;
