//! File formats: reads layout files into the Guideway model and writes layouts back.
//!
//! Files come from customers and from the network, so their bytes are not trusted: every reader
//! obeys [`Limits`](guideway_layout::Limits), never panics, and returns either a layout with
//! diagnostics or an error with file, place, problem and remedy.
//!
//! | stage | input | output | modules |
//! |---|---|---|---|
//! | open | path or bytes | bytes, format | `read`, `input`, `unpack`, `encoding`, `charset`, `dos_page`, `format`, `sniff` |
//! | parse | bytes | records, elements | `text`, `json`, `xml`, `yaml` |
//! | map | records, elements | layout, diagnostics | one folder per format; `builder`, `node_rows` |
//! | convert | curves and units of a format | uniform cubic runs, SI units | `spline`, `trajectory`, `ellipse`, `wgs84`, `speed_unit` |
//! | floor plans | image, ROS map | pixels and their placement, walls | `raster`, `ros_map` |
//! | write | layout | text, losses | `write*` per format; `clamped`, `driven`, `trajectory_writer`, `*_nodes`, `*_losses` |
//! | save | bytes | a file that replaces its target | `output` |
//!
//! Each format has a feature, which is on by default, and so have floor plans.

#![cfg_attr(
    not(feature = "all"),
    allow(unused, reason = "formats share code that no single one uses whole")
)]

#[cfg(feature = "arrow")]
pub mod arrow;
mod builder;
#[cfg(feature = "charsets")]
mod charset;
mod clamped;
#[cfg(feature = "charsets")]
mod dos_page;
mod driven;
#[cfg(feature = "dxf")]
pub mod dxf;
mod ellipse;
mod encoding;
mod end_nodes;
mod error;
mod fields;
mod finite;
mod format;
#[cfg(feature = "geojson")]
pub mod geojson;
mod input;
mod json;
#[cfg(feature = "lanelet2")]
mod lanelet2;
#[cfg(feature = "lif")]
pub mod lif;
mod losses;
mod network_losses;
mod node_rows;
#[cfg(feature = "opendrive")]
mod opendrive;
#[cfg(feature = "opentcs")]
pub mod opentcs;
mod other_format;
mod output;
mod pair_reader;
#[cfg(feature = "floor-plans")]
pub mod raster;
mod read;
#[cfg(feature = "rmf")]
pub mod rmf;
pub mod ros_map;
mod sniff;
mod source;
mod speed_unit;
mod spline;
pub mod svg;
mod target;
mod text;
mod trajectory;
mod trajectory_writer;
mod unique_names;
mod unpack;
mod user_error;
#[cfg(feature = "vda5050")]
pub mod vda5050;
mod wgs84;
mod write_error;
mod xml;
#[cfg(feature = "xml")]
mod xml_builder;
mod xml_text;
#[cfg(feature = "yaml")]
mod yaml;

pub use error::{LIMIT_OPTIONS, Problem, ReadError};
pub use format::Format;
pub use input::Parts;
pub use losses::{Loss, Losses};
pub use output::{
    NewFile, SaveError, is_same_file, lock_regular_file, remove_unfinished, replace_file,
    try_remove_unfinished,
};
pub use read::{read_bytes, read_file, read_parts, read_stream};
pub use sniff::sniff;
pub use source::{BYTES_READ, FILE_BYTES, Progress, ReadOptions};
pub use target::Target;
pub use write_error::{WriteError, WriteProblem};
