//! Apache Arrow IPC files (also called Feather V2) and streams: tables of paths, or of all elements
//! of a layout.
//!
//! `docs/arrow-format.md` describes the columns. The bytes are not trusted: declared lengths and
//! positions are compared with the size of the file before anything is decoded, and a budget limits
//! the expansion of compressed data.
//!
//! | stage | input | output | file |
//! |---|---|---|---|
//! | open | file | schema, ranges and extents of messages | `container`, `extents`, `schema`, `column_names`, `column_types`, `time_zones` |
//! | decode | messages | record batches, control polygons | `decode`, `dictionaries`, `message_body`, `lossy_texts`, `control_polygons`, `point_items`, `fault` |
//! | sort | record batches | kinds of their rows | `element`, `row_kinds` |
//! | assemble | control polygons of paths | geometry, drawn and refused rows | `assemble`, `point_store`, `batch`, `numbering` |
//! | columns | record batches, drawn rows | identifiers, attributes, levels | `id_column`, `attribute_table`, `attribute_columns`, `cell_formatter`, `cell_text`, `cell_times`, `attribute_names`, `level_column`, `type_lists`, `text_array`, `text_sink`, `list_array` |
//! | paths | columns of paths | style and network | `path_columns`, `path_ids`, `style_columns`, `network_columns`, `written_curves` |
//! | elements | rows of other kinds | their tables | `elements` |
//! | read | all of these, batch by batch on several threads | layout | `read`, `part`, `read_batches`, `reading` |
//! | guards | | problems | `budget`, `catch_decode_panic`, `cast`, `problems` |
//! | write | layout, or rows | batches, file, losses | `batches`, `write_layout`, `layout_rows`, `layout_columns`, `layout_arrays`, `layout_lists`, `attribute_plan`, `write`, `write_column`, `write_file` |

mod assemble;
mod attribute_columns;
mod attribute_names;
mod attribute_plan;
mod attribute_table;
mod batch;
mod batches;
mod budget;
mod cast;
mod catch_decode_panic;
mod cell_formatter;
mod cell_text;
mod cell_times;
mod column_names;
mod column_types;
mod container;
mod control_polygons;
mod decode;
mod dictionaries;
mod element;
mod elements;
mod extents;
mod fault;
mod id_column;
mod layout_arrays;
mod layout_columns;
mod layout_lists;
mod layout_rows;
mod level_column;
mod list_array;
mod lossy_texts;
mod message_body;
mod network_columns;
mod numbering;
mod part;
mod path_columns;
mod path_ids;
mod point_items;
mod point_store;
mod problems;
mod read;
mod read_batches;
mod reading;
mod row_kinds;
mod schema;
mod style_columns;
mod text_array;
mod text_sink;
mod time_zones;
mod type_lists;
mod write;
mod write_column;
mod write_file;
mod write_layout;
mod written_curves;

pub use arrow_array::{RecordBatch, RecordBatchIterator, RecordBatchReader};

pub use self::batches::{Batches, batches, collected_batches};
#[cfg(panic = "abort")]
pub use self::catch_decode_panic::decode_panic;
pub(crate) use self::read::read;
pub use self::read_batches::read_batches;
pub use self::write::ArrowWriter;
pub use self::write_column::{Column, ColumnType, Precision};
pub(crate) use self::write_layout::write_watched;
pub use self::write_layout::{WriteOptions, write_layout};
pub use crate::write_error::{WriteError, WriteProblem};
