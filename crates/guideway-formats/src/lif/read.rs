//! LIF reader: reads the skeleton of a file, then its nodes, edges and stations part by part, and
//! maps them to a layout. The layout keeps the text, so that a save changes the edited parts only.
//! If it is large, no more than parts of it are in memory, and a save reads the file again.

use guideway_layout::{Layout, Limits, Place};

use super::mapper::Mapper;
use super::model::{Root, is_long_array};
use crate::input::{Input, MAX_KEPT_BYTES};
use crate::json::{self, ArrayFault, Field, Skeleton};
use crate::source::Source;
use crate::{Problem, Progress, ReadError, ReadOptions, text};

/// Keys that the error of a file that is not LIF names.
const MAX_KEYS: usize = 5;

/// Reads a LIF file.
///
/// # Errors
/// When the text is not JSON, its root is not that of LIF, or a limit is exceeded.
pub(crate) fn read(source: Source<'_>, input: &Input<'_>) -> Result<Layout, ReadError> {
    let file = input.source_file();
    let kept = match input {
        Input::Bytes(bytes) if bytes.len() <= MAX_KEPT_BYTES => Some(*bytes),
        _ => None,
    };
    let mut layout = read_elements(source, input, kept.is_some())?;
    let text = kept.and_then(|bytes| std::str::from_utf8(bytes).ok());
    layout.provenance.text = text.map(Into::into);
    layout.provenance.file = file;
    Ok(layout)
}

/// Reads a file. Rows keep their first byte and, unless the layout `keeps_text`, their line.
fn read_elements(
    source: Source<'_>,
    input: &Input<'_>,
    keeps_text: bool,
) -> Result<Layout, ReadError> {
    input.read_ahead();
    let Some(skeleton) = Skeleton::scan(&source, input, is_long_array)? else {
        return Err(syntax_error(&source, input, None));
    };
    let Ok(root) = json::parse_checked(&skeleton.text) else {
        return Err(syntax_error(&source, input, None));
    };
    let root = lif_root(&source, root)?;
    let mapper = Mapper::new(source, input, &skeleton, keeps_text);
    let mut layout = mapper.map(&root).map_err(|fault| match fault {
        ArrayFault::Reader(error) => error,
        ArrayFault::Input(problem) => source.fail(problem),
        ArrayFault::Separator => syntax_error(&source, input, None),
        ArrayFault::Item(error, at) => syntax_error(&source, input, Some((error, at))),
    })?;
    json::find_skeleton_lines(&mut layout, &skeleton);
    Ok(layout)
}

/// Returns the root object; fails if it is not that of LIF.
fn lif_root<'t>(source: &Source<'_>, root: Field<Root<'t>>) -> Result<Root<'t>, ReadError> {
    let root = match root {
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
    Ok(root)
}

/// Finds the place of a fault in the whole text; `item` is the error of an item of an array, and
/// its first byte, if its syntax may be valid.
fn syntax_error(
    source: &Source<'_>,
    input: &Input<'_>,
    item: Option<(serde_json::Error, usize)>,
) -> ReadError {
    let mut buffer = Vec::new();
    let bytes = match input.part(0..input.len(), &mut buffer) {
        Ok(bytes) => bytes,
        Err(problem) => return source.fail(problem),
    };
    let text = match text::decode_utf8(source, bytes) {
        Ok(text) => text,
        Err(error) => return error,
    };
    if let Err(error) = json::parse::<Root<'_>>(source, text) {
        return error;
    }
    let before = bytes.len() - text.len();
    source.fail(match item {
        Some((error, at)) => json::problem(&error, text, at.saturating_sub(before)),
        None => Problem::Damaged {
            place: Place::element("the root"),
            detail: "the file changed while it was read".into(),
        },
    })
}

