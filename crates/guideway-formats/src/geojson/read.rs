//! GeoJSON reader: parses the root object and maps its features to a layout.

use guideway_layout::{Layout, Place};

use super::mapper::Mapper;
use super::model::Root;
use crate::json::{self, Field};
use crate::source::Source;
use crate::{Problem, ReadError, text};

/// Reads a GeoJSON file, or a sequence or an array of GeoJSON objects.
///
/// # Errors
/// When the text is not JSON, its root is not that of GeoJSON, or a limit is exceeded.
pub(crate) fn read(source: Source<'_>, bytes: &[u8]) -> Result<Layout, ReadError> {
    let text = text::decode_utf8(&source, bytes)?;
    let documents = json::documents(text);
    let mut roots = Vec::with_capacity(documents.len());
    for document in &documents {
        roots.push(root(&source, text, document)?);
    }
    let starts: Vec<usize> = documents
        .iter()
        .flat_map(|part| starts(text, part))
        .collect();
    let mapper = Mapper::new(source, bytes.len());
    let mut layout = mapper.map(joined(roots), &starts, bytes.len())?;
    let only = (documents.len() == 1).then(|| documents[0]);
    json::find_lines(&mut layout, text, only);
    Ok(layout)
}

/// The first bytes in the file of the features of a document, which may be a feature itself.
fn starts(text: &str, document: &str) -> Vec<usize> {
    let start = json::offset_in(text, document).unwrap_or(0);
    match json::root_items(document, "features") {
        None => vec![start],
        Some(features) => features
            .into_iter()
            .map(|item| start + item.start)
            .collect(),
    }
}

/// Joins the features of a sequence. The first system and the first member of Guideway count.
fn joined<'t>(roots: Vec<Root<'t>>) -> Root<'t> {
    let mut roots = roots.into_iter();
    let Some(mut first) = roots.next() else {
        return Root::default();
    };
    if roots.len() == 0 {
        return first;
    }
    let mut features = first.take_features();
    for mut next in roots {
        features.extend(next.take_features());
        if first.crs.is_absent() && first.coord_ref_sys.is_absent() {
            first.crs = next.crs;
            first.coord_ref_sys = next.coord_ref_sys;
        }
        if first.guideway.is_absent() {
            first.guideway = next.guideway;
        }
    }
    first.features = Field::Value(features);
    first
}

/// Parses a root object, which is a part of the whole text.
fn root<'t>(source: &Source<'_>, whole: &str, text: &'t str) -> Result<Root<'t>, ReadError> {
    let fail = |element: &str, expected: &str, found: String| {
        source.fail(Problem::Structure {
            place: Place::element(element),
            expected: expected.into(),
            found,
        })
    };
    let Field::Value(root) = json::parse_part::<Root<'_>>(source, whole, text)? else {
        return Err(fail("the root", "an object", "something else".into()));
    };
    if let Some(kind) = root.features.wrong_type() {
        return Err(fail("features", "an array", kind.to_string()));
    }
    // The geometry of a feature may be null.
    let is_feature = root.kind.get().is_some_and(|kind| kind == "Feature");
    let empty = !is_feature
        && root.features.is_absent()
        && root.geometry.is_absent()
        && root.coordinates.is_absent()
        && root.geometries.is_absent();
    if empty {
        let expected = "`features`, `geometry` or `coordinates` of GeoJSON";
        return Err(fail("the root", expected, "an object without them".into()));
    }
    Ok(root)
}
