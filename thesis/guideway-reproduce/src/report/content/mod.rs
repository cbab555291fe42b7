//! What the page says, section by section, from a run alone.

mod about;
mod growth;
mod most_paths;
mod views;
mod work;

use super::chart::Chart;
use super::table::{Cell, Column, Table};
use crate::reproduce::names::TESSELLATION;
use crate::reproduce::{Finding, Picture, Run, findings};
use guideway_bench::{Dataset, Measured, Row, Summary};

/// One section of the page.
pub(crate) struct Section {
    /// Anchor.
    pub(crate) id: &'static str,
    pub(crate) title: &'static str,
    pub(crate) blocks: Vec<Block>,
}

pub(crate) enum Block {
    Text(String),
    Findings(Vec<Finding>),
    Table(Table),
    Chart(Chart),
    /// A figure of pictures: its caption, and the pictures with theirs.
    Pictures(String, Vec<Picture>),
}

/// All sections in reading order.
pub(crate) fn sections(run: &Run) -> Vec<Section> {
    vec![
        Section {
            id: "findings",
            title: "Findings",
            blocks: vec![
                Block::Text(
                    "What the thesis says, and what the numbers of this run say to it. Every verdict \
                     is computed from the tables below and holds for this machine only."
                        .to_owned(),
                ),
                Block::Findings(findings(run)),
            ],
        },
        most_paths::section(run),
        views::occupancy(run),
        datasets(run),
        views::zoom(run),
        growth::frames(run),
        growth::builds(run),
        appearance(run),
        work::borders(run),
        work::section(run),
        about::section(run),
    ]
}

fn datasets(run: &Run) -> Section {
    Section {
        id: "datasets",
        title: "The datasets",
        blocks: vec![
            Block::Text(
                "The thesis' D1 is a real site that is not public, its D2 is made from it. Here both are \
                 generated: D1 has the shape of a site, hall beside hall; D2 throws curves over one field \
                 until they overlap everywhere."
                    .to_owned(),
            ),
            pictures(run, "5.1", "Figure 5.1: dataset D1"),
            pictures(run, "5.2", "Figure 5.2: dataset D2"),
        ],
    }
}

fn appearance(run: &Run) -> Section {
    Section {
        id: "appearance",
        title: "Path appearance",
        blocks: vec![
            Block::Text(
                "Coverage that fades over the edge of a line (smooth), and edges that do not fade. Figure \
                 5.7 shows the middle of figure 5.6 with every pixel enlarged."
                    .to_owned(),
            ),
            pictures(run, "5.6", "Figure 5.6: paths with smooth edges and without"),
            pictures(run, "5.7", "Figure 5.7: the same, enlarged"),
        ],
    }
}

fn pictures(run: &Run, figure: &str, caption: &str) -> Block {
    let own = run.results.pictures.iter().filter(|p| p.figure == figure);
    Block::Pictures(caption.to_owned(), own.cloned().collect())
}

/// Milliseconds as the page shows them.
fn median_cell(summary: &Summary) -> Cell {
    Cell::Range([summary.median, summary.p5, summary.p95])
}

/// The frame times of one row for the file, in full.
const FRAME_KEYS: [&str; 6] = [
    "frame_mean_ms",
    "frame_median_ms",
    "frame_p5_ms",
    "frame_p95_ms",
    "frame_spread",
    "wall_median_ms",
];

fn frame_columns(prefix: &str) -> Vec<Column> {
    let name = |key: &&str| Column::in_file(format!("{prefix}{key}"));
    FRAME_KEYS.iter().map(name).collect()
}

/// The cells under [`FRAME_KEYS`].
fn frame_cells(measured: Option<&Measured>) -> Vec<Cell> {
    let value = |of: fn(&Measured) -> f64| Cell::from(measured.map(of));
    vec![
        value(|m| m.frame_ms.mean),
        value(|m| m.frame_ms.median),
        value(|m| m.frame_ms.p5),
        value(|m| m.frame_ms.p95),
        value(|m| m.frame_ms.spread),
        value(|m| m.wall_ms.median),
    ]
}

/// Why a row was not measured; nothing where it was.
fn why_not(row: &Row) -> Cell {
    match &row.outcome {
        guideway_bench::Outcome::Measured(_) => Cell::Nothing,
        guideway_bench::Outcome::WhyNot(why) => Cell::text(why.clone()),
    }
}

/// A warning beside tessellation on chips that are built to compute: an H100 or H200 has 66 or more
/// texture-processing clusters, of which two rasterize triangles.
fn computes_only(run: &Run) -> Option<Block> {
    let devices = run.methods.iter().filter_map(|method| {
        let is_raster = method.method.starts_with(TESSELLATION);
        method.device.as_deref().filter(|_| is_raster)
    });
    let mut odd = devices.filter(|device| device.contains("H100") || device.contains("H200"));
    odd.next().map(|device| {
        Block::Text(format!(
            "Mind the device: {device} is built to compute, and only two of its clusters take part in \
             drawing triangles and lines. Its tessellation does not compare with its compute here."
        ))
    })
}

/// Readings of one dataset, one list a method, in the order of the plan.
fn by_method<'a, T>(
    run: &'a Run,
    rows: &'a [T],
    dataset: Dataset,
    key: impl Fn(&T) -> (Dataset, &Row),
) -> Vec<(&'a str, Vec<&'a T>)> {
    let of = |method: &'a String| {
        let own = rows.iter().filter(|row| {
            let (own, row) = key(row);
            own == dataset && row.method == *method
        });
        (method.as_str(), own.collect())
    };
    run.plan.methods.iter().map(of).collect()
}
