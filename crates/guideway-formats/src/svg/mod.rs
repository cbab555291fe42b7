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
//! a report, and expands `use` and markers to a million elements.

mod cascade;
mod conditions;
mod context;
mod element_counts;
mod element_transform;
mod length;
mod page;
mod path_builder;
mod read;
mod repeat_budget;
mod shape_mapper;
mod shapes;
mod style;
mod style_sheet;
mod svg_writer;
mod transform;
mod tree_walker;
mod viewport;
mod write;

pub(crate) use self::read::read;
pub use self::svg_writer::{PathData, Stroke, SvgWriter};
pub use self::write::write_layout;
