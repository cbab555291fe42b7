//! Steps that split, join, weld, straighten, align, distribute and round.

use guideway_document::{AlignTo, Document, Elements, PathSet};
use guideway_scene::Table;

use crate::script::error::StepError;
use crate::script::members::Members;
use crate::script::selection::{NODES, PATHS, row_named};
use crate::script::step::{Member, StepKind, Touched, optional, required};

const NODE: Member = required("node", "text", "Name of the node.");

pub(super) const SPLIT: StepKind = StepKind {
    name: "split",
    meaning: "Splits paths at their places nearest to a point, at a new node.",
    members: &[
        PATHS,
        required("at", "[x, y] in m", "The point."),
        optional("reach", "m", "Greatest distance of a path; 0.1 without it."),
    ],
    example: r#"{"do": "split", "paths": "all", "at": [17, 40]}"#,
    perform: |members, document| {
        let paths = members.paths(document)?;
        let reach_m = members.optional_number("reach")?.unwrap_or(0.1);
        let nodes = document.split_at(&paths, members.point("at")?, reach_m)?;
        Ok(pieces_and(nodes, document))
    },
};

pub(super) const SPLIT_CROSSINGS: StepKind = StepKind {
    name: "split-crossings",
    meaning: "Splits paths of one level where they cross, or one ends on another.",
    members: &[PATHS],
    example: r#"{"do": "split-crossings", "paths": "all"}"#,
    perform: |members, document| {
        let paths = members.paths(document)?;
        let nodes = document.split_at_crossings(&paths)?;
        Ok(pieces_and(nodes, document))
    },
};

pub(super) const JOIN: StepKind = StepKind {
    name: "join",
    meaning: "Makes one path of the two at a node, which goes; their properties must be equal.",
    members: &[NODE],
    example: r#"{"do": "split", "paths": "all", "at": [17, 40]},
{"do": "join", "node": "node"}"#,
    perform: |members, document| {
        let node = members.element("node", Table::Nodes, document)?;
        let path = document.join_at(node)?;
        Ok(Touched::one(Table::Paths, path, document))
    },
};

pub(super) const WELD: StepKind = StepKind {
    name: "weld",
    meaning: "Makes one node of the ends of paths that lie within a distance.",
    members: &[PATHS, required("within", "m", "The distance.")],
    example: r#"{"do": "weld", "paths": ["ring-190--ring-183", "ring-192--ring-193"],
 "within": 3}"#,
    perform: |members, document| {
        let paths = members.paths(document)?;
        let welded = document.weld(&paths, members.number("within")?)?;
        let touched = Touched::of(Elements::of_paths(paths), document);
        Ok(touched.with_lost(welded.values))
    },
};

pub(super) const STRAIGHTEN: StepKind = StepKind {
    name: "straighten",
    meaning: "Replaces paths by the lines between their ends.",
    members: &[PATHS],
    example: r#"{"do": "straighten", "paths": {"query": "id ~ ring"}}"#,
    perform: |members, document| {
        let paths = members.paths(document)?;
        document.straighten(&paths)?;
        Ok(Touched::of(Elements::of_paths(paths), document))
    },
};

pub(super) const ALIGN: StepKind = StepKind {
    name: "align",
    meaning: "Moves nodes onto a line; their paths and stations follow.",
    members: &[
        NODES,
        required(
            "to",
            "\"x\", \"y\" or \"line\"",
            "One x, one y, or the line that fits best.",
        ),
    ],
    example: r#"{"do": "align", "nodes": ["cross-171", "cross-172"], "to": "y"}"#,
    perform: |members, document| {
        let nodes = nodes(members, document)?;
        let to = match members.text("to")? {
            "x" => AlignTo::X,
            "y" => AlignTo::Y,
            "line" => AlignTo::Line,
            other => {
                let what = format!("`{other}` is no line");
                return Err(StepError::of_member(
                    "to",
                    what,
                    "Write \"x\", \"y\" or \"line\"",
                ));
            }
        };
        document.align_nodes(&nodes, to)?;
        Ok(touched_nodes(nodes, document))
    },
};

pub(super) const DISTRIBUTE: StepKind = StepKind {
    name: "distribute",
    meaning: "Moves nodes along the line that fits them best, to even distances.",
    members: &[
        NODES,
        optional(
            "spacing",
            "m",
            "Distance from node to node; without it, the ends stay.",
        ),
    ],
    example: r#"{"do": "distribute", "nodes": ["cross-171", "cross-172"], "spacing": 20}"#,
    perform: |members, document| {
        let nodes = nodes(members, document)?;
        document.distribute_nodes(&nodes, members.optional_number("spacing")?)?;
        Ok(touched_nodes(nodes, document))
    },
};

pub(super) const FILLET: StepKind = StepKind {
    name: "fillet",
    meaning: "Rounds the corner of two tracks at a node by an arc between two nodes.",
    members: &[NODE, required("radius", "m", "Radius of the arc.")],
    example: r#"{"do": "straighten", "paths": ["ring-184--ring-185"]},
{"do": "fillet", "node": "ring-184", "radius": 3}"#,
    perform: |members, document| {
        let node = members.element("node", Table::Nodes, document)?;
        let arcs = document.fillet_at(node, members.number("radius")?)?;
        Ok(Touched::of(Elements::of_paths(arcs), document))
    },
};

/// Nodes in the order of their names in the script.
fn nodes(members: &Members<'_>, document: &Document) -> Result<Vec<u32>, StepError> {
    if members.get("nodes").is_some_and(|value| value.is_array()) {
        let names = members.texts("nodes")?.into_iter();
        return names
            .map(|name| row_named("nodes", Table::Nodes, name, document))
            .collect();
    }
    Ok(members.elements(document)?.nodes.iter().collect())
}

fn touched_nodes(nodes: Vec<u32>, document: &Document) -> Touched {
    let elements = Elements {
        nodes: nodes.into_iter().collect(),
        ..Elements::default()
    };
    Touched::of(elements, document)
}

/// The pieces, which a split selects, and their new nodes.
fn pieces_and(nodes: Vec<u32>, document: &Document) -> Touched {
    let elements = Elements {
        paths: document.selection().clone(),
        nodes: nodes.into_iter().collect::<PathSet>(),
        ..Elements::default()
    };
    Touched::of(elements, document)
}
