//! XML that need not be honest: looked over before it is parsed, and with the line of every element.

use std::cell::OnceCell;

use guideway_layout::Place;
use roxmltree::{Document, Error, Node, ParsingOptions};

use crate::source::Source;
use crate::text::{ElementCounter, line_column, printable};
use crate::{Problem, ReadError};

/// Most attributes of one element. The parser compares each with every other; no format has half of it.
const MOST_ATTRIBUTES: u64 = 256;

/// Most declarations of namespaces. The parser copies them for every level; drawing programs write some
/// on one element or on a few.
const MOST_NAMESPACES: u64 = 4096;

/// Most bytes that all entities of a file may become together.
const MOST_ENTITY_BYTES: u64 = 16 << 20;

/// What becomes of a document type definition, whose entities can make a small file very large.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Doctype {
    /// It is an error: no file of the format has one.
    Refused,
    /// It may be there, and its entities too if they hold plain text and little of it.
    Bounded,
}

/// A parsed file.
pub(crate) struct Xml<'t> {
    text: &'t str,
    document: Document<'t>,
    /// Where the lines end. Only made when a finding asks for a line.
    line_ends: OnceCell<Vec<usize>>,
}

impl<'t> Xml<'t> {
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
            // An element can have a text before and after it.
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

    pub(crate) fn root(&self) -> Node<'_, 't> {
        self.document.root_element()
    }

    /// An element by its tag and its name or identifier, with its line.
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

    /// The line that an element begins on, from 1.
    pub(crate) fn line(&self, node: Node<'_, '_>) -> usize {
        let ends = self.line_ends.get_or_init(|| {
            let all = self.text.bytes().enumerate();
            all.filter(|(_, b)| *b == b'\n').map(|(i, _)| i).collect()
        });
        ends.partition_point(|&end| end < node.range().start) + 1
    }
}

/// The child elements of a tag.
pub(crate) fn children<'d, 't>(
    node: Node<'d, 't>,
    tag: &'static str,
) -> impl Iterator<Item = Node<'d, 't>> {
    node.children().filter(move |n| n.has_tag_name(tag))
}

/// The first child element of a tag.
pub(crate) fn child<'d, 't>(node: Node<'d, 't>, tag: &'static str) -> Option<Node<'d, 't>> {
    children(node, tag).next()
}

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
            // There is one at most.
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
            check_count("attributes of one element", MOST_ATTRIBUTES, tag.attributes)?;
            check_count("namespaces in the file", MOST_NAMESPACES, namespaces)?;
            if !tag.closed {
                counter.enter(at)?;
            }
            tag.length
        };
        at += length.ok_or_else(|| cut(text, at))?;
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

/// Length of a text up to and with its first `end`.
fn through(text: &str, end: &str) -> Option<usize> {
    text.find(end).map(|i| i + end.len())
}

fn cut(text: &str, at: usize) -> Problem {
    let (line, column) = line_column(text, at);
    Problem::Truncated {
        at: text.len() as u64,
        detail: format!("what begins at line {line}, column {column} has no end"),
    }
}

/// What an opening tag has.
struct Tag {
    /// None if it does not end.
    length: Option<usize>,
    attributes: u64,
    namespaces: u64,
    /// Whether it has no content, as in `<a/>`.
    closed: bool,
}

impl Tag {
    fn scan(text: &str) -> Self {
        let mut tag = Self {
            length: None,
            attributes: 0,
            namespaces: 0,
            closed: false,
        };
        let mut at = 0;
        while let Some(found) = text[at..].find(['"', '\'', '>']) {
            let part = &text[at..at + found];
            tag.namespaces += part.matches("xmlns").count() as u64;
            at += found + 1;
            let stop = &text[at - 1..at];
            if stop == ">" {
                tag.closed = part.ends_with('/');
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

/// Length of a document type definition, its declarations in brackets included.
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

/// Bounds what entities can become: each reference at most all that the definition holds.
fn check_entities(text: &str, at: usize, definition: &str) -> Result<(), Problem> {
    if !definition.contains("<!ENTITY") {
        return Ok(());
    }
    let references = text.matches('&').count() as u64;
    // Only declarations may begin in it: an entity that holds elements could nest them without bound.
    let holds_elements = definition.replace("<!", "").contains('<');
    if definition.contains(['&', '%']) || holds_elements {
        return Err(no_doctype(text, at));
    }
    let bytes = references.saturating_mul(definition.len() as u64);
    check_count("bytes that entities stand for", MOST_ENTITY_BYTES, bytes)
}

fn no_doctype(text: &str, at: usize) -> Problem {
    Problem::Unsupported {
        place: Place {
            element: "the head of the file".into(),
            line: u32::try_from(line_column(text, at).0).ok(),
        },
        what: "a document type definition (<!DOCTYPE ...>), or one whose entities hold more than text,"
            .into(),
        remedy: "Remove it; it is not needed, and it can make a small file very large".into(),
    }
}

fn problem(error: &Error, text: &str, elements: u64) -> Problem {
    match error {
        Error::UnexpectedEndOfStream | Error::UnclosedRootNode => Problem::Truncated {
            at: text.len() as u64,
            detail: "an element is not closed".into(),
        },
        Error::NoRootNode => Problem::Truncated {
            at: text.len() as u64,
            detail: "there is no element".into(),
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
                    detail: format!("the XML goes on after line {line}, column {column}"),
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
