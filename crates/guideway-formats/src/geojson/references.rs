//! References: how features and blocks name other elements.

use std::collections::HashSet;
use std::io::{self, Write};

use guideway_layout::{Layout, Member};

use super::json_writer::JsonWriter;

/// Knows for each element whether its identifier names it, or its row must.
pub(super) struct References {
    nodes: Vec<bool>,
    levels: Vec<bool>,
    stations: Vec<bool>,
    paths: Vec<bool>,
    /// Place of each path among the written ones; `None` for a path without a curve.
    path_rows: Vec<Option<u32>>,
}

impl References {
    pub(super) fn new(layout: &Layout) -> Self {
        let written = layout.paths.iter().map(|path| path.runs().len() > 0);
        let mut count = 0;
        let row = |is_written: bool| {
            is_written.then(|| {
                count += 1;
                count - 1
            })
        };
        let path_rows: Vec<Option<u32>> = written.map(row).collect();
        let has_blocks = !layout.blocks.is_empty();
        let paths = layout
            .paths
            .iter()
            .filter(|path| has_blocks && path.runs().len() > 0);
        let stations = (0..layout.stations.len() as u32).filter(|_| has_blocks);
        Self {
            nodes: are_first((0..layout.nodes.len() as u32).map(|node| layout.nodes.id(node))),
            levels: are_first(layout.levels.iter().map(|level| level.id.as_str())),
            stations: are_first(stations.map(|station| layout.stations.id(station))),
            paths: are_first(paths.map(|path| path.id())),
            path_rows,
        }
    }

    pub(super) fn write_node<W: Write>(
        &self,
        json: &mut JsonWriter<'_, W>,
        layout: &Layout,
        node: u32,
    ) -> io::Result<()> {
        write(json, &self.nodes, node, layout.nodes.id(node))
    }

    pub(super) fn write_level<W: Write>(
        &self,
        json: &mut JsonWriter<'_, W>,
        layout: &Layout,
        level: u32,
    ) -> io::Result<()> {
        write(json, &self.levels, level, &layout.levels[level as usize].id)
    }

    /// Writes a member of a block as `[kind, reference]`; nothing for a path that is not written.
    pub(super) fn write_member<W: Write>(
        &self,
        json: &mut JsonWriter<'_, W>,
        layout: &Layout,
        member: Member,
    ) -> io::Result<()> {
        let (kind, rows, row, id) = match member {
            Member::Node(row) => ("node", &self.nodes, row, layout.nodes.id(row)),
            Member::Station(row) => ("station", &self.stations, row, layout.stations.id(row)),
            Member::Path(path) => {
                let Some(row) = self.path_rows[path as usize] else {
                    return Ok(());
                };
                ("path", &self.paths, row, layout.paths.id(path as usize))
            }
        };
        json.begin('[')?;
        json.any(kind)?;
        write(json, rows, row, id)?;
        json.end(']')
    }
}

fn write<W: Write>(
    json: &mut JsonWriter<'_, W>,
    are_first: &[bool],
    row: u32,
    id: &str,
) -> io::Result<()> {
    match are_first[row as usize] {
        true => json.any(id),
        false => json.any(&row),
    }
}

/// Returns for each identifier whether no earlier element has it.
fn are_first<'l>(ids: impl Iterator<Item = &'l str>) -> Vec<bool> {
    let mut seen = HashSet::new();
    ids.map(|id| seen.insert(id)).collect()
}
