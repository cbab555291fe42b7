//! Tolerant JSON reader: parses a text into records whose fields hold a value or the type found
//! instead.
//!
//! A wrong type must not end the read, and a tree of values would take many times the size of the
//! file. So the needed fields are deserialized straight into records, and the rest is skipped.
//!
//! | stage | input | output | file |
//! |---|---|---|---|
//! | limits | text | nesting and element count within limits | `limits` |
//! | split | text with several values | its objects | `documents` |
//! | parse | text | a record of [`Field`]s, or a problem | `parse`, `record`, `field`, `attributes` |
//! | items | text with long arrays | text without them; their records, in batches | `skeleton`, `lazy_array` |
//! | check | fields | values, diagnostics | `check`, `cell` |
//! | lines | diagnostics, rows, text | lines and columns | `lines` |
//! | write | values of a layout | text | `tree` |
//! | splice | text of the file, old and new values | changed parts of the text | `scan`, `splice`, `array_splice`, `style` |

mod array_splice;
mod attributes;
mod cell;
mod change;
mod check;
mod documents;
mod field;
mod lazy_array;
mod limits;
mod lines;
mod parse;
mod record;
mod scan;
mod skeleton;
mod splice;
mod style;
mod tree;

pub(crate) use self::array_splice::ArrayEdit;
pub(crate) use self::attributes::{AttributeKey, Attributes, HasAttributes, OtherMembers};
pub(crate) use self::cell::{Cell, CellKind, CellResult};
pub(crate) use self::check::{field_place, items};
pub(crate) use self::documents::{documents, payload};
pub(crate) use self::field::{Field, FromJson, Key};
pub(crate) use self::lazy_array::{ArrayFault, LazyArray, LazyItem, RecordKind};
pub(crate) use self::lines::{find_lines, find_lines_within, find_skeleton_lines, root_items};
pub(crate) use self::parse::{parse, parse_checked, parse_part, problem};
pub(crate) use self::record::record;
pub(crate) use self::scan::{items_at, member, offset_in, push_compact};
pub(crate) use self::skeleton::Skeleton;
pub(crate) use self::splice::Splices;
pub(crate) use self::tree::{Members, Tree, push_number};
