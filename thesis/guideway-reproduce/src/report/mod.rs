//! Writes the report of a [`Run`](crate::reproduce::Run): an HTML page and CSV tables. Equal runs
//! give equal files.
//!
//! | module | purpose |
//! |---|---|
//! | `content` | sections of the page with their tables and charts |
//! | `chart` | a line chart as SVG |
//! | `html` | the page |
//! | `file` | the files of a report |

mod chart;
mod content;
mod file;
mod html;

pub use file::{File, PAGE, files};