/// Reads the source text of a layout again, without limits.
pub(super) fn read_again(
    layout: &Layout,
    text: &str,
    progress: Option<&dyn Progress>,
) -> Option<Layout> {
    let options = ReadOptions {
        limits: Limits {
            file_bytes: u64::MAX,
            paths: u64::MAX,
            elements: u64::MAX,
            text_bytes: usize::MAX,
            diagnostics_per_code: 0,
            ..Limits::default()
        },
        progress,
        ..ReadOptions::default()
    };
    let source = Source {
        name: &layout.provenance.source,
        options: &options,
    };
    read_elements(source, &Input::Bytes(text.as_bytes()), true).ok()
}

fn not_lif(element: &str, expected: &str, found: String) -> Problem {
    Problem::Structure {
        place: Place::element(element),
        expected: expected.into(),
        found,
    }
}

#[cfg(unix)]
#[cfg(test)]
mod tests {
    use std::fmt::Write;
    use std::fs::{self, File};
    use std::time::SystemTime;

    use guideway_layout::{CompareOptions, LineIndex, differences};
    use guideway_spline::Point;

    use super::*;
    use crate::input::ReadAheadFile;
    use crate::lif::{Version, WriteOptions, write_layout};

    /// Reads a text from memory and from a file, part by part.
    fn both(text: &str) -> [Result<Layout, ReadError>; 2] {
        let options = ReadOptions::default();
        let source = Source {
            name: "site",
            options: &options,
        };
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("site");
        fs::write(&path, text).unwrap();
        let file = ReadAheadFile::new(File::open(&path).unwrap(), text.len() as u64, &path);
        [Input::Bytes(text.as_bytes()), Input::File(&file)].map(|input| read(source, &input))
    }

    /// A file of several parts per array, each item on three lines, with a few faults.
    fn site(count: usize) -> String {
        let mut text = "\u{FEFF}{\"metaInformation\": {\"lifVersion\": \"2.0\"},\n\
                        \"layouts\": [{\"layoutId\": 3, \"edges\": ["
            .to_owned();
        for i in 0..count {
            let separator = if i > 0 { ",\n" } else { "" };
            let degree = if i % 500 == 7 { "\"x\"" } else { "1" };
            let end = if i == 9 { count } else { i };
            write!(
                text,
                "{separator}{{\"edgeId\": \"é{i}\", \"startNodeId\": \"n0\",\n  \"endNodeId\": \
                 \"n{end}\", \"vehicleTypeEdgeProperties\": [{{\"vehicleTypeId\": \"tug\", \
                 \"trajectory\":\n {{\"degree\": {degree}, \"controlPoints\": [{{\"x\": 0, \"y\": \
                 0}}, {{\"x\": 3, \"y\": {i}}}], \"knotVector\": [0, 0, 1, 1]}}}}]}}"
            )
            .unwrap();
        }
        text += "],\n\"nodes\": [";
        for i in 0..count {
            let separator = if i > 0 { "," } else { "" };
            let x = if i % 400 == 5 { "\"3\"" } else { "3" };
            write!(
                text,
                "{separator}\n{{\"nodeId\": \"n{i}\",\n \"nodePosition\": {{\n\"x\": {x}, \"y\": \
                 {i}}}}}"
            )
            .unwrap();
        }
        text + "],\n\n\"stations\": 5}]}\n"
    }

