//! Scans an XML text for limits before parsing: elements, depth, attributes, namespaces.
//!
//! The text has no document type definition. Where the scan and the parser could disagree about
//! where a construct ends, the parser refuses the construct.

use guideway_layout::Limits;

use super::doctype::MAX_ATTRIBUTES;
use super::problem::unterminated;
use crate::Problem;
use crate::text::ElementCounter;

/// Namespace declarations per file. The parser copies them for every level; drawing programs write
/// some on a few elements.
const MAX_NAMESPACES: u64 = 4096;

/// Namespace declarations of an element and of those around it. The parser looks each prefix up
/// among them, one by one.
const MAX_NAMESPACES_IN_SCOPE: u64 = 256;

/// Scans a text for limits before parsing.
pub(super) fn check(text: &str, limits: &Limits) -> Result<(), Problem> {
    let mut counter = ElementCounter::new(text, limits);
    let mut namespaces = Namespaces::default();
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
        } else if rest.starts_with("<?") {
            counter.count()?;
            through(rest, "?>")
        } else if rest.starts_with("</") {
            counter.leave();
            namespaces.leave();
            through(rest, ">")
        } else {
            counter.count()?;
            let tag = Tag::scan(rest);
            check_count("attributes of one element", MAX_ATTRIBUTES, tag.attributes)?;
            namespaces.enter(&tag)?;
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

/// Counts declarations of namespaces.
#[derive(Default)]
struct Namespaces {
    in_file: u64,
    in_scope: u64,
    /// Number of declarations per open element.
    open: Vec<u64>,
}

impl Namespaces {
    fn enter(&mut self, tag: &Tag) -> Result<(), Problem> {
        self.in_file += tag.namespaces;
        check_count("namespaces in the file", MAX_NAMESPACES, self.in_file)?;
        if !tag.is_self_closing {
            self.open.push(tag.namespaces);
            self.in_scope += tag.namespaces;
        }
        check_count(
            "namespaces in scope",
            MAX_NAMESPACES_IN_SCOPE,
            self.in_scope,
        )
    }

    fn leave(&mut self) {
        self.in_scope -= self.open.pop().unwrap_or(0);
    }
}

/// A scanned opening tag.
struct Tag {
    /// `None` if it is not terminated.
    length: Option<usize>,
    attributes: u64,
    namespaces: u64,
    /// True if it is self-closing, as in `<a/>`.
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
