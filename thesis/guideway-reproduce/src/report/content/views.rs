//! Tables 5.2 and 5.3 and figure 5.3: frame times against pixels inside the grid and magnification.

use super::blocks::pictures;
use super::cells::{frame_cells, frame_columns, median_cell, why_not};
use super::section::{Block, Section};
use crate::report::chart::{Chart, Series};
use crate::reproduce::{Reading, Results, Run, names, thesis};
use guideway_bench::Dataset;
use guideway_bench::format::{count, percent};
use guideway_bench::page::{Cell, Column, Table};

/// Tables 5.2 and 5.3.
pub(super) fn occupancy(run: &Run) -> Section {
    let paths = Dataset::ALL.map(|d| count(run.plan.view_paths(d) as u64));
    let text = format!(
        "Frame times of {} paths of D1 and {} of D2, with the view panned until part of its pixels \
         is outside the bounds of all curves. The share inside is counted per pixel. The times of \
         the thesis are from another machine ({}); the thesis does not state their number of \
         paths.",
        paths[0],
        paths[1],
        thesis::MACHINE
    );
    let tables = Dataset::ALL.map(|dataset| Block::Table(occupancy_table(run, dataset)));
    Section {
        id: "occupancy",
        title: "Frame time and pixels inside the grid",
        blocks: std::iter::once(Block::Text(text)).chain(tables).collect(),
    }
}

fn occupancy_table(run: &Run, dataset: Dataset) -> Table {
    let (name, number) = match dataset {
        Dataset::D1 => ("table-5.2", "5.2"),
        Dataset::D2 => ("table-5.3", "5.3"),
    };
    let mut columns = vec![
        Column::new("Method", "method"),
        Column::in_page("Inside the grid"),
        Column::in_file("share_inside"),
        Column::in_page("Frame: mean (ms)"),
        Column::in_page("median, 5 to 95 % (ms)"),
        Column::in_page("Wall time (ms)"),
        Column::new("Tests per pixel", "tests_a_pixel"),
        Column::new("Thesis (ms)", "thesis_ms"),
        Column::new("Not measured", "why_not"),
    ];
    columns.extend(frame_columns());
    let mut rows = Vec::new();
    let thesis_ms = thesis::OCCUPANCY_MS.iter().find(|(d, _)| *d == dataset);
    for method in &run.plan.methods {
        let readings = run.results.occupancy.iter();
        let own = readings.filter(|r| r.dataset == dataset && r.row.method == *method);
        for (i, reading) in own.enumerate() {
            let thesis_ms = thesis_ms.and_then(|(_, ms)| ms.get(i).copied());
            rows.push(occupancy_row(
                reading,
                thesis_ms.filter(|_| method == names::GRID),
            ));
        }
    }
    Table {
        name,
        title: format!(
            "Table {number}: frame time under varying grid occupancy, dataset {}",
            dataset.name()
        ),
        is_folded: false,
        columns,
        rows,
    }
}

fn occupancy_row(reading: &Reading, thesis_ms: Option<f64>) -> Vec<Cell> {
    let measured = reading.row.measured();
    let mut cells = vec![
        Cell::text(reading.row.method.clone()),
        Cell::text(percent(reading.at)),
        Cell::Number(reading.at),
        Cell::from(measured.map(|m| m.frame_ms.mean)),
        measured.map_or(Cell::Nothing, |m| median_cell(&m.frame_ms)),
        Cell::from(measured.map(|m| m.wall_ms.median)),
        Cell::from(measured.and_then(|m| m.work.tests_a_pixel)),
        Cell::from(thesis_ms),
        why_not(&reading.row),
    ];
    cells.extend(frame_cells(measured));
    cells
}

/// Figure 5.3.
pub(super) fn zoom(run: &Run) -> Section {
    let mut blocks = vec![Block::Text(
        "At 10 % all paths are in view; at 200 % they are 20 times as large, about the densest \
         point of the layout."
            .to_owned(),
    )];
    for dataset in Dataset::ALL {
        let series = run.plan.methods.iter().map(|method| Series {
            name: method.clone(),
            points: Results::curve(&run.results.zoom, dataset, method)
                .into_iter()
                .map(|(reading, m)| (reading.at * 100.0, m.frame_ms.mean))
                .collect(),
        });
        blocks.push(Block::Chart(Chart {
            title: format!(
                "Figure 5.3: frame time against magnification, dataset {}",
                dataset.name()
            ),
            x_label: "magnification (%)",
            y_label: "mean frame time (ms)",
            series: series.filter(|s| !s.points.is_empty()).collect(),
        }));
    }
    blocks.push(Block::Table(zoom_table(run)));
    blocks.push(pictures(run, "5.3", "Figure 5.3: the four views"));
    Section {
        id: "magnification",
        title: "Frame time and magnification",
        blocks,
    }
}

fn zoom_table(run: &Run) -> Table {
    let mut columns = vec![
        Column::new("Dataset", "dataset"),
        Column::new("Method", "method"),
        Column::in_page("Magnification"),
        Column::in_file("magnification"),
        Column::in_file("paths"),
        Column::new("Paths in view", "paths_drawn"),
        Column::in_page("Frame: mean (ms)"),
        Column::in_page("median, 5 to 95 % (ms)"),
        Column::new("Tests per pixel", "tests_a_pixel"),
        Column::new("Not measured", "why_not"),
    ];
    columns.extend(frame_columns());
    let row = |reading: &Reading| {
        let measured = reading.row.measured();
        let mut cells = vec![
            Cell::text(reading.dataset.name()),
            Cell::text(reading.row.method.clone()),
            Cell::text(percent(reading.at)),
            Cell::Number(reading.at),
            Cell::Count(reading.paths as u64),
            Cell::from(measured.map(|m| m.paths.drawn)),
            Cell::from(measured.map(|m| m.frame_ms.mean)),
            measured.map_or(Cell::Nothing, |m| median_cell(&m.frame_ms)),
            Cell::from(measured.and_then(|m| m.work.tests_a_pixel)),
            why_not(&reading.row),
        ];
        cells.extend(frame_cells(measured));
        cells
    };
    Table {
        name: "figure-5.3",
        title: "Numbers of figure 5.3".to_owned(),
        is_folded: true,
        columns,
        rows: run.results.zoom.iter().map(row).collect(),
    }
}
