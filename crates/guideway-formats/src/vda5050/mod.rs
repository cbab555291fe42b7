//! Orders of VDA 5050, the interface between a fleet control and its vehicles: JSON, meters, y up.
//!
//! 1.1 to 2.1 name the nodes of an edge; from 3.0 on, an edge lies between the nodes whose `sequenceId`
//! is one less and one more than its own. The keys tell the two apart, and not the version stated.

mod edges;
mod map;
mod model;

use guideway_layout::{Layout, Place};

use self::map::Mapper;
use self::model::Root;
use crate::json::{self, Field};
use crate::source::Source;
use crate::{Problem, ReadError, text};

/// Reads an order.
pub(crate) fn read(source: Source<'_>, bytes: &[u8]) -> Result<Layout, ReadError> {
    let text = text::decode_utf8(&source, bytes)?;
    let Field::Value(root) = json::parse::<Root<'_>>(&source, text)? else {
        return Err(source.fail(not_an_order("the root", "an object", "something else")));
    };
    let lists = [
        ("nodes", root.nodes.is_absent(), root.nodes.wrong_kind()),
        ("edges", root.edges.is_absent(), root.edges.wrong_kind()),
    ];
    for (key, _, wrong) in lists {
        if let Some(kind) = wrong {
            return Err(source.fail(not_an_order(key, "a list", &kind.to_string())));
        }
    }
    if lists.iter().all(|(_, absent, _)| *absent) {
        let expected = "`nodes` and `edges` of a VDA 5050 order";
        return Err(source.fail(not_an_order("the root", expected, "an object with neither")));
    }
    let mut layout = Mapper::new(source, bytes.len()).map(&root)?;
    json::add_lines(&mut layout, text);
    Ok(layout)
}

fn not_an_order(element: &str, expected: &str, found: &str) -> Problem {
    Problem::Structure {
        place: Place::element(element),
        expected: expected.into(),
        found: found.into(),
    }
}
