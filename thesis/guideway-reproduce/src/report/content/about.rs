//! The last section: describes the measurement, and lists the methods and the parts of the run.

use super::section::{Block, Section};
use crate::reproduce::{MethodFacts, PartFacts, Run};
use guideway_bench::format::{count, digits, megabytes};
use guideway_bench::page::{Cell, Column, Table};

/// The section about the measurement.
pub(super) fn section(run: &Run) -> Section {
    let plan = &run.plan;
    let settings = format!(
        "Pictures have {} x {} pixels. The frame time ends when the picture is complete on the \
         device, by the clock of the device if it has one, without the transfer to the host; the \
         wall time includes transfers. Each view starts with one frame and {} more of warm-up, \
         followed by {} measured frames; after {} s of drawing, one measured frame suffices. The \
         tables show means, as in the thesis, and medians with the 5th and 95th percentile. Lines \
         have the width of the thesis: a radius of 1.5 pixels, clamped to 2 to 150 mm. Methods run \
         one after the other, each with up to {} MB of memory; `guideway bench` interleaves them.",
        plan.size_px[0],
        plan.size_px[1],
        plan.warmup,
        plan.frames,
        digits(plan.enough_ms / 1e3),
        count(megabytes(plan.memory_bytes) as u64),
    );
    let mut blocks = vec![Block::Text(settings)];
    if run.sessions.len() > 1 {
        let sessions = run.sessions.len();
        blocks.push(Block::Text(format!(
            "The run took {sessions} sessions on the same devices; each continued the one before."
        )));
    }
    blocks.extend([Block::Table(methods(run)), Block::Table(parts(run))]);
    Section {
        id: "about",
        title: "Method of measurement",
        blocks,
    }
}

fn methods(run: &Run) -> Table {
    let row = |method: &MethodFacts| {
        let optional = |text: &Option<String>| text.as_ref().map_or(Cell::Nothing, Cell::text);
        vec![
            Cell::text(method.method.clone()),
            optional(&method.device),
            optional(&method.why_not),
        ]
    };
    Table {
        name: "methods",
        title: "Methods and the devices they ran on".to_owned(),
        is_folded: false,
        columns: vec![
            Column::new("Method", "method"),
            Column::new("Device", "device"),
            Column::new("Does not run here", "why_not"),
        ],
        rows: run.methods.iter().map(row).collect(),
    }
}

fn parts(run: &Run) -> Table {
    let row = |part: &PartFacts| {
        let note = match (&part.failure, part.is_cut) {
            (Some(failure), _) => failure.clone(),
            (None, true) => {
                "the time limit cut this part: some measurements are missing".to_owned()
            }
            (None, false) => String::new(),
        };
        vec![
            Cell::text(part.name.clone()),
            Cell::Number(part.elapsed_s),
            Cell::text(note),
        ]
    };
    Table {
        name: "parts",
        title: "Parts of the run".to_owned(),
        is_folded: false,
        columns: vec![
            Column::new("Part", "part"),
            Column::new("Took (s)", "elapsed_s"),
            Column::new("Note", "note"),
        ],
        rows: run.parts.iter().map(row).collect(),
    }
}
