//! The Layout Interchange Format of the VDMA: JSON, meters, y up.
//!
//! 1.0 and 2.0 are told apart by their structure, for the version that files state is often not theirs:
//! the official examples of 1.0 say 0.11.0.

mod edges;
mod map;
mod model;
mod rest;
mod write;
mod write_columns;
mod write_edges;
mod write_network;
mod write_objects;

pub(crate) use self::rest::count_beside;
pub use self::write::{WriteOptions, write_layout};
pub use self::write_columns::Version;

use guideway_layout::{Layout, Place};

use self::map::Mapper;
use self::model::Root;
use crate::json::{self, Field};
use crate::source::Source;
use crate::{Problem, ReadError, text};

/// Of a file up to this size, what a layout has not is kept for when it is written again.
const MOST_KEPT_BYTES: usize = 256 << 20;

/// Reads a LIF file.
pub(crate) fn read(source: Source<'_>, bytes: &[u8]) -> Result<Layout, ReadError> {
    let text = text::decode_utf8(&source, bytes)?;
    let root = match json::parse::<Root<'_>>(&source, text)? {
        Field::Value(root) => root,
        other => {
            let found = other
                .wrong_kind()
                .map_or("nothing".into(), |k| k.to_string());
            return Err(source.fail(not_lif("the root", "an object", found)));
        }
    };
    for (field, wrong) in [
        ("layouts", root.layouts.wrong_kind()),
        ("origins", root.origins.wrong_kind()),
    ] {
        if let Some(kind) = wrong {
            return Err(source.fail(not_lif(field, "a list", kind.to_string())));
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
    if text.len() <= MOST_KEPT_BYTES {
        layout.provenance.text = Some(text.into());
    }
    json::add_lines(&mut layout, text);
    Ok(layout)
}

fn not_lif(element: &str, expected: &str, found: String) -> Problem {
    Problem::Structure {
        place: Place::element(element),
        expected: expected.into(),
        found,
    }
}
