//! Parses untrusted XML: bounds size, depth and entities before parsing; gives a tree with the line
//! of every element.
//!
//! | stage | input | output | file |
//! |---|---|---|---|
//! | decode | bytes, a declared encoding | UTF-8 | `declared_encoding` |
//! | tokenize | text | root, entities, default attributes | `doctype` |
//! | expand | text, definitions | text without a definition | `entities` |
//! | scan | text | limits that are exceeded | `limits` |
//! | parse | text | tree | `tree`, `problem` |
//!
//! `doctype` also tells formats apart; the others need the feature `xml`.

#[cfg(feature = "xml")]
mod declared_encoding;
mod doctype;
#[cfg(feature = "xml")]
mod entities;
#[cfg(feature = "xml")]
mod limits;
#[cfg(feature = "xml")]
mod problem;
#[cfg(feature = "xml")]
mod tree;

#[cfg(feature = "xml")]
pub(crate) use declared_encoding::from_declared;
pub(crate) use doctype::Prolog;
#[cfg(feature = "xml")]
pub(crate) use tree::{Xml, child, children, decode};
