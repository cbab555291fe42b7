//! Lists the files of a report: from a run to the text of the page and of every table.

use super::content::{self, Block};
use super::html;
use crate::reproduce::Run;

/// Name of the page among the [`files`].
pub const PAGE: &str = "index.html";

/// One file of a report.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct File {
    /// Name.
    pub name: String,
    /// Content.
    pub text: String,
}

/// All files of the report of a run: the self-contained page ([`PAGE`]), and one CSV file per
/// table.
pub fn files(run: &Run) -> Vec<File> {
    let sections = content::sections(run);
    let mut files = vec![File {
        name: PAGE.to_owned(),
        text: html::page(run, &sections),
    }];
    let blocks = sections.iter().flat_map(|section| &section.blocks);
    let tables = blocks.filter_map(|block| match block {
        Block::Table(table) => Some(table),
        _ => None,
    });
    files.extend(tables.map(|table| File {
        name: format!("{}.csv", table.name),
        text: table.csv(),
    }));
    files
}
