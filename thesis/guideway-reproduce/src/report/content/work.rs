//! Coverage at the borders of cells, layouts that change, and the counted work of a frame.

use super::cells::{frame_cells, frame_columns, why_not};
use super::section::{Block, Section};
use crate::reproduce::{Border, Reading, Run, names};
use guideway_bench::format::{megabytes, percent};
use guideway_bench::page::{Cell, Column, Table};

/// Missing share of the coverage above which a picture counts as empty. Derived: a method with
/// lines one pixel wide instead of three lacks two thirds.
const BLIND: f64 = 0.9;

/// The section about coverage relative to the oracle.
pub(super) fn borders(run: &Run) -> Section {
    let share = |share: Option<f64>| share.map_or(Cell::Nothing, |s| Cell::text(percent(s)));
    let row = |border: &Border| {
        vec![
            Cell::text(border.method.clone()),
            share(border.lost),
            share(border.added),
            Cell::from(border.lost),
            Cell::from(border.added),
            border.why_not.as_ref().map_or(Cell::Nothing, Cell::text),
        ]
    };
    let table = Table {
        name: "borders",
        title: "Coverage of one hall at 20 pixels per meter, relative to the oracle".to_owned(),
        is_folded: false,
        columns: vec![
            Column::new("Method", "method"),
            Column::in_page("Missing"),
            Column::in_page("Surplus"),
            Column::in_file("lost"),
            Column::in_file("added"),
            Column::new("Not measured", "why_not"),
        ],
        rows: run.results.borders.iter().map(row).collect(),
    };
    let mut blocks = vec![
        Block::Text(
            "Missing and surplus coverage of each method, relative to the exact oracle. Part \
                 of both comes from the profile of anti-aliased edges; the additional loss of \
                 `grid` compared with `grid+scan+radius` occurs at the borders of cells."
                .to_owned(),
        ),
        Block::Table(table),
    ];
    blocks.extend(blind(run));
    Section {
        id: "borders",
        title: "Lines at the borders of cells",
        blocks,
    }
}

/// A warning about methods with an almost empty picture.
fn blind(run: &Run) -> Option<Block> {
    let borders = run.results.borders.iter();
    let blind = borders.filter(|border| border.lost.is_some_and(|lost| lost > BLIND));
    let names: Vec<&str> = blind.map(|border| border.method.as_str()).collect();
    (!names.is_empty()).then(|| {
        Block::Text(format!(
            "Mind the times of {}: the picture is almost empty.",
            names.join(", ")
        ))
    })
}

/// The section about frames before each of which all paths move.
pub(super) fn changes(run: &Run) -> Section {
    let row = |reading: &Reading| {
        let measured = reading.row.measured();
        let stage_ms = |names: &[&str]| {
            let stages = measured?.stages.iter();
            let mut own = stages
                .filter(|stage| names.contains(&stage.name.as_str()))
                .peekable();
            own.peek()?;
            Some(own.map(|stage| stage.ms).sum::<f64>())
        };
        let updated = measured.and_then(|m| m.update_ms);
        let mut cells = vec![
            Cell::text(reading.dataset.name()),
            Cell::text(reading.row.method.clone()),
            Cell::Count(reading.paths as u64),
            Cell::from(measured.map(|m| m.prepare.ms)),
            Cell::from(updated.map(|m| m.mean)),
            Cell::from(stage_ms(&[names::KEYS, names::SORT])),
            Cell::from(stage_ms(&[names::TEST_PIXELS])),
            Cell::from(measured.map(|m| m.frame_ms.mean)),
            Cell::from(measured.and_then(|m| m.work.tests_a_pixel)),
            Cell::from(measured.map(|m| megabytes(m.held_bytes))),
            Cell::from(measured.map(|m| megabytes(m.peak_bytes))),
            why_not(&reading.row),
        ];
        cells.extend(frame_cells(measured));
        cells
    };
    let mut columns = vec![
        Column::new("Dataset", "dataset"),
        Column::new("Method", "method"),
        Column::new("Paths", "paths"),
        Column::new("First build (ms)", "build_ms"),
        Column::new("Update (ms)", "update_ms"),
        Column::new("Build in the frame (ms)", "frame_build_ms"),
        Column::new("Query (ms)", "query_ms"),
        Column::in_page("Frame with update: mean (ms)"),
        Column::new("Tests per pixel", "tests_a_pixel"),
        Column::new("Held (MB)", "held_mb"),
        Column::new("Peak (MB)", "peak_mb"),
        Column::new("Not measured", "why_not"),
    ];
    columns.extend(frame_columns());
    Section {
        id: "changes",
        title: "Layouts that change",
        blocks: vec![
            Block::Text(
                "All paths are in view and move before each frame. A method that cannot follow \
                 prepares the whole scene again; `tree` fits its boxes to the moved curves, and \
                 `quadtree` builds its cells in every frame. An update in place is wall time: it \
                 counts the new positions and their upload too."
                    .to_owned(),
            ),
            Block::Table(Table {
                name: "changes",
                title: "Build, update, query and memory where all paths move".to_owned(),
                is_folded: false,
                columns,
                rows: run.results.changes.iter().map(row).collect(),
            }),
        ],
    }
}

