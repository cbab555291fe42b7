//! The state that all mappers of a site share: the layout, its parameter columns, and the elements
//! that lifts and mutexes refer to.

use std::collections::{HashMap, HashSet};

use guideway_layout::{Block, Code, Member, Place};

use crate::builder::{Builder, PlaceFn};
use crate::source::Source;
use crate::yaml::YamlNode;

/// The layout under construction.
pub(super) struct SiteReader<'a, 'y> {
    pub(super) builder: Builder<'a>,
    /// True for a navigation graph, whose parameters have no types.
    pub(super) is_graph: bool,
    /// Parameters with a column: those of paths, nodes and stations.
    pub(super) columns: [HashSet<&'y str>; 3],
    /// Nodes in each lift.
    pub(super) lifts: HashMap<&'y str, Vec<u32>>,
    /// Row of the block of each mutex.
    mutexes: HashMap<&'y str, usize>,
}

impl<'a, 'y> SiteReader<'a, 'y> {
    pub(super) fn new(source: Source<'a>, file_bytes: usize) -> Self {
        Self {
            builder: Builder::new(source, file_bytes),
            is_graph: false,
            columns: Default::default(),
            lifts: HashMap::new(),
            mutexes: HashMap::new(),
        }
    }

    /// Reports a value of the wrong type that is left out.
    pub(super) fn report_type(&mut self, at: PlaceFn<'_>, expected: &str, found: YamlNode<'_>) {
        let message = || format!("expected {expected}, found {}", found.kind());
        let remedy = "It is left out; correct it";
        self.builder.report(Code::WrongType, at, message, remedy);
    }

    /// Adds an element to the block of a mutex: one vehicle at a time.
    pub(super) fn add_to_mutex(&mut self, name: &'y str, member: Member) {
        let blocks = &mut self.builder.layout.blocks;
        let row = *self.mutexes.entry(name).or_insert_with(|| {
            blocks.push(Block {
                id: name.to_owned(),
                ..Block::default()
            });
            blocks.len() - 1
        });
        blocks[row].members.push(member);
    }
}

/// The place of a named element.
pub(super) fn place(element: &str, node: YamlNode<'_>) -> Place {
    Place::on_line(element, node.line())
}
