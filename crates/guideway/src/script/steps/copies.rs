//! Steps that copy elements, and paste elements of another file.

use std::sync::Arc;

use guideway_document::{CopiesOf, Document};
use guideway_formats::read_file;
use guideway_scene::SceneOptions;
use guideway_spline::Affine;

use crate::script::error::StepError;
use crate::script::members::Members;
use crate::script::selection::{NODES, PATHS, STATIONS};
use crate::script::step::{StepKind, Touched, optional, required};

pub(super) const COPY: StepKind = StepKind {
    name: "copy",
    meaning: "Copies elements with their nodes and stations; names get numbers.",
    members: &[
        PATHS,
        NODES,
        STATIONS,
        optional("count", "whole number", "Number of copies; 1 without it."),
        required("step", "[x, y] in m", "Distance from copy to copy."),
    ],
    example: r#"{"do": "copy", "paths": {"query": "id ~ ring"}, "count": 2, "step": [0, 60]}"#,
    perform: copy,
};

fn copy(members: &Members<'_>, document: &mut Document) -> Result<Touched, StepError> {
    let elements = members.elements(document)?;
    let count = members.count("count", CopiesOf::MAX_COUNT)?;
    let copied = document.copy(&elements, count, members.point("step")?)?;
    Ok(Touched::of(copied, document))
}

pub(super) const PASTE: StepKind = StepKind {
    name: "paste",
    meaning: "Adds elements of another file, with properties and vehicle types.",
    members: &[
        required("from", "text", "The file, from the folder of the script."),
        PATHS,
        NODES,
        STATIONS,
        optional(
            "turn",
            "degrees",
            "Angle by which to turn them about the origin first.",
        ),
        optional("by", "[x, y] in m", "Distance by which to move them."),
        optional(
            "level",
            "text",
            "Level for all of them; else that of the same name.",
        ),
    ],
    example: r#"{"do": "paste", "from": "site.lif.json", "paths": "all", "by": [200, 0]}"#,
    perform: paste,
};

fn paste(members: &Members<'_>, document: &mut Document) -> Result<Touched, StepError> {
    let file = members.file("from")?;
    let failed = |what: String, remedy: &str| StepError::of_member("from", what, remedy);
    let layout = read_file(&file, members.folder.options).map_err(|error| {
        let error = guideway_layout::UserError::from(error);
        failed(error.message, &error.remedy)
    })?;
    let source = Document::new(Arc::new(layout), &SceneOptions::default())
        .map_err(|error| failed(error.to_string(), "Name a layout file"))?;
    let elements = members.elements(&source)?;
    let clip = source.clip(&elements)?;
    let turn = match members.get("turn") {
        Some(_) => members.number("turn")?.to_radians(),
        None => 0.0,
    };
    let by = members.optional_point("by")?.unwrap_or_default();
    let by = Affine::rotation(turn, Default::default()).then(Affine::translation(by));
    let level = members.level("level", document)?;
    let pasted = document.paste(&clip, by, level)?;
    Ok(Touched::of(pasted, document))
}
