//! Tolerant JSON reader: parses a text into records whose fields hold a value or the type found
//! instead.
//!
//! A wrong type must not end the read, and a tree of values would take many times the size of the
//! file. So the needed fields are deserialized straight into records, and the rest is skipped.
//!
//! | stage | input | output | file |
//! |---|---|---|---|
//! | limits | text | nesting and element count within limits | `limits` |
//! | parse | text | a record of [`Field`]s, or a problem | `parse`, `record`, `field`, `attributes` |
//! | items | text of a long array | one record at a time | `lazy_array` |
//! | check | fields | values, diagnostics | `check` |
//! | lines | diagnostics, text | line numbers | `lines` |

mod attributes;
mod check;
mod field;
mod lazy_array;
mod limits;
mod lines;
mod parse;
mod record;

pub(crate) use self::attributes::{AttributeKey, Attributes, HasAttributes};
pub(crate) use self::check::{field_place, items};
pub(crate) use self::field::{Field, FromJson, Key};
pub(crate) use self::lazy_array::LazyArray;
pub(crate) use self::lines::add_line_numbers;
pub(crate) use self::parse::parse;
pub(crate) use self::record::record;
