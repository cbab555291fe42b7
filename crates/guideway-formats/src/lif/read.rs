//! LIF reader: parses the root object, maps it to a layout, and keeps the text for a later write.

use guideway_layout::{Layout, Place};

use super::mapper::Mapper;
use super::model::Root;
use crate::json::{self, Field};
use crate::source::Source;
use crate::{Problem, ReadError, text};

/// Largest text that a layout keeps, so that a write can pass through the members that the model
/// does not hold.
const MAX_KEPT_BYTES: usize = 256 << 20;

/// Reads a LIF file.
///
/// # Errors
/// When the text is not JSON, its root is not that of LIF, or a limit is exceeded.
pub(crate) fn read(source: Source<'_>, bytes: &[u8]) -> Result<Layout, ReadError> {
    let text = text::decode_utf8(&source, bytes)?;
    let root = match json::parse::<Root<'_>>(&source, text)? {
        Field::Value(root) => root,
        other => {
            let found = other
                .wrong_type()
                .map_or("nothing".into(), |k| k.to_string());
            return Err(source.fail(not_lif("the root", "an object", found)));
        }
    };
    for (field, wrong) in [
        ("layouts", root.layouts.wrong_type()),
        ("origins", root.origins.wrong_type()),
    ] {
        if let Some(kind) = wrong {
            return Err(source.fail(not_lif(field, "an array", kind.to_string())));
        }
    }
    if root.layouts.is_absent() && root.origins.is_absent() {
        let found = match root.other_keys.as_slice() {
            [] => "an object with neither".to_owned(),
            keys => format!("an object with {}", text::printable(&keys.join(", "))),
        };
        let expected = "`layouts` (LIF 1.0), `origins` (LIF 2.0) or the keys of another format";
        return Err(source.fail(not_lif("the root", expected, found)));
    }
    let mut layout = Mapper::new(source, bytes.len()).map(&root, text)?;
    if text.len() <= MAX_KEPT_BYTES {
        layout.provenance.text = Some(text.into());
    }
    json::add_line_numbers(&mut layout, text);
    Ok(layout)
}

fn not_lif(element: &str, expected: &str, found: String) -> Problem {
    Problem::Structure {
        place: Place::element(element),
        expected: expected.into(),
        found,
    }
}
