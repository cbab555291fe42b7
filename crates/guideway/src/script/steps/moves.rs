//! Steps that move, turn, mirror and scale elements.

use guideway_document::{Document, Neighbors};
use guideway_scene::Table;
use guideway_spline::{Affine, Point};

use crate::script::error::StepError;
use crate::script::members::Members;
use crate::script::selection::{NODES, PATHS, STATIONS};
use crate::script::step::{Member, StepKind, Touched, optional, required};

const DETACH: Member = optional(
    "detach",
    "true or false",
    "Leaves the paths that share a node alone; else they stretch.",
);

pub(super) const MOVE: StepKind = StepKind {
    name: "move",
    meaning: "Moves elements; their nodes, stations and neighbors follow.",
    members: &[
        PATHS,
        NODES,
        STATIONS,
        required("by", "[x, y] in m", "Distance."),
        DETACH,
    ],
    example: r#"{"do": "move", "nodes": ["cross-171"], "by": [0.5, 0]}"#,
    perform: |members, document| {
        let by = Affine::translation(members.point("by")?);
        transform(members, document, "move", by)
    },
};

pub(super) const TURN: StepKind = StepKind {
    name: "turn",
    meaning: "Turns elements counter-clockwise.",
    members: &[
        PATHS,
        NODES,
        STATIONS,
        required("by", "degrees", "Angle."),
        required("about", "[x, y] in m", "Center."),
        DETACH,
    ],
    example: r#"{"do": "turn", "paths": "all", "by": 90, "about": [0, 0]}"#,
    perform: |members, document| {
        let by = Affine::rotation(members.number("by")?.to_radians(), members.point("about")?);
        transform(members, document, "turn", by)
    },
};

pub(super) const MIRROR: StepKind = StepKind {
    name: "mirror",
    meaning: "Mirrors elements in a line.",
    members: &[
        PATHS,
        NODES,
        STATIONS,
        required("through", "[x, y] in m", "A point of the line."),
        required("along", "degrees", "Direction of the line."),
        DETACH,
    ],
    example: r#"{"do": "mirror", "paths": "all", "through": [0, 0], "along": 90}"#,
    perform: |members, document| {
        let along = members.number("along")?.to_radians();
        let direction = Point::new(along.cos(), along.sin());
        let by = Affine::mirror(members.point("through")?, direction);
        transform(members, document, "mirror", by)
    },
};

pub(super) const SCALE: StepKind = StepKind {
    name: "scale",
    meaning: "Scales elements; properties keep their values.",
    members: &[
        PATHS,
        NODES,
        STATIONS,
        required("by", "factor above 0", "Factor."),
        required("about", "[x, y] in m", "The point that stays."),
        DETACH,
    ],
    example: r#"{"do": "scale", "paths": "all", "by": 1.02, "about": [0, 0]}"#,
    perform: |members, document| {
        let by = members.number("by")?;
        if by <= 0.0 {
            let what = format!("{by} is not above 0");
            return Err(StepError::of_member(
                "by",
                what,
                "Write a factor such as 1.02",
            ));
        }
        let by = Affine::scale(by, by, members.point("about")?);
        transform(members, document, "scale", by)
    },
};

fn transform(
    members: &Members<'_>,
    document: &mut Document,
    name: &'static str,
    by: Affine,
) -> Result<Touched, StepError> {
    let elements = members.elements(document)?;
    let neighbors = match members.flag("detach")? {
        true => Neighbors::Detach,
        false => Neighbors::Follow,
    };
    document.transform(name, &elements, by, neighbors)?;
    Ok(Touched::of(elements, document))
}

pub(super) const MOVE_NODE: StepKind = StepKind {
    name: "move-node",
    meaning: "Moves a node to a position; its paths and stations follow.",
    members: &[
        required("node", "text", "Name of the node."),
        required("to", "[x, y] in m", "New position."),
    ],
    example: r#"{"do": "move-node", "node": "cross-171", "to": [90, 21]}"#,
    perform: move_node,
};

fn move_node(members: &Members<'_>, document: &mut Document) -> Result<Touched, StepError> {
    let node = members.element("node", Table::Nodes, document)?;
    document.move_node(node, members.point("to")?)?;
    Ok(Touched::one(Table::Nodes, node, document))
}
