//! Steps that create nodes, paths on lines, arcs and splines, and stations.

use guideway_document::{Document, NewEdge, Shape};
use guideway_layout::Direction;
use guideway_scene::Table;

use crate::script::error::StepError;
use crate::script::members::Members;
use crate::script::selection::row_named;
use crate::script::step::{Member, StepKind, Touched, optional, required};

const ID: Member = optional("id", "text", "Name; without it, one is made.");
const LEVEL: Member = optional("level", "text", "Name of its level.");

pub(super) const NODE: StepKind = StepKind {
    name: "create-node",
    meaning: "Creates a node.",
    members: &[ID, required("at", "[x, y] in m", "Position."), LEVEL],
    example: r#"{"do": "create-node", "id": "new", "at": [12.5, -3], "level": "hall"}"#,
    perform: create_node,
};

fn create_node(members: &Members<'_>, document: &mut Document) -> Result<Touched, StepError> {
    let id = members.optional_text("id")?;
    let level = members.level("level", document)?;
    let row = document.create_node(id, members.point("at")?, level)?;
    Ok(Touched::one(Table::Nodes, row, document))
}

const FROM: Member = required("from", "text", "Name of the first node.");
const TO: Member = required("to", "text", "Name of the last node.");
const LIKE: Member = optional(
    "like",
    "text",
    "Name of a path whose properties and vehicle types it takes over.",
);
const TYPES: Member = optional(
    "vehicle_types",
    "[text, ...]",
    "Vehicle types that may use it; none means all.",
);
const TWO_WAY: Member = optional(
    "two_way",
    "true or false",
    "Lets vehicles drive in both directions.",
);

pub(super) const EDGE: StepKind = StepKind {
    name: "create-edge",
    meaning: "Creates a straight path between two nodes.",
    members: &[ID, FROM, TO, LIKE, TYPES, TWO_WAY, LEVEL],
    example: r#"{"do": "create-edge", "from": "cross-171", "to": "cross-172", "two_way": true}"#,
    perform: |members, document| create_edge(members, document, None),
};

pub(super) const ARC: StepKind = StepKind {
    name: "create-arc",
    meaning: "Creates a path on an arc that continues a path, or leads through a point.",
    members: &[
        ID,
        FROM,
        TO,
        optional(
            "along",
            "text",
            "Name of a path at the first node, which the arc continues.",
        ),
        optional(
            "through",
            "[x, y] in m",
            "A point of the arc, if it continues no path.",
        ),
        LIKE,
        TYPES,
        TWO_WAY,
        LEVEL,
    ],
    example: r#"{"do": "create-arc", "from": "cross-171", "to": "cross-172", "through": [95, 30]}"#,
    perform: |members, document| {
        let along = members.optional_element("along", Table::Paths, document)?;
        let shape = match (along, members.optional_point("through")?) {
            (Some(along), None) => Shape::Arc { along },
            (None, Some(through)) => Shape::ArcThrough(through),
            _ => {
                let what = "an arc needs `along` or `through`, and not both";
                return Err(StepError::of_member("along", what, "Write one of them"));
            }
        };
        create_edge(members, document, Some(shape))
    },
};

pub(super) const SPLINE: StepKind = StepKind {
    name: "create-spline",
    meaning: "Creates a path on a curve through points, without kinks.",
    members: &[
        ID,
        FROM,
        TO,
        required(
            "through",
            "[[x, y], ...] in m",
            "Points between the nodes, in order.",
        ),
        optional(
            "along",
            "text",
            "Name of a path at the first node, which the curve continues.",
        ),
        optional(
            "into",
            "text",
            "Name of a path at the last node, which continues the curve.",
        ),
        LIKE,
        TYPES,
        TWO_WAY,
        LEVEL,
    ],
    example: r#"{"do": "create-spline", "from": "cross-171", "to": "cross-172",
 "through": [[95, 30]]}"#,
    perform: |members, document| {
        let along = members.optional_element("along", Table::Paths, document)?;
        let into = members.optional_element("into", Table::Paths, document)?;
        let shape = Shape::Spline {
            through: members.points("through")?,
            along: [along, into],
        };
        create_edge(members, document, Some(shape))
    },
};

fn create_edge(
    members: &Members<'_>,
    document: &mut Document,
    shape: Option<Shape>,
) -> Result<Touched, StepError> {
    let like = members.optional_element("like", Table::Paths, document)?;
    let types = members.texts("vehicle_types")?;
    let mut vehicle_types: Vec<String> = types.into_iter().map(str::to_owned).collect();
    if let (Some(like), None) = (like, members.get("vehicle_types")) {
        let entries = document.layout().paths.vehicle_types();
        vehicle_types = entries.of(like as usize).map(str::to_owned).collect();
    }
    let start_node = members.element("from", Table::Nodes, document)?;
    let end_node = members.element("to", Table::Nodes, document)?;
    let curve = shape.map(|shape| document.curve_between([start_node, end_node], &shape));
    let edge = NewEdge {
        id: members.optional_text("id")?.map(str::to_owned),
        start_node,
        end_node,
        curve: curve.transpose()?,
        direction: match members.flag("two_way")? {
            true => Direction::Both,
            false => Direction::Forward,
        },
        level: members.level("level", document)?,
        vehicle_types,
        attributes_of: like,
    };
    let row = document.create_edge(&edge)?;
    Ok(Touched::one(Table::Paths, row, document))
}

pub(super) const STATION: StepKind = StepKind {
    name: "create-station",
    meaning: "Creates a station that nodes serve.",
    members: &[
        ID,
        required("nodes", "[text, ...]", "Names of the nodes."),
        optional(
            "at",
            "[x, y] in m",
            "Position; without it, that of the first node.",
        ),
    ],
    example: r#"{"do": "create-station", "id": "PICK-07", "nodes": ["cross-171"]}"#,
    perform: create_station,
};

fn create_station(members: &Members<'_>, document: &mut Document) -> Result<Touched, StepError> {
    let id = members.optional_text("id")?;
    let nodes = members.texts("nodes")?.into_iter();
    let nodes = nodes.map(|name| row_named("nodes", Table::Nodes, name, document));
    let nodes: Vec<u32> = nodes.collect::<Result<_, _>>()?;
    let at_m = members.optional_point("at")?;
    let row = document.create_station(id, &nodes, at_m, None)?;
    Ok(Touched::one(Table::Stations, row, document))
}
