//! VDA 5050 reader: parses the root object of an order and maps it to a layout.

use guideway_layout::{Layout, Place};

use super::map::version_of;
use super::mapper::Mapper;
use super::model::Root;
use crate::json::{self, Field};
use crate::source::Source;
use crate::{Problem, ReadError, text};

/// Reads an order.
///
/// # Errors
/// When the text is not JSON, its root is not that of an order, or a limit is exceeded.
pub(crate) fn read(source: Source<'_>, bytes: &[u8]) -> Result<Layout, ReadError> {
    let text = text::decode_utf8(&source, bytes)?;
    let Field::Value(root) = json::parse::<Root<'_>>(&source, text)? else {
        return Err(source.fail(not_an_order("the root", "an object", "something else")));
    };
    let lists = [
        ("nodes", root.nodes.is_absent(), root.nodes.wrong_type()),
        ("edges", root.edges.is_absent(), root.edges.wrong_type()),
    ];
    for (key, _, wrong) in lists {
        if let Some(kind) = wrong {
            return Err(source.fail(not_an_order(key, "an array", &kind.to_string())));
        }
    }
    if lists.iter().all(|(_, absent, _)| *absent) {
        let expected = "`nodes` and `edges` of a VDA 5050 order";
        return Err(source.fail(not_an_order("the root", expected, "an object with neither")));
    }
    let version = version_of(&root);
    let mut layout = Mapper::new(source, bytes.len(), version).map(&root)?;
    json::add_line_numbers(&mut layout, text);
    Ok(layout)
}

fn not_an_order(element: &str, expected: &str, found: &str) -> Problem {
    Problem::Structure {
        place: Place::element(element),
        expected: expected.into(),
        found: found.into(),
    }
}
