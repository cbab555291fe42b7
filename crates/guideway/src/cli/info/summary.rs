//! The content of a layout in numbers: the `info` report.

use std::collections::BTreeMap;

use guideway::layout::{Diagnostics, Direction, FindingKind, Layout, Place, Value};
use serde::Serialize;

use super::columns::{self, Column, FrequentValue};
use super::extent::Extent;
use crate::cli::input::{self, Input};

/// Kinds of paths that are told apart.
const MOST_KINDS: usize = 12;

/// The `info` report. Field names are keys of the JSON report.
#[derive(Debug, Serialize)]
pub(super) struct Summary {
    pub(super) file: String,
    /// The names in `file`.
    #[serde(skip)]
    pub(super) files: Vec<String>,
    pub(super) file_bytes: Option<u64>,
    pub(super) format: String,
    pub(super) format_version: String,
    /// Elements of the source, by the names of its format.
    pub(super) source_counts: Vec<Count>,
    pub(super) paths: u64,
    pub(super) two_way_paths: u64,
    /// The paths by what they are, the longest kind first.
    pub(super) kinds: Vec<PathKind>,
    pub(super) segments: u64,
    pub(super) control_points: u64,
    pub(super) nodes: u64,
    pub(super) stations: u64,
    pub(super) levels: Vec<LevelSummary>,
    pub(super) vehicle_types: Vec<FrequentValue>,
    pub(super) bounds_m: Option<Box2>,
    pub(super) length_m: f64,
    pub(super) attributes: Tables,
    pub(super) refused: Vec<Kind>,
    pub(super) findings: Vec<Kind>,
    pub(super) memory_bytes: u64,
    pub(super) ms: Times,
}

#[derive(Debug, Serialize)]
pub(super) struct Count {
    pub(super) name: String,
    pub(super) count: u64,
}

/// A kind of path: lanes, walls and other elements, or one-way and two-way.
#[derive(Debug, Serialize)]
pub(super) struct PathKind {
    pub(super) name: String,
    pub(super) paths: u64,
    pub(super) length_m: f64,
}

#[derive(Debug, Serialize)]
pub(super) struct LevelSummary {
    pub(super) id: String,
    pub(super) name: Option<String>,
    pub(super) elevation_m: Option<f64>,
    pub(super) paths: u64,
}

#[derive(Debug, Serialize)]
pub(super) struct Box2 {
    pub(super) min: [f64; 2],
    pub(super) max: [f64; 2],
}

#[derive(Debug, Serialize)]
pub(super) struct Tables {
    pub(super) paths: Vec<Column>,
    pub(super) nodes: Vec<Column>,
    pub(super) stations: Vec<Column>,
}

/// A kind of finding with its number.
#[derive(Debug, Serialize)]
pub(super) struct Kind {
    pub(super) code: &'static str,
    pub(super) severity: String,
    pub(super) count: u64,
    pub(super) meaning: &'static str,
}

impl Kind {
    fn new(kind: FindingKind) -> Self {
        Self {
            code: kind.code.name(),
            severity: kind.severity.to_string(),
            count: kind.count,
            meaning: kind.code.meaning(),
        }
    }
}

/// Duration of each step, in milliseconds.
#[derive(Debug, Default, Serialize)]
pub(super) struct Times {
    pub(super) read: f64,
    pub(super) measure: f64,
    pub(super) total: f64,
}

impl Summary {
    pub(super) fn of(layout: &Layout, inputs: &[Input]) -> Self {
        let (extent, path_kinds) = extent_and_kinds(layout);
        let source = &layout.provenance;
        let geometry = layout.paths.geometry();
        let two_way = |direction| direction == Direction::Both;
        Self {
            file: input::names(inputs),
            files: inputs.iter().map(name).collect(),
            file_bytes: inputs.iter().map(size).sum(),
            format: source.format.clone(),
            format_version: source.format_version.clone(),
            source_counts: source
                .counts
                .iter()
                .map(|(name, count)| Count {
                    name: name.clone(),
                    count: *count,
                })
                .collect(),
            paths: layout.paths.len() as u64,
            two_way_paths: layout
                .paths
                .iter()
                .filter(|p| two_way(p.direction()))
                .count() as u64,
            kinds: path_kinds,
            segments: geometry.segment_count() as u64,
            control_points: geometry.point_count() as u64,
            nodes: layout.nodes.len() as u64,
            stations: layout.stations.len() as u64,
            levels: levels(layout),
            vehicle_types: vehicle_types(layout),
            bounds_m: extent.bounds.map(|b| Box2 {
                min: [b.min.x, b.min.y],
                max: [b.max.x, b.max.y],
            }),
            length_m: extent.length_m,
            attributes: Tables {
                paths: columns::of_typed(&layout.paths.attributes, layout.paths.vehicle_types()),
                nodes: columns::of_typed(&layout.nodes.attributes, layout.nodes.vehicle_types()),
                stations: columns::of_table(&layout.stations.attributes, layout.stations.len()),
            },
            refused: refused(layout),
            findings: kinds(&layout.diagnostics),
            memory_bytes: layout.heap_bytes() as u64,
            ms: Times::default(),
        }
    }