/// The section about device-independent work counts.
pub(super) fn section(run: &Run) -> Section {
    let table = Table {
        name: "work",
        title: "Work of one frame with most pixels inside the grid, and of the build".to_owned(),
        is_folded: false,
        columns: vec![
            Column::new("Dataset", "dataset"),
            Column::new("Method", "method"),
            Column::new("Paths", "paths"),
            Column::new("Lines", "lines"),
            Column::new("Tests per pixel", "tests_a_pixel"),
            Column::in_file("tests"),
            Column::new("Atomics", "atomics"),
            Column::in_page("Read (MB)"),
            Column::in_page("Written (MB)"),
            Column::in_file("bytes_read"),
            Column::in_file("bytes_written"),
            Column::new("Build: atomics", "build_atomics"),
            Column::in_page("Build: read (MB)"),
            Column::in_page("Build: written (MB)"),
            Column::in_file("build_bytes_read"),
            Column::in_file("build_bytes_written"),
            Column::new("Held (MB)", "held_mb"),
            Column::new("Peak (MB)", "peak_mb"),
            Column::new("Not measured", "why_not"),
        ],
        rows: fullest(run).into_iter().map(row).collect(),
    };
    Section {
        id: "work",
        title: "Counted work",
        blocks: vec![
            Block::Text(
                "Device-independent counts, comparable between machines: point-line distance \
                 tests, atomic operations, and bytes that threads read and write before any cache. \
                 A cell is empty if the method does not count."
                    .to_owned(),
            ),
            Block::Table(table),
        ],
    }
}

/// The reading with most pixels inside, per dataset and method.
fn fullest(run: &Run) -> Vec<&Reading> {
    let mut fullest: Vec<&Reading> = Vec::new();
    for reading in &run.results.occupancy {
        let same = |other: &&mut &Reading| {
            (other.dataset, &other.row.method) == (reading.dataset, &reading.row.method)
        };
        match fullest.iter_mut().find(same) {
            Some(known) if known.at < reading.at => *known = reading,
            Some(_) => {}
            None => fullest.push(reading),
        }
    }
    fullest
}

fn row(reading: &Reading) -> Vec<Cell> {
    let measured = reading.row.measured();
    let work = measured.map(|m| m.work).unwrap_or_default();
    let build = measured.map(|m| m.prepare.work).unwrap_or_default();
    vec![
        Cell::text(reading.dataset.name()),
        Cell::text(reading.row.method.clone()),
        Cell::Count(reading.paths as u64),
        Cell::from(measured.map(|m| m.lines)),
        Cell::from(work.tests_a_pixel),
        Cell::from(work.tests),
        Cell::from(work.atomics),
        Cell::from(work.bytes_read.map(megabytes)),
        Cell::from(work.bytes_written.map(megabytes)),
        Cell::from(work.bytes_read),
        Cell::from(work.bytes_written),
        Cell::from(build.atomics),
        Cell::from(build.bytes_read.map(megabytes)),
        Cell::from(build.bytes_written.map(megabytes)),
        Cell::from(build.bytes_read),
        Cell::from(build.bytes_written),
        Cell::from(measured.map(|m| megabytes(m.held_bytes))),
        Cell::from(measured.map(|m| megabytes(m.peak_bytes))),
        why_not(&reading.row),
    ]
}
