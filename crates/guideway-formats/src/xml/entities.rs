//! Expands the entities and the default attributes of a document type definition: text in, text
//! without a definition out.
//!
//! The XML parser sees the expanded text only. It refuses definitions, so it cannot find an entity
//! that was not counted here.

use std::borrow::Cow;

use super::doctype::{Definitions, Prolog, PrologError};
use super::problem::unterminated;
use crate::text::line_column;
use crate::{Problem, ReadError, source::Source};

/// Bytes that entities and default attributes of any file may add.
const BASE_EXPANDED_BYTES: u64 = 4 << 20;

/// Bytes that they may add in addition, per byte of the file.
const EXPANDED_PER_BYTE: u64 = 4;

/// Cost of a reference besides its text, so that empty entities are not free.
const REFERENCE_COST: u64 = 4;

/// Entities within entities. Drawing programs write one level; more levels than this are a circle.
const MAX_DEPTH: usize = 16;

/// Replaces the document type definition of a text by spaces, and each reference to one of its
/// entities by the text of the entity. Lines keep their numbers.
///
/// # Errors
/// When the definition is malformed, or when its entities refer to themselves or expand to too
/// much.
pub(crate) fn expand<'t>(source: &Source<'_>, text: &'t str) -> Result<Cow<'t, str>, ReadError> {
    expanded(source, text).map_err(|problem| source.fail(problem))
}

fn expanded<'t>(source: &Source<'_>, text: &'t str) -> Result<Cow<'t, str>, Problem> {
    let prolog = Prolog::scan(text.as_bytes()).map_err(|error| problem(&error, text))?;
    let Some(doctype) = prolog.doctype else {
        return Ok(Cow::Borrowed(text));
    };
    let definitions =
        Definitions::read(text, doctype.clone()).map_err(|error| problem(&error, text))?;
    let limit = BASE_EXPANDED_BYTES + EXPANDED_PER_BYTE * text.len() as u64;
    let limit = limit.min(source.options.limits.file_bytes);
    let mut expansion = Expansion {
        definitions: &definitions,
        text: String::with_capacity(text.len()),
        spent: 0,
        limit,
    };
    expansion.text.push_str(&text[..doctype.start]);
    let keep_line_end = |b: u8| if b == b'\n' { '\n' } else { ' ' };
    expansion
        .text
        .extend(text[doctype.clone()].bytes().map(keep_line_end));
    expansion.content(&text[doctype.end..], 0)?;
    Ok(Cow::Owned(expansion.text))
}

fn problem(error: &PrologError, text: &str) -> Problem {
    match *error {
        PrologError::Unterminated(at) => unterminated(text, at),
        PrologError::Malformed(at) => {
            let (line, column) = line_column(text, at);
            Problem::Syntax {
                line,
                column,
                message: "this is no declaration of a document type definition (<!DOCTYPE ...>)"
                    .into(),
            }
        }
    }
}

/// A text under expansion.
struct Expansion<'d> {
    definitions: &'d Definitions<'d>,
    text: String,
    /// Bytes added so far.
    spent: u64,
    limit: u64,
}

