//! GeoJSON reader: parses the root object and maps its features to a layout.

use guideway_layout::{Layout, Place};

use super::mapper::Mapper;
use super::model::Root;
use crate::json::{self, Field};
use crate::source::Source;
use crate::{Problem, ReadError, text};

/// Reads a GeoJSON file.
///
/// # Errors
/// When the text is not JSON, its root is not that of GeoJSON, or a limit is exceeded.
pub(crate) fn read(source: Source<'_>, bytes: &[u8]) -> Result<Layout, ReadError> {
    let fail = |element: &str, expected: &str, found: String| {
        source.fail(Problem::Structure {
            place: Place::element(element),
            expected: expected.into(),
            found,
        })
    };
    let text = text::decode_utf8(&source, bytes)?;
    let Field::Value(root) = json::parse::<Root<'_>>(&source, text)? else {
        return Err(fail("the root", "an object", "something else".into()));
    };
    if let Some(kind) = root.features.wrong_type() {
        return Err(fail("features", "an array", kind.to_string()));
    }
    let empty = root.features.is_absent()
        && root.geometry.is_absent()
        && root.coordinates.is_absent()
        && root.geometries.is_absent();
    if empty {
        let expected = "`features`, `geometry` or `coordinates` of GeoJSON";
        return Err(fail("the root", expected, "an object without them".into()));
    }
    let mut layout = Mapper::new(source, bytes.len()).map(root, bytes.len())?;
    json::add_line_numbers(&mut layout, text);
    Ok(layout)
}
