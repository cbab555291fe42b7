//! GeoJSON, plain and as the route graphs of Nav2: positions in meters or degrees, y up.
//!
//! Nav2 keeps its graphs in GeoJSON: points are nodes, and lines with the properties `startid` and
//! `endid` are edges. Its positions are meters, whatever the file says.

mod coordinates;
mod features;
mod geometry;
mod model;
mod properties;
mod unit;
mod write;

pub use self::write::{WriteOptions, write_layout};

use guideway_layout::{Layout, Place};

use self::features::Mapper;
use self::model::Root;
use crate::json::{self, Field};
use crate::source::Source;
use crate::{Problem, ReadError, text};

/// Reads a GeoJSON file.
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
    if let Some(kind) = root.features.wrong_kind() {
        return Err(fail("features", "a list", kind.to_string()));
    }
    let empty = root.features.is_absent()
        && root.geometry.is_absent()
        && root.coordinates.is_absent()
        && root.geometries.is_absent();
    if empty {
        let expected = "`features`, `geometry` or `coordinates` of GeoJSON";
        return Err(fail("the root", expected, "an object with none".into()));
    }
    let mut layout = Mapper::new(source, bytes.len()).map(root)?;
    json::add_lines(&mut layout, text);
    Ok(layout)
}
