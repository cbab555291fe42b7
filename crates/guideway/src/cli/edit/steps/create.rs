//! Steps that create nodes, paths and stations.

use guideway::document::{Document, NewEdge};
use guideway::layout::Direction;
use guideway::scene::Table;

use crate::cli::edit::error::StepError;
use crate::cli::edit::members::Members;
use crate::cli::edit::selection::row_named;
use crate::cli::edit::step::{Member, StepKind, Touched, optional, required};

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

pub(super) const EDGE: StepKind = StepKind {
    name: "create-edge",
    meaning: "Creates a straight path between two nodes.",
    members: &[
        ID,
        required("from", "text", "Name of the first node."),
        required("to", "text", "Name of the last node."),
        optional(
            "like",
            "text",
            "Name of a path whose properties and vehicle types it takes over.",
        ),
        optional(
            "vehicle_types",
            "[text, ...]",
            "Vehicle types that may use it; none means all.",
        ),
        optional(
            "two_way",
            "true or false",
            "Lets vehicles drive in both directions.",
        ),
        LEVEL,
    ],
    example: r#"{"do": "create-edge", "from": "cross-171", "to": "cross-172", "two_way": true}"#,
    perform: create_edge,
};

fn create_edge(members: &Members<'_>, document: &mut Document) -> Result<Touched, StepError> {
    let like = match members.get("like") {
        Some(_) => Some(members.element("like", Table::Paths, document)?),
        None => None,
    };
    let types = members.texts("vehicle_types")?;
    let mut vehicle_types: Vec<String> = types.into_iter().map(str::to_owned).collect();
    if let (Some(like), None) = (like, members.get("vehicle_types")) {
        let entries = document.layout().paths.vehicle_types();
        vehicle_types = entries.of(like as usize).map(str::to_owned).collect();
    }
    let edge = NewEdge {
        id: members.optional_text("id")?.map(str::to_owned),
        start_node: members.element("from", Table::Nodes, document)?,
        end_node: members.element("to", Table::Nodes, document)?,
        curve: None,
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
    let row = document.create_station(id, &nodes, members.optional_point("at")?)?;
    Ok(Touched::one(Table::Stations, row, document))
}
