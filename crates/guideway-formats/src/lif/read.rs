//! LIF reader: parses the root object, maps it to a layout, and keeps the text, so that a save
//! changes the edited parts only.

use guideway_layout::{Layout, Limits, Place};

use super::mapper::Mapper;
use super::model::Root;
use crate::json::{self, Field};
use crate::source::Source;
use crate::{Problem, ReadError, ReadOptions, text};

/// Largest text that a layout keeps.
const MAX_KEPT_BYTES: usize = 256 << 20;

/// Keys that the error of a file that is not LIF names.
const MAX_KEYS: usize = 5;

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
        let keys = root.attributes.other_keys().take(MAX_KEYS);
        let keys: Vec<String> = keys.map(|key| key.chars().take(40).collect()).collect();
        let found = match keys.as_slice() {
            [] => "an object with neither".to_owned(),
            keys => format!("an object with {}", text::printable(&keys.join(", "))),
        };
        let expected = "`layouts` (LIF 1.0), `origins` (LIF 2.0) or the keys of another format";
        return Err(source.fail(not_lif("the root", expected, found)));
    }
    // Without the byte order mark, which the kept text begins with.
    let before = bytes.len() - text.len();
    let whole = std::str::from_utf8(bytes).unwrap_or(text);
    let mut layout = Mapper::new(source, bytes.len(), before).map(&root, text)?;
    layout.provenance.text = (bytes.len() <= MAX_KEPT_BYTES).then(|| whole.into());
    json::find_lines(&mut layout, whole, Some(text));
    Ok(layout)
}

/// Reads the kept text of a layout again, without limits.
pub(super) fn read_again(layout: &Layout) -> Option<Layout> {
    let options = ReadOptions {
        limits: Limits {
            file_bytes: u64::MAX,
            paths: u64::MAX,
            elements: u64::MAX,
            text_bytes: usize::MAX,
            diagnostics_per_code: 0,
            ..Limits::default()
        },
        ..ReadOptions::default()
    };
    let source = Source {
        name: &layout.provenance.source,
        options: &options,
    };
    read(source, layout.provenance.text.as_deref()?.as_bytes()).ok()
}

fn not_lif(element: &str, expected: &str, found: String) -> Problem {
    Problem::Structure {
        place: Place::element(element),
        expected: expected.into(),
        found,
    }
}
