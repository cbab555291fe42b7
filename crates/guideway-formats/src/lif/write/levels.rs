//! Levels of a layout as JSON: layouts and origins of LIF, without their arrays.

use guideway_layout::Attributes;

use super::columns::{MemberColumns, Tables};
use super::elements::{Elements, text};
use crate::json::{Members, Tree};
use crate::lif::members::{LAYOUT, ORIGIN, ORIGIN_OTHER, OTHER};

impl<'a> Elements<'a> {
    /// A level without its arrays.
    pub(in crate::lif) fn level(&self, index: usize) -> Tree<'a> {
        let Some(level) = self.network.levels().nth(index) else {
            return Tree::Object(Vec::new());
        };
        let mut members: Members<'a> = vec![text("layoutId", level.id.as_str())];
        members.extend(level.name.as_deref().map(|name| text("layoutName", name)));
        self.row_columns(&level.attributes, LAYOUT)
            .add_to(&mut members, 0, None);
        if members.iter().all(|(name, _)| name != "layoutVersion") {
            members.push(text("layoutVersion", "1"));
        }
        let mut tree = Tree::Object(members);
        self.merge_other(&mut tree, &level.attributes, 0, OTHER);
        tree
    }

    /// The origin of a level of 2.0, without its layouts.
    pub(in crate::lif) fn origin(&self, index: usize) -> Tree<'a> {
        let mut members: Members<'a> = Vec::new();
        let level = self.network.levels().nth(index);
        let attributes = level.map(|level| &level.attributes);
        if let Some(attributes) = attributes {
            self.row_columns(attributes, ORIGIN)
                .add_to(&mut members, 0, None);
        }
        if members.iter().all(|(name, _)| name != "originId") {
            members.insert(0, text("originId", "origin"));
        }
        let mut tree = Tree::Object(members);
        if let Some(attributes) = attributes {
            self.merge_other(&mut tree, attributes, 0, ORIGIN_OTHER);
        }
        tree
    }

    /// Columns of a table of one row.
    pub(in crate::lif) fn row_columns(
        &self,
        of_element: &'a Attributes,
        names: &[&'static str],
    ) -> MemberColumns<'a> {
        let tables = Tables {
            of_element,
            of_entry: None,
        };
        MemberColumns::select(self.version, names, tables, false, self.is_from_lif)
    }
}
