use super::{Block, Section};
use crate::report::table::{Cell, Column, Table};
use crate::reproduce::{MethodFacts, PartFacts, Run};
use guideway_bench::format::{count, digits, megabytes};

/// Where and how all of it was measured.
pub(super) fn section(run: &Run) -> Section {
    let plan = &run.plan;
    let how = format!(
        "Pictures of {} x {} pixels. A frame's time runs until the picture is complete where it was made, by \
         the device's clock where the method has one, without fetching it; the time seen from outside has the \
         way there and back. Of each view a first frame and {} more do not count, then {} do; a method \
         that has drawn one view for {} s ends with one frame that counts. Means as in the thesis, medians \
         with the range from the 5th to the 95th percentile beside them. Lines are as wide as in the thesis: \
         a radius of 1.5 pixels held within 2 to 150 mm. Methods are measured one after the other, each \
         with up to {} MB of memory; `guideway bench` lets them take turns.",
        plan.size_px[0],
        plan.size_px[1],
        plan.warmup,
        plan.frames,
        digits(plan.enough_ms / 1e3),
        count(megabytes(plan.memory_bytes) as u64),
    );
    let mut blocks = vec![Block::Text(how)];
    if run.sittings.len() > 1 {
        let sittings = run.sittings.len();
        blocks.push(Block::Text(format!(
            "It took {sittings} sittings on the same devices; each measured what those before it had left out."
        )));
    }
    blocks.extend([Block::Table(methods(run)), Block::Table(parts(run))]);
    Section {
        id: "about",
        title: "How it was measured",
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
            (None, true) => "its time was over: some of it is missing".to_owned(),
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
