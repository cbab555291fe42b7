//! Builds all sections of the page from a run.

use super::blocks::pictures;
use super::section::{Block, Section};
use super::{about, growth, most_paths, views, work};
use crate::reproduce::{Run, findings};

/// All sections of the page in reading order.
pub(crate) fn sections(run: &Run) -> Vec<Section> {
    vec![
        Section {
            id: "findings",
            title: "Findings",
            blocks: vec![
                Block::Text(
                    "The claims of the thesis, each with a verdict of this run. Every verdict \
                     derives from the tables below and holds for this machine only."
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
        work::changes(run),
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
                "D1 of the thesis is a real site that is not public, and D2 derives from it. This \
                 reproduction generates both: D1 has halls with aisles, roads and docks; D2 \
                 scatters curves over one field with heavy overlap."
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
                "Lines with smooth edges (anti-aliasing) and with hard edges. Figure 5.7 shows the \
                 middle of figure 5.6 with enlarged pixels."
                    .to_owned(),
            ),
            pictures(run, "5.6", "Figure 5.6: paths with smooth edges and without"),
            pictures(run, "5.7", "Figure 5.7: the same, enlarged"),
        ],
    }
}
