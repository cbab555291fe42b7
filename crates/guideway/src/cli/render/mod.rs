//! `guideway render`: layout files as a picture, PNG, SVG or PDF.
//!
//! | module | purpose |
//! |---|---|
//! | `args` | files, output and the groups of options below |
//! | `view_args`, `style_args`, `decoration_args` | one group of options each |
//! | `view_notes` | notes on what a view does not show |
//! | `report` | the report as text and JSON |
//! | `part` | reads the part of a large file that a view shows |
//! | `page` | the same in a page, which `share` writes |
//! | `run` | reads, composes, reports |

mod args;
mod decoration_args;
mod page;
mod part;
mod report;
mod run;
mod style_args;
mod view_args;
mod view_notes;

pub(crate) use args::Args;
pub(crate) use run::run;
pub(crate) use style_args::{Rule, Shade, StyleArgs};
