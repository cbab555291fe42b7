//! Parses untrusted XML: bounds size, depth and entities before parsing; gives a tree with the line
//! of every element.

use std::cell::OnceCell;

use guideway_layout::Place;
use roxmltree::{Document, Error, Node, ParsingOptions};

use crate::source::Source;
use crate::text::{ElementCounter, line_column, printable};
use crate::{Problem, ReadError};

/// Attributes per element. The parser compares each one with every other; no format needs half as
/// many.
const MAX_ATTRIBUTES: u64 = 256;

/// Namespace declarations per file. The parser copies them for every level; drawing programs write
/// some on a few elements.
const MAX_NAMESPACES: u64 = 4096;

/// Bytes that all entity references of a file may expand to.
const MAX_ENTITY_BYTES: u64 = 16 << 20;

/// The treatment of a document type definition, whose entities can expand a small file without
/// bound.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Doctype {
    /// Any definition is an error: files of the format have none.
    Refused,
    /// Entities of plain text are allowed up to [`MAX_ENTITY_BYTES`].
    Bounded,
}

/// A parsed file.
pub(crate) struct Xml<'t> {
    text: &'t str,
    document: Document<'t>,
    /// Byte offset of every line end; computed for the first finding that needs a line.
    line_ends: OnceCell<Vec<usize>>,
}