impl Expansion<'_> {
    /// Appends the content of an element or an entity, with its markup.
    fn content(&mut self, mut rest: &str, depth: usize) -> Result<(), Problem> {
        while let Some(at) = rest.find(['<', '&']) {
            self.text.push_str(&rest[..at]);
            rest = &rest[at..];
            if rest.starts_with('&') {
                rest = self.reference(rest, depth, None)?;
                continue;
            }
            let end = match () {
                () if rest.starts_with("<!--") => "-->",
                () if rest.starts_with("<![CDATA[") => "]]>",
                () if rest.starts_with("<?") => "?>",
                () if rest.starts_with("</") || rest.starts_with("<!") => ">",
                () => {
                    rest = self.tag(rest, depth)?;
                    continue;
                }
            };
            // The parser finds what does not end.
            let length = rest.find(end).map_or(rest.len(), |at| at + end.len());
            self.text.push_str(&rest[..length]);
            rest = &rest[length..];
        }
        self.text.push_str(rest);
        Ok(())
    }

    /// Appends an opening tag with its default attributes. Returns what follows it.
    fn tag<'r>(&mut self, text: &'r str, depth: usize) -> Result<&'r str, Problem> {
        let is_end = |c: char| c.is_ascii_whitespace() || matches!(c, '/' | '>' | '"' | '\'');
        let name_end = text.find(is_end).unwrap_or(text.len());
        let (name, mut rest) = text.split_at(name_end);
        self.text.push_str(name);
        let defaults = self.definitions.defaults.get(&name[1..]);
        let (defaults_at, mut names) = (self.text.len(), Vec::new());
        while let Some(at) = rest.find(['"', '\'', '>']) {
            let (before, stop) = (&rest[..at], &rest[at..=at]);
            self.text.push_str(before);
            self.text.push_str(stop);
            rest = &rest[at + 1..];
            if stop == ">" {
                break;
            }
            if defaults.is_some() {
                names.push(before.trim().trim_end_matches('=').trim_end());
            }
            let end = rest.find(stop).unwrap_or(rest.len());
            self.value(&rest[..end], depth, stop)?;
            let past = rest.len().min(end + 1);
            self.text.push_str(&rest[end..past]);
            rest = &rest[past..];
        }
        let mut added = String::new();
        for (name, value) in defaults.into_iter().flatten() {
            self.charge((names.len() + name.len() + value.len()) as u64)?;
            if !names.contains(name) {
                let quote = if value.contains('"') { '\'' } else { '"' };
                added += &format!(" {name}={quote}{value}{quote}");
            }
        }
        self.text.insert_str(defaults_at, &added);
        Ok(rest)
    }

    /// Appends a quoted value, without its quotes.
    fn value(&mut self, mut rest: &str, depth: usize, quote: &str) -> Result<(), Problem> {
        while let Some(at) = rest.find('&') {
            self.text.push_str(&rest[..at]);
            rest = self.reference(&rest[at..], depth, Some(quote))?;
        }
        self.text.push_str(rest);
        Ok(())
    }

    /// Appends what the reference at the start of a text stands for. Returns what follows it.
    fn reference<'r>(
        &mut self,
        text: &'r str,
        depth: usize,
        quote: Option<&str>,
    ) -> Result<&'r str, Problem> {
        let is_end = |c: char| !c.is_alphanumeric() && !"-_.:".contains(c);
        let end = 1 + text[1..].find(is_end).unwrap_or(0);
        let value = self.definitions.entities.get(&text[1..end]);
        let Some(&value) = value.filter(|_| text[end..].starts_with(';')) else {
            // Characters and the five names of XML; the parser refuses the rest.
            self.text.push('&');
            return Ok(&text[1..]);
        };
        self.charge(REFERENCE_COST + value.len() as u64)?;
        if depth == MAX_DEPTH {
            let name = &text[..=end];
            return Err(Problem::Syntax {
                line: 1 + self.text.bytes().filter(|&b| b == b'\n').count() as u64,
                column: 1,
                message: format!("entities nest more than {MAX_DEPTH} levels deep at {name}"),
            });
        }
        let mut value = Cow::Borrowed(value);
        if value.contains("&#") {
            value = Cow::Owned(characters(&value));
        }
        if value.contains(['\n', '\r']) {
            value = Cow::Owned(value.replace(['\n', '\r'], " "));
        }
        match quote {
            None => self.content(&value, depth + 1)?,
            Some(quote) => {
                if value.contains(quote) {
                    let name = if quote == "\"" { "&quot;" } else { "&apos;" };
                    value = Cow::Owned(value.replace(quote, name));
                }
                self.value(&value, depth + 1, quote)?;
            }
        }
        Ok(&text[end + 1..])
    }

    fn charge(&mut self, bytes: u64) -> Result<(), Problem> {
        self.spent += bytes;
        if self.spent <= self.limit {
            return Ok(());
        }
        Err(Problem::LimitReached {
            what: "bytes of expanded entities",
            limit: self.limit,
            actual: self.spent,
        })
    }
}

