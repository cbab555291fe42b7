//! From a [`Run`] to a page that a person wants to read, and tables that a program can.
//!
//! Nothing but the run decides what they say: the same run gives the same files.

mod chart;
mod content;
mod html;
mod table;
mod xml;

use crate::reproduce::Run;
use content::Block;

/// Name of the page among the [`files`].
pub const PAGE: &str = "index.html";

/// One file of a report.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct File {
    /// Its name.
    pub name: String,
    /// What is in it.
    pub text: String,
}

/// All files of the report on a run: [`PAGE`], which needs none of the others, and a CSV file for each table
/// and figure with numbers.
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
