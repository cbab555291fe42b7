//! The step that deletes elements.

use guideway_document::Document;

use crate::script::error::StepError;
use crate::script::members::Members;
use crate::script::selection::{NODES, PATHS, STATIONS};
use crate::script::step::{StepKind, Touched, optional};

pub(super) const DELETE: StepKind = StepKind {
    name: "delete",
    meaning: "Deletes elements, and the nodes that only the deleted paths use.",
    members: &[
        PATHS,
        NODES,
        STATIONS,
        optional(
            "with_paths",
            "true or false",
            "Deletes the other paths of the nodes too.",
        ),
    ],
    example: r#"{"do": "delete", "nodes": ["cross-171"], "with_paths": true}"#,
    perform: delete,
};

fn delete(members: &Members<'_>, document: &mut Document) -> Result<Touched, StepError> {
    let elements = members.elements(document)?;
    // Deleted elements have names only before.
    let touched = Touched::of(elements.clone(), document);
    document.delete(&elements, members.flag("with_paths")?)?;
    Ok(touched)
}
