//! Figures 5.4 and 5.5: charts and tables of frame and build times against the number of paths.

use super::blocks::compute_device_warning;
use super::cells::{frame_cells, frame_columns, median_cell, why_not};
use super::section::{Block, Section};
use crate::report::chart::{Chart, Series};
use crate::reproduce::names::{
    BIN, COUNT, CULL, GRID, GRID_RADIUS, PREFIX_SUM, SAMPLE, TESSELLATE_AND_DRAW,
};
use crate::reproduce::{Reading, Results, Run};
use guideway_bench::format::megabytes;
use guideway_bench::page::{Cell, Column, Table};
use guideway_bench::{Dataset, Measured};

/// Phases of figure 5.5, with their names in the file.
const PHASES: [(&str, &str); 4] = [
    (SAMPLE, "sample_ms"),
    (COUNT, "count_ms"),
    (PREFIX_SUM, "prefix_sum_ms"),
    (BIN, "bin_ms"),
];

/// Figure 5.4.
pub(super) fn frames(run: &Run) -> Section {
    let mut blocks = vec![Block::Text(
        "All paths are in view. As in the thesis, the upper line of each method is the whole \
         frame: culling, tessellation and drawing."
            .to_owned(),
    )];
    blocks.extend(compute_device_warning(run));
    blocks.extend(Dataset::ALL.map(|dataset| Block::Chart(frame_chart(run, dataset))));
    blocks.push(Block::Table(frame_table(run)));
    Section {
        id: "input-size",
        title: "Culling, tessellation and drawing against input size",
        blocks,
    }
}

fn frame_chart(run: &Run, dataset: Dataset) -> Chart {
    let mut series = Vec::new();
    for method in &run.plan.methods {
        let curve = Results::curve(&run.results.growth, dataset, method);
        let line = |name: String, ms: &dyn Fn(&Measured) -> Option<f64>| Series {
            name,
            points: curve
                .iter()
                .filter_map(|(r, m)| Some((r.at, ms(m)?)))
                .collect(),
        };
        if curve
            .iter()
            .any(|(_, m)| stage_ms(m, CULL).is_some() && stage_ms(m, TESSELLATE_AND_DRAW).is_some())
        {
            series.push(line(format!("{method}: whole frame"), &|m| {
                Some(m.frame_ms.mean)
            }));
            series.push(line(format!("{method}: culling"), &|m| stage_ms(m, CULL)));
        }
    }
    Chart {
        title: format!(
            "Figure 5.4: culling and the whole frame, dataset {}",
            dataset.name()
        ),
        x_label: "paths",
        y_label: "time (ms)",
        series,
    }
}

fn stage_ms(measured: &Measured, name: &str) -> Option<f64> {
    let stage = measured.stages.iter().find(|stage| stage.name == name)?;
    Some(stage.ms)
}

fn phase_ms(measured: &Measured, name: &str) -> Option<f64> {
    let stage = measured
        .prepare
        .stages
        .iter()
        .find(|stage| stage.name == name)?;
    Some(stage.ms)
}

fn frame_table(run: &Run) -> Table {
    let mut columns = vec![
        Column::new("Dataset", "dataset"),
        Column::new("Method", "method"),
        Column::new("Paths", "paths"),
        Column::new("Culling (ms)", "cull_ms"),
        Column::new("Tessellation and drawing (ms)", "tessellate_and_draw_ms"),
        Column::in_page("Frame: mean (ms)"),
        Column::in_page("median, 5 to 95 % (ms)"),
        Column::new("Not measured", "why_not"),
    ];
    columns.extend(frame_columns());
    Table {
        name: "figure-5.4",
        title: "Numbers of figure 5.4, and whole frames of the other methods".to_owned(),
        is_folded: true,
        columns,
        rows: run.results.growth.iter().map(frame_row).collect(),
    }
}

fn frame_row(reading: &Reading) -> Vec<Cell> {
    let measured = reading.row.measured();
    let mut cells = vec![
        Cell::text(reading.dataset.name()),
        Cell::text(reading.row.method.clone()),
        Cell::Count(reading.paths as u64),
        Cell::from(measured.and_then(|m| stage_ms(m, CULL))),
        Cell::from(measured.and_then(|m| stage_ms(m, TESSELLATE_AND_DRAW))),
        Cell::from(measured.map(|m| m.frame_ms.mean)),
        measured.map_or(Cell::Nothing, |m| median_cell(&m.frame_ms)),
        why_not(&reading.row),
    ];
    cells.extend(frame_cells(measured));
    cells
}

/// Figure 5.5; the text of the thesis refers to it as 5.6.
pub(super) fn builds(run: &Run) -> Section {
    let mut blocks = vec![Block::Text(format!(
        "Phases of the build before the first frame of a layout: means of {} runs after one of \
         warm-up. The text of the thesis refers to its figure 5.5 as 5.6.",
        run.plan.repeats
    ))];
    for method in [GRID, GRID_RADIUS] {
        for dataset in Dataset::ALL {
            let chart = build_chart(run, dataset, method);
            if !chart.is_empty() {
                blocks.push(Block::Chart(chart));
            }
        }
    }
    blocks.push(Block::Table(build_table(run)));
    Section {
        id: "initialization",
        title: "Building the grid",
        blocks,
    }
}

fn build_chart(run: &Run, dataset: Dataset, method: &str) -> Chart {
    let curve = Results::curve(&run.results.growth, dataset, method);
    let series = PHASES.map(|(phase, _)| Series {
        name: phase.to_owned(),
        points: curve
            .iter()
            .filter_map(|(reading, m)| Some((reading.at, phase_ms(m, phase)?)))
            .collect(),
    });
    Chart {
        title: format!(
            "Figure 5.5: phases of building {method}, dataset {}",
            dataset.name()
        ),
        x_label: "paths",
        y_label: "mean time (ms)",
        series: series.into(),
    }
}

fn build_table(run: &Run) -> Table {
    let mut columns = vec![
        Column::new("Dataset", "dataset"),
        Column::new("Method", "method"),
        Column::new("Paths", "paths"),
    ];
    columns.extend(PHASES.map(|(phase, key)| Column::new(format!("{phase} (ms)"), key)));
    columns.extend([
        Column::new("Total (ms)", "prepare_ms"),
        Column::new("Wall time (ms)", "prepare_wall_ms"),
        Column::new("Held (MB)", "held_mb"),
        Column::new("Peak (MB)", "peak_mb"),
        Column::new("Not measured", "why_not"),
    ]);
    Table {
        name: "figure-5.5",
        title: "Numbers of figure 5.5, and preparation by the other methods".to_owned(),
        is_folded: true,
        columns,
        rows: run.results.growth.iter().map(build_row).collect(),
    }
}

fn build_row(reading: &Reading) -> Vec<Cell> {
    let measured = reading.row.measured();
    let mut cells = vec![
        Cell::text(reading.dataset.name()),
        Cell::text(reading.row.method.clone()),
        Cell::Count(reading.paths as u64),
    ];
    cells.extend(PHASES.map(|(phase, _)| Cell::from(measured.and_then(|m| phase_ms(m, phase)))));
    cells.extend([
        Cell::from(measured.map(|m| m.prepare.ms)),
        Cell::from(measured.map(|m| m.prepare.wall_ms)),
        Cell::from(measured.map(|m| megabytes(m.held_bytes))),
        Cell::from(measured.map(|m| megabytes(m.peak_bytes))),
        why_not(&reading.row),
    ]);
    cells
}