    /// Number of paths that cannot be drawn.
    pub(super) fn refused_count(&self) -> u64 {
        self.refused.iter().map(|kind| kind.count).sum()
    }
}

/// The extent of all paths and their kinds: by the column `element`, else by direction.
fn extent_and_kinds(layout: &Layout) -> (Extent, Vec<PathKind>) {
    let paths = &layout.paths;
    let mut names: Vec<String> = Vec::new();
    let mut of_row: Vec<u32> = Vec::new();
    for row in 0..paths.len() {
        let name = match (
            paths.attributes.value(row, "element"),
            paths.get(row).direction(),
        ) {
            (Some(Value::Text(element)), _) => element,
            (_, Direction::Both) => "two-way",
            _ => "one-way",
        };
        let known = names.iter().position(|known| known == name);
        let kind = known.unwrap_or(names.len()).min(MOST_KINDS);
        match known {
            None if kind < MOST_KINDS => names.push(name.to_owned()),
            None if names.len() == MOST_KINDS => names.push("others".to_owned()),
            _ => {}
        }
        of_row.push(kind as u32);
    }
    let (extent, lengths_m) = Extent::of(paths, names.len(), |row| of_row[row] as usize);
    let mut kinds: Vec<PathKind> = names
        .into_iter()
        .zip(lengths_m)
        .map(|(name, length_m)| PathKind {
            name,
            paths: 0,
            length_m,
        })
        .collect();
    of_row
        .iter()
        .for_each(|kind| kinds[*kind as usize].paths += 1);
    kinds.sort_by(|a, b| b.length_m.total_cmp(&a.length_m));
    (extent, kinds)
}

fn levels(layout: &Layout) -> Vec<LevelSummary> {
    let mut paths = vec![0; layout.levels.len()];
    for level in layout.paths.iter().filter_map(|path| path.level()) {
        if let Some(count) = paths.get_mut(level as usize) {
            *count += 1;
        }
    }
    let summary = |(level, paths): (&guideway::layout::Level, u64)| LevelSummary {
        id: level.id.clone(),
        name: level.name.clone(),
        elevation_m: level.elevation_m,
        paths,
    };
    layout.levels.iter().zip(paths).map(summary).collect()
}

fn vehicle_types(layout: &Layout) -> Vec<FrequentValue> {
    let types = layout.paths.vehicle_types();
    let mut counts: BTreeMap<&str, u64> = BTreeMap::new();
    if !types.names().is_empty() {
        for name in (0..layout.paths.len()).flat_map(|path| types.of(path)) {
            *counts.entry(name).or_insert(0) += 1;
        }
    }
    let top = |(value, count): (&str, u64)| FrequentValue {
        value: value.to_owned(),
        count,
    };
    counts.into_iter().map(top).collect()
}

/// The refused paths by code, with the severities of their findings.
fn refused(layout: &Layout) -> Vec<Kind> {
    let mut refused = Diagnostics::with_limit(0);
    for path in layout.refused.iter() {
        refused.push_refused(path, Place::default, "");
    }
    kinds(&refused)
}

fn kinds(found: &Diagnostics) -> Vec<Kind> {
    FindingKind::of([found])
        .into_iter()
        .map(Kind::new)
        .collect()
}

fn name(input: &Input) -> String {
    input.path.to_string_lossy().into_owned()
}

fn size(input: &Input) -> Option<u64> {
    let metadata = std::fs::metadata(&input.path).ok()?;
    metadata.is_file().then_some(metadata.len())
}
