//! The tree of an XML text, within the limits, with the line of every element.

use std::borrow::Cow;
use std::cell::OnceCell;

use guideway_layout::{LineIndex, Place, TextPosition};
use roxmltree::{Document, Node, ParsingOptions};

use super::problem::problem;
use super::{entities, limits};
use crate::source::Source;
use crate::text::{decode_utf8, printable};
use crate::{Problem, ReadError};

/// Decodes the bytes of a file, and expands its document type definition.
///
/// # Errors
/// When the text is not UTF-8, or when its definition is malformed or expands to too much.
pub(crate) fn decode<'b>(source: &Source<'_>, bytes: &'b [u8]) -> Result<Cow<'b, str>, ReadError> {
    entities::expand(source, decode_utf8(source, bytes)?)
}

/// A parsed file.
pub(crate) struct Xml<'t> {
    text: &'t str,
    document: Document<'t>,
    /// Lines of the text; computed for the first element that needs one.
    lines: OnceCell<LineIndex<'t>>,
}

impl<'t> Xml<'t> {
    /// Parses a text of [`decode`].
    ///
    /// # Errors
    /// When the text is not well-formed or exceeds a limit, or when the caller cancels.
    pub(crate) fn parse(source: &Source<'_>, text: &'t str) -> Result<Self, ReadError> {
        limits::check(text, &source.options.limits).map_err(|p| source.fail(p))?;
        source.check_cancelled()?;
        let limit = source.options.limits.elements;
        let options = ParsingOptions {
            // Every element may have a text node before and after it.
            nodes_limit: u32::try_from(limit.saturating_mul(3)).unwrap_or(u32::MAX),
            ..ParsingOptions::default()
        };
        let document = Document::parse_with_options(text, options)
            .map_err(|error| source.fail(problem(&error, text, limit)))?;
        Ok(Self {
            text,
            document,
            lines: OnceCell::new(),
        })
    }

    /// The root element.
    pub(crate) fn root(&self) -> Node<'_, 't> {
        self.document.root_element()
    }

    /// The root element of a format.
    ///
    /// # Errors
    /// When the root has another tag. `expected` describes the root in the message.
    pub(crate) fn root_with_tag(
        &self,
        source: &Source<'_>,
        tag: &str,
        expected: &str,
    ) -> Result<Node<'_, 't>, ReadError> {
        let root = self.root();
        let found = root.tag_name().name();
        if found == tag {
            return Ok(root);
        }
        Err(source.fail(Problem::Structure {
            place: Place::element("the outermost element"),
            expected: expected.into(),
            found: format!("<{}>", printable(found)),
        }))
    }

    /// The place of an element: its tag, its name or identifier, and its line.
    pub(crate) fn place(&self, node: Node<'_, '_>) -> Place {
        let tag = node.tag_name().name();
        let mut names = ["name", "visualizedObjectName", "id"].into_iter();
        let name = names.find_map(|key| node.attribute(key).filter(|name| !name.is_empty()));
        let element = match name {
            Some(name) => format!("{tag} \"{name}\""),
            None => tag.to_owned(),
        };
        Place::element(element).at(self.position(node))
    }

    /// The first character of an element.
    pub(crate) fn position(&self, node: Node<'_, '_>) -> TextPosition {
        let lines = self.lines.get_or_init(|| LineIndex::new(self.text));
        lines.position(node.range().start)
    }
}

/// The child elements with a tag.
pub(crate) fn children<'d, 't>(
    node: Node<'d, 't>,
    tag: &'static str,
) -> impl Iterator<Item = Node<'d, 't>> {
    node.children().filter(move |n| n.has_tag_name(tag))
}

/// The first child element with a tag.
pub(crate) fn child<'d, 't>(node: Node<'d, 't>, tag: &'static str) -> Option<Node<'d, 't>> {
    children(node, tag).next()
}
