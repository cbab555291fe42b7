//! Reads and writes CAD drawings in DXF: ASCII or binary, any unit, y up.
//!
//! | Stage | Input | Output | File |
//! |---|---|---|---|
//! | tokenize | bytes | pairs of group code and value | `crate::pair_reader` |
//! | group | pairs | records (group code 0 up to the next one) | `records` |
//! | parse | records | entities, layers, blocks | `drawing`, `entity`, `shape`, `outlines`, `hatch`, `style`, `header`, `clips`, `text` |
//! | map | entities, INSERTs | paths with colors | `entity_mapper`, `clip_region`, `shapes`, `closed_spline`, `fit_spline` |
//! | note | texts, points, INSERTs | notes of the layout | `notes` |
//! | write | layout | sections of pairs | `write`, `write_sections`, `pair_writer` |
//!
//! The crate has its own tokenizer because a library would not report the entities that it skips,
//! and because every value has to be bounded before use.

mod affine3;
mod clip_region;
mod clips;
mod closed_spline;
mod drawing;
mod entity;
mod entity_counts;
mod entity_mapper;
mod fit_spline;
mod hatch;
mod header;
mod notes;
mod outlines;
mod pair_writer;
mod read;
mod records;
mod shape;
mod shapes;
mod style;
mod text;
mod write;
mod write_sections;
mod xdata;

pub(crate) use self::read::read;
pub use self::write::write_layout;
pub(crate) use self::write::write_watched;
