//! VDA 5050 records: the fields of an order, 1.1 to 3.1, under the names of all versions.

use std::borrow::Cow;

use serde::de::{Deserialize, Deserializer, Error, IgnoredAny, MapAccess};
use serde_json::value::RawValue;

use super::members::{EDGE, HEADER, NODE, POSITION};
use crate::json::{Field, FromJson, Key, record};
use crate::trajectory::Trajectory;

type Text<'a> = Cow<'a, str>;
type List<T> = Vec<Field<T>>;

/// A record with its text.
#[derive(Debug)]
pub(super) struct WithText<'a, T> {
    pub(super) record: T,
    /// The object as written.
    pub(super) text: &'a str,
}

impl<'de, T: FromJson<'de>> FromJson<'de> for WithText<'de, T> {
    fn field<D: Deserializer<'de>>(deserializer: D) -> Result<Field<Self>, D::Error> {
        let text = <&'de RawValue>::deserialize(deserializer)?.get();
        let field: Field<T> = serde_json::from_str(text).map_err(D::Error::custom)?;
        let with_text = |record| Self { record, text };
        Ok(match field {
            Field::Absent => Field::Absent,
            Field::Wrong(kind) => Field::Wrong(kind),
            Field::Converted(record, kind) => Field::Converted(with_text(record), kind),
            Field::Value(record) => Field::Value(with_text(record)),
        })
    }
}

record! { Root<'a> {
    nodes: List<WithText<'a, Node<'a>>> = "nodes",
    edges: List<Edge<'a>> = "edges",
} with HEADER }

record! { Node<'a> {
    id: Text<'a> = "nodeId",
    sequence: f64 = "sequenceId",
    position: Box<Position<'a>> = "nodePosition",
} with NODE }

record! { Position<'a> {
    x: f64 = "x",
    y: f64 = "y",
    map_id: Text<'a> = "mapId",
} with POSITION }

record! { Edge<'a> {
    id: Text<'a> = "edgeId",
    sequence: f64 = "sequenceId",
    start: Text<'a> = "startNodeId",
    end: Text<'a> = "endNodeId",
    trajectory: WithText<'a, Trajectory> = "trajectory",
} with EDGE }