impl<'t> Xml<'t> {
    /// Parses a text.
    ///
    /// # Errors
    /// When the text is not well-formed, exceeds a limit or has a forbidden document type
    /// definition, or when the caller cancels.
    pub(crate) fn parse(
        source: &Source<'_>,
        text: &'t str,
        doctype: Doctype,
    ) -> Result<Self, ReadError> {
        check(source, text, doctype).map_err(|p| source.fail(p))?;
        source.check_cancelled()?;
        let limit = source.options.limits.elements;
        let options = ParsingOptions {
            allow_dtd: doctype == Doctype::Bounded,
            // Every element may have a text node before and after it.
            nodes_limit: u32::try_from(limit.saturating_mul(3)).unwrap_or(u32::MAX),
            ..ParsingOptions::default()
        };
        let document = Document::parse_with_options(text, options)
            .map_err(|error| source.fail(problem(&error, text, limit)))?;
        Ok(Self {
            text,
            document,
            line_ends: OnceCell::new(),
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
        Place {
            element,
            line: u32::try_from(self.line(node)).ok(),
        }
    }

    /// The first line of an element, from 1.
    pub(crate) fn line(&self, node: Node<'_, '_>) -> usize {
        let ends = self.line_ends.get_or_init(|| {
            let all = self.text.bytes().enumerate();
            all.filter(|(_, b)| *b == b'\n').map(|(i, _)| i).collect()
        });
        ends.partition_point(|&end| end < node.range().start) + 1
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

/// Scans a text for limits before parsing.
fn check(source: &Source<'_>, text: &str, mut doctype: Doctype) -> Result<(), Problem> {
    let mut counter = ElementCounter::new(text, &source.options.limits);
    let mut namespaces = 0;
    let mut at = 0;
    while let Some(found) = text[at..].find('<') {
        at += found;
        let rest = &text[at..];
        let length = if rest.starts_with("<!--") {
            counter.count()?;
            through(rest, "-->")
        } else if rest.starts_with("<![CDATA[") {
            counter.count()?;
            through(rest, "]]>")
        } else if rest.starts_with("<!") {
            if doctype == Doctype::Refused {
                return Err(no_doctype(text, at));
            }
            // A document has at most one definition.
            doctype = Doctype::Refused;
            let definition = definition_length(rest).map(|length| &rest[..length]);
            check_entities(text, at, definition.unwrap_or_default())?;
            definition.map(str::len)
        } else if rest.starts_with("<?") {
            counter.count()?;
            through(rest, "?>")
        } else if rest.starts_with("</") {
            counter.leave();
            through(rest, ">")
        } else {
            counter.count()?;
            let tag = Tag::scan(rest);
            namespaces += tag.namespaces;
            check_count("attributes of one element", MAX_ATTRIBUTES, tag.attributes)?;
            check_count("namespaces in the file", MAX_NAMESPACES, namespaces)?;
            if !tag.is_self_closing {
                counter.enter(at)?;
            }
            tag.length
        };
        at += length.ok_or_else(|| unterminated(text, at))?;
    }
    Ok(())
}

fn check_count(what: &'static str, limit: u64, actual: u64) -> Result<(), Problem> {
    if actual <= limit {
        return Ok(());
    }
    Err(Problem::LimitReached {
        what,
        limit,
        actual,
    })
}

/// Length of a text up to and including its first `end`.
fn through(text: &str, end: &str) -> Option<usize> {
    text.find(end).map(|i| i + end.len())
}

fn unterminated(text: &str, at: usize) -> Problem {
    let (line, column) = line_column(text, at);
    Problem::Truncated {
        at: text.len() as u64,
        detail: format!("the markup at line {line}, column {column} is not terminated"),
    }
}

/// A scanned opening tag.
struct Tag {
    /// `None` if it is not terminated.
    length: Option<usize>,
    attributes: u64,
    namespaces: u64,
    /// Whether it is self-closing, as in `<a/>`.
    is_self_closing: bool,
}

impl Tag {
    /// Scans the tag at the start of a text.
    fn scan(text: &str) -> Self {
        let mut tag = Self {
            length: None,
            attributes: 0,
            namespaces: 0,
            is_self_closing: false,
        };
        let mut at = 0;
        while let Some(found) = text[at..].find(['"', '\'', '>']) {
            let part = &text[at..at + found];
            tag.namespaces += part.matches("xmlns").count() as u64;
            at += found + 1;
            let stop = &text[at - 1..at];
            if stop == ">" {
                tag.is_self_closing = part.ends_with('/');
                tag.length = Some(at);
                break;
            }
            tag.attributes += 1;
            match through(&text[at..], stop) {
                Some(length) => at += length,
                None => break,
            }
        }
        tag
    }
}

/// Length of a document type definition, including its declarations in brackets.
fn definition_length(text: &str) -> Option<usize> {
    let end = text.find('>')?;
    match text[..end].contains('[') {
        true => {
            let inner = text.find(']')?;
            through(&text[inner..], ">").map(|length| inner + length)
        }
        false => Some(end + 1),
    }
}

/// Bounds the expansion of entities: every reference expands to at most the whole definition.
fn check_entities(text: &str, at: usize, definition: &str) -> Result<(), Problem> {
    if !definition.contains("<!ENTITY") {
        return Ok(());
    }
    let references = text.matches('&').count() as u64;
    // An entity with elements could nest them beyond the depth limit.
    let has_elements = definition.replace("<!", "").contains('<');
    if definition.contains(['&', '%']) || has_elements {
        return Err(no_doctype(text, at));
    }
    let bytes = references.saturating_mul(definition.len() as u64);
    check_count("bytes of expanded entities", MAX_ENTITY_BYTES, bytes)
}

fn no_doctype(text: &str, at: usize) -> Problem {
    Problem::Unsupported {
        place: Place {
            element: "the head of the file".into(),
            line: u32::try_from(line_column(text, at).0).ok(),
        },
        what: "a document type definition (<!DOCTYPE ...>), or one with entities other than text,"
            .into(),
        remedy: "Remove it; layouts do not need it, and it can expand a small file without bound"
            .into(),
    }
}

/// Converts a parser error. `elements` is the limit of elements.
fn problem(error: &Error, text: &str, elements: u64) -> Problem {
    match error {
        Error::UnexpectedEndOfStream | Error::UnclosedRootNode => Problem::Truncated {
            at: text.len() as u64,
            detail: "an element is not closed".into(),
        },
        Error::NoRootNode => Problem::Truncated {
            at: text.len() as u64,
            detail: "the document has no element".into(),
        },
        Error::NodesLimitReached => Problem::LimitReached {
            what: "elements in the file",
            limit: elements,
            actual: elements.saturating_add(1),
        },
        Error::DtdDetected => no_doctype(text, 0),
        other => {
            let place = other.pos();
            let (line, column) = line_column(text, text.len());
            if (u64::from(place.row), u64::from(place.col)) == (line, column) {
                return Problem::Truncated {
                    at: text.len() as u64,
                    detail: format!("the XML is incomplete at line {line}, column {column}"),
                };
            }
            let message = other.to_string();
            let message = message.split(" at ").next().unwrap_or(&message);
            Problem::Syntax {
                line: place.row.into(),
                column: place.col.into(),
                message: printable(message),
            }
        }
    }
}
