//! Reads and writes SVG drawings: user units scaled to meters by the page size, y down.
//!
//! | Stage | Input | Output | File |
//! |---|---|---|---|
//! | parse | text | XML tree, style sheets | `read`, `style_sheet` |
//! | cascade | declarations | a value per property | `cascade`, `length`, `style` |
//! | walk | tree | shapes with transform, viewport and style | `tree_walker`, `conditions`, `page`, `repeat_budget`, `transform`, `element_transform`, `viewport` |
//! | convert | shape | runs in meters | `shapes`, `path_builder` |
//! | map | runs and style | paths, colors, widths | `shape_mapper`, `element_counts` |
//! | write | layout | SVG elements | `write`, `svg_writer`; `xml_text` |
//!
//! The reader uses `svgtypes`, the parser below `usvg`, and not `usvg` itself: `usvg` computes in
//! single precision, converts arcs with an error of up to 0.1 units, drops unpainted shapes without
//! a report, and expands `use` and markers to a million elements. Only the reader needs the feature
//! `svg`.

#[cfg(feature = "svg")]
mod cascade;
#[cfg(feature = "svg")]
mod conditions;
#[cfg(feature = "svg")]
mod context;
#[cfg(feature = "svg")]
mod element_counts;
#[cfg(feature = "svg")]
mod element_transform;
#[cfg(feature = "svg")]
mod length;
#[cfg(feature = "svg")]
mod page;
#[cfg(feature = "svg")]
mod path_builder;
#[cfg(feature = "svg")]
mod read;
#[cfg(feature = "svg")]
mod repeat_budget;
#[cfg(feature = "svg")]
mod shape_mapper;
#[cfg(feature = "svg")]
mod shapes;
#[cfg(feature = "svg")]
mod style;
#[cfg(feature = "svg")]
mod style_sheet;
mod svg_writer;
#[cfg(feature = "svg")]
mod transform;
#[cfg(feature = "svg")]
mod tree_walker;
#[cfg(feature = "svg")]
mod viewport;
mod write;

#[cfg(feature = "svg")]
pub(crate) use self::read::read;
pub use self::svg_writer::{PathData, Stroke, SvgText, SvgWriter};
pub use self::write::write_layout;
pub(crate) use self::write::write_watched;
