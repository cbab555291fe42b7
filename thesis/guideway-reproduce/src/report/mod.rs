//! Writes the report of a [`Run`](crate::reproduce::Run): an HTML page and CSV tables. Equal runs
//! give equal files.
//!
//! | module | purpose |
//! |---|---|
//! | `content` | sections of the page with their tables and charts |
//! | `table`, `chart` | a table as HTML and CSV, a line chart as SVG |
//! | `html`, `xml` | the page, and escaped markup |
//! | `file` | the files of a report |

mod chart;
mod content;
mod file;
mod html;
mod table;
mod xml;

pub use file::{File, PAGE, files};
