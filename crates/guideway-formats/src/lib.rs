//! Layout files to and from the Guideway model.
//!
//! Files come from customers and from the network, so their bytes are not trusted: every reader holds
//! to [`Limits`](guideway_layout::Limits), never panics, and either gives a layout with everything odd
//! in its diagnostics or an error that says which file, where, what, and what to do.

pub mod arrow;
mod builder;
mod clamped;
pub mod dxf;
mod ellipse;
mod error;
pub mod geojson;
mod input;
mod json;
mod lanelet2;
pub mod lif;
mod losses;
mod node_rows;
mod opendrive;
mod opentcs;
mod read;
mod rmf;
mod sniff;
mod source;
mod spline;
pub mod svg;
mod text;
mod trajectory;
mod user_error;
mod vda5050;
mod wgs84;
mod xml;
mod yaml;

pub use error::{Problem, ReadError};
pub use losses::{Loss, Losses};
pub use read::{read_bytes, read_file};
pub use sniff::{Format, sniff};
pub use source::{Progress, ReadOptions};
