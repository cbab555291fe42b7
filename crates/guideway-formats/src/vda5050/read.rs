//! VDA 5050 reader: parses one order or several, and maps them to a layout.

use guideway_layout::{Code, Layout, Place};

use super::map::version_of;
use super::mapper::Mapper;
use super::model::Root;
use super::places::Places;
use crate::json::{self, Field};
use crate::source::Source;
use crate::{Problem, ReadError, text};

/// Reads an order, an array or a log of orders.
///
/// # Errors
/// When the text is not JSON, its root is not that of an order, or a limit is exceeded.
pub(crate) fn read(source: Source<'_>, bytes: &[u8]) -> Result<Layout, ReadError> {
    let text = text::decode_utf8(&source, bytes)?;
    let raw = json::documents(text);
    let documents: Vec<_> = raw.iter().map(|document| json::payload(document)).collect();
    let mut orders = Vec::with_capacity(documents.len());
    let mut places = Vec::with_capacity(documents.len());
    let mut others = Vec::new();
    for (i, document) in documents.iter().enumerate() {
        match order(&source, text, document) {
            Ok(root) => {
                orders.push(root);
                places.push(Places::of(text, raw[i], document));
            }
            // The log of a client has messages of all kinds.
            Err(error) if matches!(error.problem, Problem::Structure { .. }) => {
                others.push((i, error));
            }
            Err(error) => return Err(error),
        }
    }
    if orders.is_empty() {
        let first = others.into_iter().next().map(|(_, error)| error);
        let nothing = || source.fail(not_an_order("the root", "an order", "no object"));
        return Err(first.unwrap_or_else(nothing));
    }
    let version = version_of(&orders[0]);
    let mapper = Mapper::new(source, bytes.len(), version);
    let mut layout = mapper.map(&orders, &places)?;
    for (i, error) in others {
        let place = || Place::element(format!("message {}", i + 1));
        let remedy = "It is left out; Guideway reads orders";
        let diagnostics = &mut layout.diagnostics;
        diagnostics.push(Code::NotDrawn, place, || error.problem.to_string(), remedy);
    }
    let only = (documents.len() == 1).then(|| documents[0].as_ref());
    json::find_lines(&mut layout, text, only);
    Ok(layout)
}

/// Parses an order, which is `text` or a part of the whole text.
fn order<'t>(source: &Source<'_>, whole: &str, text: &'t str) -> Result<Root<'t>, ReadError> {
    let Field::Value(root) = json::parse_part::<Root<'_>>(source, whole, text)? else {
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
        let kinds = MESSAGES.iter();
        let found = kinds.filter(|(key, _)| text.contains(&format!("\"{key}\"")));
        let found = found.map(|(_, kind)| *kind).next();
        let found = found.unwrap_or("an object with neither");
        return Err(source.fail(not_an_order("the root", expected, found)));
    }
    Ok(root)
}

/// Members of other messages of VDA 5050, and the names of the messages.
const MESSAGES: [(&str, &str); 7] = [
    ("nodeStates", "a state message"),
    ("instantActions", "a message of instant actions"),
    ("typeSpecification", "a factsheet"),
    ("connectionState", "a connection message"),
    ("agvPosition", "a visualization message"),
    ("mobileRobotPosition", "a visualization message"),
    // Their name since 2.0; an order has actions too, but beside its nodes.
    ("actions", "a message of instant actions"),
];

fn not_an_order(element: &str, expected: &str, found: &str) -> Problem {
    Problem::Structure {
        place: Place::element(element),
        expected: expected.into(),
        found: found.into(),
    }
}
