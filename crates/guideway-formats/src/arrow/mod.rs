//! Apache Arrow IPC files (also called Feather V2) and streams with tables of paths.
//!
//! `docs/arrow-format.md` describes the columns. The bytes are not trusted: declared lengths and
//! positions are compared with the size of the file before anything is decoded, and a budget limits
//! the expansion of compressed data.
//!
//! | stage | input | output | file |
//! |---|---|---|---|
//! | open | file | schema, ranges of messages | `container`, `schema`, `column_names` |
//! | decode | messages | record batches, control polygons | `decode`, `message_body`, `control_polygons`, `fault` |
//! | assemble | control polygons | geometry, drawn and refused rows | `assemble`, `point_store`, `batch` |
//! | columns | record batches, drawn rows | identifiers, attributes, style | `path_columns`, `path_ids`, `attribute_columns`, `style_columns`, `text_array`, `text_sink` |
//! | read | all of these, batch by batch on several threads | layout | `read` |
//! | guards | | problems | `budget`, `catch_decode_panic`, `cast`, `problems` |
//! | write | layout, or rows | file, losses | `write_layout`, `write`, `write_column`, `write_error` |

mod assemble;
mod attribute_columns;
mod batch;
mod budget;
mod cast;
mod catch_decode_panic;
mod column_names;
mod container;
mod control_polygons;
mod decode;
mod fault;
mod message_body;
mod path_columns;
mod path_ids;
mod point_store;
mod problems;
mod read;
mod schema;
mod style_columns;
mod text_array;
mod text_sink;
mod write;
mod write_column;
mod write_error;
mod write_layout;

pub(crate) use self::read::read;
pub use self::write::ArrowWriter;
pub use self::write_column::{Column, ColumnType, Precision};
pub use self::write_error::{WriteError, WriteProblem};
pub use self::write_layout::{WriteOptions, write_layout};