/// Replaces references to characters, as the declaration of an entity does: `&#38;` becomes the
/// begin of a reference that is read where the entity is used.
fn characters(value: &str) -> String {
    let mut text = String::with_capacity(value.len());
    let mut rest = value;
    while let Some(at) = rest.find("&#") {
        text.push_str(&rest[..at]);
        rest = &rest[at + 2..];
        let is_end = |c: char| !c.is_ascii_alphanumeric();
        let (digits, after) = rest.split_at(rest.find(is_end).unwrap_or(rest.len()));
        let code = match digits.strip_prefix('x') {
            Some(digits) => u32::from_str_radix(digits, 16).ok(),
            None => digits.parse().ok(),
        };
        match (code.and_then(char::from_u32), after.strip_prefix(';')) {
            (Some(c), Some(after)) => {
                text.push(c);
                rest = after;
            }
            _ => text.push_str("&#"),
        }
    }
    text + rest
}

#[cfg(test)]
mod tests {
    use guideway_layout::Limits;

    use super::*;
    use crate::ReadOptions;

    fn expand_text(text: &str) -> Result<String, Problem> {
        let options = ReadOptions {
            limits: Limits::default(),
            ..ReadOptions::default()
        };
        let source = Source {
            name: "test",
            options: &options,
        };
        expanded(&source, text).map(Cow::into_owned)
    }

    fn root_of(declarations: &str, root: &str) -> String {
        let text = expand_text(&format!("<!DOCTYPE a [{declarations}]>{root}")).unwrap();
        text.trim_start().to_owned()
    }

    #[test]
    fn expands_text_markup_and_quotes() {
        let declarations =
            "<!ENTITY q 'it&#39;s \"x\"'><!ENTITY m '<b c=\"&q;\"/>'><!ENTITY n '&#38;#60;\n'>";
        for (root, expected) in [
            ("<a>&q;</a>", "<a>it's \"x\"</a>"),
            ("<a b='&q;'/>", "<a b='it&apos;s \"x\"'/>"),
            ("<a b=\"&q;\"/>", "<a b=\"it's &quot;x&quot;\"/>"),
            (
                "<a>&m;&amp;&u;&</a>",
                "<a><b c=\"it's &quot;x&quot;\"/>&amp;&u;&</a>",
            ),
            ("<a>&n;</a>", "<a>&#60; </a>"),
            (
                "<a><!--&q;--><![CDATA[&q;]]><?p &q;?></a>",
                "<a><!--&q;--><![CDATA[&q;]]><?p &q;?></a>",
            ),
        ] {
            assert_eq!(root_of(declarations, root), expected);
        }
    }

    #[test]
    fn adds_default_attributes_that_an_element_lacks() {
        let declarations = "<!ATTLIST g xmlns:k CDATA #FIXED 'u' k:e CDATA '\"'>";
        for (root, expected) in [
            ("<g k:e='x'/>", "<g xmlns:k=\"u\" k:e='x'/>"),
            ("<g\nxmlns:k = \"u\" k:e=''>", "<g\nxmlns:k = \"u\" k:e=''>"),
            ("<g/>", "<g xmlns:k=\"u\" k:e='\"'/>"),
            ("<gg/>", "<gg/>"),
        ] {
            assert_eq!(root_of(declarations, root), expected);
        }
    }

    #[test]
    fn keeps_line_numbers() {
        let text = expand_text("<!DOCTYPE a [\n<!ENTITY e '\n\n'>\n]>\n<a>&e;\n</a>").unwrap();
        assert_eq!(text.matches('\n').count(), 7 - 1);
        assert_eq!(text.lines().nth(5).unwrap().trim(), "<a>");
    }

    #[test]
    fn bounds_circles_towers_and_empty_entities() {
        let tower = |leaf: &str| {
            let level =
                |i: usize| format!("<!ENTITY e{i} '{}'>", format!("&e{};", i - 1).repeat(10));
            let levels: String = (1..12).map(level).collect();
            format!("<!DOCTYPE a [<!ENTITY e0 '{leaf}'>{levels}]><a b='&e11;'>&e11;</a>")
        };
        for text in [&tower("x"), &tower("")] {
            let error = expand_text(text);
            assert!(
                matches!(error, Err(Problem::LimitReached { .. })),
                "{error:?}"
            );
        }
        let error = expand_text("<!DOCTYPE a [<!ENTITY b '&c;'><!ENTITY c '&b;'>]><a>&b;</a>");
        assert!(matches!(error, Err(Problem::Syntax { .. })), "{error:?}");
    }
}
