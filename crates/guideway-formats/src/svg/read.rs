//! Reads an SVG file: text in, layout out.

use guideway_layout::Layout;

use super::style_sheet::StyleSheet;
use super::tree_walker::TreeWalker;
use crate::ReadError;
use crate::source::Source;
use crate::xml::{self, Xml};

/// Reads a drawing into a layout.
///
/// # Errors
/// When the text is not XML with an `<svg>` root or exceeds a limit, or when the caller cancels.
pub(crate) fn read(source: Source<'_>, bytes: &[u8]) -> Result<Layout, ReadError> {
    let text = xml::decode(&source, bytes)?;
    let xml = Xml::parse(&source, &text)?;
    let root = xml.root_with_tag(&source, "svg", "<svg>")?;
    let sheet = StyleSheet::read(root);
    TreeWalker::new(source, &xml, &sheet, bytes.len()).read(root)
}