    #[test]
    fn parts_of_a_file_are_read_as_a_whole_text() {
        let text = site(3000);
        let [Ok(kept), Ok(in_parts)] = both(&text) else {
            panic!("a good file");
        };
        assert_eq!(kept.provenance.text.as_deref(), Some(&*text));
        assert_eq!(in_parts.provenance.text, None);
        assert_eq!(kept.paths.len(), 3000);
        let found = differences(&kept, &in_parts, &CompareOptions::default());
        assert!(found.is_empty(), "{found:?}");
        let lines = LineIndex::new(&text);
        for (kept, in_parts) in [
            (&kept.paths.source, &in_parts.paths.source),
            (&kept.nodes.source, &in_parts.nodes.source),
        ] {
            for row in 0..3000 {
                let expected = kept.position(row, Some(&lines));
                assert!(expected.is_some());
                assert_eq!(in_parts.position(row, None), expected, "{row}");
            }
        }
        let [kept, in_parts] =
            [kept, in_parts].map(|l| Vec::from_iter(l.diagnostics.iter().cloned()));
        assert!(kept.len() > 14);
        assert_eq!(kept, in_parts);
        let place = |element: &str| {
            let found = kept.iter().find(|d| d.place.element == element);
            let place = found.map(|d| (d.place.line.unwrap(), d.place.column.unwrap()));
            place.unwrap_or_else(|| panic!("{element}"))
        };
        // Lines and columns are those of an independent search in the text.
        let at = |byte: usize| text::line_column(&text[3..], byte - 3);
        for (element, before) in [
            (
                "layouts[0].nodes[5].nodePosition.x",
                "\"n5\",\n \"nodePosition\": {\n\"x\": ",
            ),
            ("layouts[0].layoutId", "\"layoutId\": "),
            ("layouts[0].stations", "\"stations\": "),
        ] {
            let byte = text.find(before).unwrap() + before.len();
            let (line, column) = place(element);
            assert_eq!((u64::from(line), u64::from(column)), at(byte), "{element}");
        }
    }

    #[test]
    fn file_too_large_to_keep_is_saved_in_place() {
        let text = site(300);
        let [Ok(kept), Ok(in_parts)] = both(&text) else {
            panic!("a good file");
        };
        let saved = |layout: &Layout| {
            let mut out = Vec::new();
            let options = WriteOptions {
                version: Version::V1,
                exported: SystemTime::UNIX_EPOCH,
            };
            write_layout(layout, &mut out, &options).unwrap();
            String::from_utf8(out).unwrap()
        };
        assert!(saved(&in_parts) == text, "the same bytes");
        let [kept, in_parts] = [kept, in_parts].map(|mut layout| {
            let moved = layout.nodes.position_m(7) + Point::new(0.5, 0.0);
            layout.nodes.set_position_m(7, moved);
            saved(&layout)
        });
        assert!(kept == in_parts && kept != text, "one number differs");
    }

    #[test]
    fn faults_of_parts_are_those_of_the_whole_text() {
        let good = site(2000);
        let last = good.rfind("{\"nodeId\"").unwrap();
        let edge = good.find("{\"edgeId\": \"é1500\"").unwrap();
        let number = good.rfind("\"x\": 3").unwrap() + 5;
        let cut_to = |at: usize| good[..at].to_owned();
        let with = |at: usize, part: &str| [&good[..at], part, &good[at..]].concat();
        for (name, text) in [
            ("a missing comma", with(last, "{} ")),
            ("two commas", with(edge, ",")),
            ("no value", with(edge, "nonsense, ")),
            ("a bracket", with(edge, "]")),
            ("a brace", with(last, "}")),
            (
                "another bracket",
                good.replace("],\n\"nodes\"", "},\n\"nodes\""),
            ),
            ("a large number", with(number, "1e999, \"z\": ")),
            ("a bad escape", with(edge, "{\"edgeId\": \"\\ud800\"}, ")),
            ("a cut item", cut_to(edge + 20)),
            ("a cut array", cut_to(last)),
            ("a cut root", cut_to(good.len() - 3)),
            ("more text", good.clone() + "{}"),
            (
                "deep",
                with(last, &("[".repeat(200) + &"]".repeat(200) + ",")),
            ),
        ] {
            let [Err(whole), Err(in_parts)] = both(&text) else {
                panic!("{name} is a fault");
            };
            assert_eq!(in_parts.to_string(), whole.to_string(), "{name}");
            let located = ["line", "byte", "cut"].iter();
            let mut located = located.filter(|word| whole.to_string().contains(**word));
            assert!(located.next().is_some(), "{name}: {whole}");
        }
    }
}
