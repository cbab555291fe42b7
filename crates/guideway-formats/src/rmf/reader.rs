//! The state that all mappers of a site share: the layout and its parameter columns.

use std::collections::HashSet;

use guideway_layout::{Code, Place};

use crate::builder::{Builder, PlaceFn};
use crate::source::Source;
use crate::yaml::YamlNode;

/// The layout under construction, and the parameter columns so far.
pub(super) struct SiteReader<'a, 'y> {
    pub(super) builder: Builder<'a>,
    /// Parameters with a column: whether it belongs to the paths (else to the nodes), and its key.
    pub(super) columns: HashSet<(bool, &'y str)>,
}

impl<'a> SiteReader<'a, '_> {
    pub(super) fn new(source: Source<'a>, file_bytes: usize) -> Self {
        Self {
            builder: Builder::new(source, file_bytes),
            columns: HashSet::new(),
        }
    }

    /// Reports a value of the wrong type that is left out.
    pub(super) fn report_type(&mut self, at: PlaceFn<'_>, expected: &str, found: YamlNode<'_>) {
        let message = || format!("expected {expected}, found {}", found.kind());
        let remedy = "It is left out; correct it";
        self.builder.report(Code::WrongType, at, message, remedy);
    }
}

/// The place of a named element.
pub(super) fn place(element: &str, node: YamlNode<'_>) -> Place {
    Place {
        element: element.to_owned(),
        line: Some(node.line()),
    }
}
