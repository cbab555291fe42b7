//! Steps that reverse paths, and make them one-way or two-way.

use guideway_document::{Document, Elements};
use guideway_layout::Direction;

use crate::script::error::StepError;
use crate::script::members::Members;
use crate::script::selection::PATHS;
use crate::script::step::{StepKind, Touched};

pub(super) const REVERSE: StepKind = StepKind {
    name: "reverse",
    meaning: "Exchanges start and end of paths, with the properties of their ends and sides.",
    members: &[PATHS],
    example: r#"{"do": "reverse", "paths": {"query": "id ~ ring"}}"#,
    perform: |members, document| {
        let paths = members.paths(document)?;
        document.reverse(&paths)?;
        Ok(Touched::of(Elements::of_paths(paths), document))
    },
};

pub(super) const ONE_WAY: StepKind = StepKind {
    name: "one-way",
    meaning: "Lets vehicles drive paths from start to end only.",
    members: &[PATHS],
    example: r#"{"do": "one-way", "paths": "all"}"#,
    perform: |members, document| direct(members, document, Direction::Forward),
};

pub(super) const TWO_WAY: StepKind = StepKind {
    name: "two-way",
    meaning: "Lets vehicles drive paths in both directions.",
    members: &[PATHS],
    example: r#"{"do": "two-way", "paths": {"query": "direction = \"one-way\""}}"#,
    perform: |members, document| direct(members, document, Direction::Both),
};

fn direct(
    members: &Members<'_>,
    document: &mut Document,
    direction: Direction,
) -> Result<Touched, StepError> {
    let paths = members.paths(document)?;
    document.set_direction(&paths, direction)?;
    Ok(Touched::of(Elements::of_paths(paths), document))
}
