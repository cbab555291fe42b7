//! Table 5.1: the most paths at 60 frames per second, with memory.

use super::blocks::compute_device_warning;
use super::cells::{frame_cells, frame_columns, median_cell, why_not};
use super::section::{Block, Section};
use crate::reproduce::{Limit, MostPaths, Run, thesis};
use guideway_bench::format::{count, digits, megabytes};
use guideway_bench::page::{Cell, Column, Table};

/// Table 5.1.
pub(super) fn section(run: &Run) -> Section {
    let search = &run.plan.search;
    let mut blocks = vec![Block::Text(format!(
        "The most paths with a median frame time of at most {} ms, all in view, to a tolerance of \
         {} %; the search covers {} to {} paths. Memory is the allocation of the method without \
         the layout, between frames and at the peak. The last two columns are the numbers of the \
         thesis, from another machine ({}).",
        digits(search.target_ms),
        search.tolerance * 100.0,
        count(search.least as u64),
        count(search.ceiling as u64),
        thesis::MACHINE,
    ))];
    blocks.extend(compute_device_warning(run));
    blocks.push(Block::Table(table(run)));
    Section {
        id: "most-paths",
        title: "Most paths at 60 frames per second",
        blocks,
    }
}

fn table(run: &Run) -> Table {
    let mut columns = vec![
        Column::new("Dataset", "dataset"),
        Column::new("Method", "method"),
        Column::new("Most paths at 60 FPS", "paths"),
        Column::new("Limit", "limit"),
        Column::in_file("reason"),
        Column::in_page("Frame: mean (ms)"),
        Column::in_page("median, 5 to 95 % (ms)"),
        Column::new("Held (MB)", "held_mb"),
        Column::new("Peak (MB)", "peak_mb"),
        Column::new("Thesis: paths", "thesis_paths"),
        Column::new("Thesis: MB", "thesis_mb"),
    ];
    columns.extend(frame_columns());
    Table {
        name: "table-5.1",
        title: "Table 5.1: maximum number of paths at 60 FPS, and memory usage".to_owned(),
        is_folded: false,
        columns,
        rows: run.results.most_paths.iter().map(|m| row(run, m)).collect(),
    }
}

fn row(run: &Run, found: &MostPaths) -> Vec<Cell> {
    let measured = found.row.measured();
    let memory =
        |of: fn(&guideway_bench::Measured) -> u64| Cell::from(measured.map(|m| megabytes(of(m))));
    let thesis_row = thesis::MOST_PATHS
        .iter()
        .find(|(dataset, method, ..)| (*dataset, *method) == (found.dataset, &found.row.method));
    let mut cells = vec![
        Cell::text(found.dataset.name()),
        Cell::text(found.row.method.clone()),
        match found.paths {
            Some(paths) => Cell::Count(paths as u64),
            None => Cell::Nothing,
        },
        Cell::text(limit(run, found)),
        match &found.reason {
            Some(reason) => Cell::text(reason.clone()),
            None => why_not(&found.row),
        },
        Cell::from(measured.map(|m| m.frame_ms.mean)),
        measured.map_or(Cell::Nothing, |m| median_cell(&m.frame_ms)),
        memory(|m| m.held_bytes),
        memory(|m| m.peak_bytes),
        Cell::from(thesis_row.map(|&(_, _, paths, _)| paths)),
        Cell::from(thesis_row.map(|&(_, _, _, mb)| mb)),
    ];
    cells.extend(frame_cells(measured));
    cells
}

fn limit(run: &Run, found: &MostPaths) -> String {
    let search = &run.plan.search;
    match (found.limit, &found.reason) {
        (Limit::FrameTime, _) => "frame time".to_owned(),
        (Limit::Ceiling, _) => "ceiling of the search".to_owned(),
        (Limit::TooSlow, _) => {
            let ms = found.trials.last().and_then(|trial| trial.frame_ms);
            let ms = ms.map_or_else(String::new, |ms| format!(": {} ms", digits(ms)));
            format!("{} paths{ms}", count(search.least as u64))
        }
        (Limit::Refused, Some(reason)) => reason.clone(),
        (Limit::Refused, None) => "refused".to_owned(),
        (Limit::Time, _) => "time limit".to_owned(),
    }
}
