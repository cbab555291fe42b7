//! Reads an SVG file: text in, layout out.

use guideway_layout::{Layout, Place};

use super::style_sheet::StyleSheet;
use super::tree_walker::TreeWalker;
use crate::source::Source;
use crate::xml::{Doctype, Xml};
use crate::{Problem, ReadError, text};

/// Reads a drawing into a layout.
///
/// # Errors
/// When the text is not XML with an `<svg>` root or exceeds a limit, or when the caller cancels.
pub(crate) fn read(source: Source<'_>, bytes: &[u8]) -> Result<Layout, ReadError> {
    let text = text::decode_utf8(&source, bytes)?;
    let xml = Xml::parse(&source, text, Doctype::Bounded)?;
    let root = xml.root();
    if root.tag_name().name() != "svg" {
        return Err(source.fail(Problem::Structure {
            place: Place::element("the outermost element"),
            expected: "<svg>".into(),
            found: format!("<{}>", text::printable(root.tag_name().name())),
        }));
    }
    let sheet = StyleSheet::read(root);
    TreeWalker::new(source, &xml, &sheet, bytes.len()).read(root)
}
