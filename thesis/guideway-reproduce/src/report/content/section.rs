//! A section of the page: a title and blocks of text, tables, charts and pictures.

use crate::report::chart::Chart;
use crate::reproduce::{Finding, Picture};
use guideway_bench::page::Table;

/// One section of the page.
pub(crate) struct Section {
    /// Anchor in the page.
    pub(crate) id: &'static str,
    pub(crate) title: &'static str,
    pub(crate) blocks: Vec<Block>,
}

/// A block of a section.
pub(crate) enum Block {
    Text(String),
    Findings(Vec<Finding>),
    Table(Table),
    Chart(Chart),
    /// A figure of several pictures with its caption.
    Pictures(String, Vec<Picture>),
}
