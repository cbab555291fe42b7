//! LIF edges of paths: the paths of one edge of a file are one edge again, and a two-way path is
//! two edges, because LIF has one-way edges only.

use std::borrow::Cow;
use std::collections::HashMap;

use guideway_layout::{Direction, Layout, PathRef, Value};

use crate::Losses;
use crate::lif::members::EDGE_ID;
use crate::unique_names::UniqueNames;

/// An edge of one or several paths.
#[derive(Clone)]
pub(in crate::lif) struct EdgeRef<'a> {
    pub(in crate::lif) id: Cow<'a, str>,
    /// Row of the first path.
    pub(in crate::lif) path: u32,
    /// Rows of further paths: curves of other vehicle types.
    pub(in crate::lif) others: &'a [u32],
    /// True for an edge against the direction of the path.
    pub(in crate::lif) is_reverse: bool,
}

impl EdgeRef<'_> {
    /// Rows of all paths.
    pub(in crate::lif) fn paths(&self) -> impl Iterator<Item = u32> {
        std::iter::once(self.path).chain(self.others.iter().copied())
    }
}

/// The edges of all paths.
pub(in crate::lif) struct Edges<'a> {
    layout: &'a Layout,
    /// Identifier of the reverse edge per path; empty if no path is two-way.
    reverse_ids: Vec<Option<String>>,
    groups: EdgeGroups<'a>,
}

/// Paths that are curves of one edge.
#[derive(Default)]
pub(in crate::lif) struct EdgeGroups<'a> {
    /// Identifier of the edge, by row of a path.
    ids: HashMap<u32, &'a str>,
    /// Further paths of the edge, by the row of its first path.
    others: HashMap<u32, Vec<u32>>,
    /// First path of the edge, by row of a further path.
    first: HashMap<u32, u32>,
}

impl<'a> EdgeGroups<'a> {
    /// Groups the paths of a layout.
    pub(in crate::lif) fn of(layout: &'a Layout) -> Self {
        let mut groups = Self::default();
        if layout.paths.attributes.get(EDGE_ID).is_none() {
            return groups;
        }
        let mut first_paths = HashMap::new();
        for path in layout.paths.iter() {
            let Some(edge) = edge_id(layout, path) else {
                continue;
            };
            let row = path.row() as u32;
            groups.ids.insert(row, edge);
            let key = (edge, path.start_node(), path.end_node(), path.level());
            let first = *first_paths.entry(key).or_insert(row);
            if first != row {
                groups.others.entry(first).or_default().push(row);
                groups.first.insert(row, first);
            }
        }
        groups
    }

    /// Returns the identifier of the edge of a path.
    pub(in crate::lif) fn id(&self, path: PathRef<'a>) -> &'a str {
        let grouped = self.ids.get(&(path.row() as u32));
        grouped.copied().unwrap_or_else(|| path.id())
    }
}

/// Returns the identifier of the edge that a path is one of several curves of. A path that was
/// renamed is an edge of its own.
fn edge_id<'a>(layout: &'a Layout, path: PathRef<'a>) -> Option<&'a str> {
    let Some(Value::Text(edge)) = layout.paths.attributes.value(path.row(), EDGE_ID) else {
        return None;
    };
    let rest = path.id().strip_prefix(edge)?;
    (rest.starts_with(" [") && path.direction() == Direction::Forward).then_some(edge)
}

impl<'a> Edges<'a> {
    /// Collects the edges of a layout; adds two-way paths to the losses.
    pub(in crate::lif) fn collect(layout: &'a Layout, losses: &mut Losses) -> Self {
        let is_both = |p: &PathRef<'_>| p.direction() == Direction::Both;
        let mut reverse_ids = Vec::new();
        if layout.paths.iter().any(|p| is_both(&p)) {
            reverse_ids = vec![None; layout.paths.len()];
            let mut names = UniqueNames::new(layout.paths.iter().map(PathRef::id));
            for path in layout.paths.iter().filter(is_both) {
                reverse_ids[path.row()] = Some(names.make_unique(path.id()));
            }
        }
        let detail = "two-way paths: written as two edges each";
        losses.add("directions", reverse_ids.iter().flatten().count(), detail);
        Self {
            layout,
            reverse_ids,
            groups: EdgeGroups::of(layout),
        }
    }

    /// Returns the edges of a path; none for a further curve of another path's edge.
    pub(in crate::lif) fn of_path(&self, row: u32) -> impl Iterator<Item = EdgeRef<'_>> {
        let path = self.layout.paths.get(row as usize);
        let is_first = !self.groups.first.contains_key(&row);
        let others = self.groups.others.get(&row).map_or(&[][..], Vec::as_slice);
        let forward = is_first.then(|| EdgeRef {
            id: self.groups.id(path).into(),
            path: row,
            others,
            is_reverse: false,
        });
        forward.into_iter().chain(self.reverse_of(row))
    }

    /// Returns the edge against the direction of a two-way path.
    pub(in crate::lif) fn reverse_of(&self, row: u32) -> Option<EdgeRef<'_>> {
        let id = self.reverse_ids.get(row as usize)?.as_deref()?;
        Some(EdgeRef {
            id: id.into(),
            path: row,
            others: &[],
            is_reverse: true,
        })
    }
}
