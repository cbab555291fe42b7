//! JSON parsing: checks a text against the limits, parses it into a record, and converts parser
//! errors to problems with line and column.

use serde::Deserialize;

use super::field::{Field, FromJson};
use super::limits;
use super::scan::offset_in;
use crate::source::Source;
use crate::text::{line_column, printable};
use crate::{Problem, ReadError};

/// Parses a whole text as one value.
///
/// # Errors
/// When the text exceeds a limit, is not JSON, or the caller cancels the read.
pub(crate) fn parse<'t, T: FromJson<'t>>(
    source: &Source<'_>,
    text: &'t str,
) -> Result<Field<T>, ReadError> {
    parse_part(source, text, text)
}

/// Parses a part of a text, or a text of its own, as one value. Errors have their place in the
/// whole text.
///
/// # Errors
/// As [`parse`].
pub(crate) fn parse_part<'t, T: FromJson<'t>>(
    source: &Source<'_>,
    text: &str,
    part: &'t str,
) -> Result<Field<T>, ReadError> {
    limits::check(part, &source.options.limits).map_err(|p| source.fail(p))?;
    source.check_cancelled()?;
    parse_checked(part).map_err(|error| {
        let (text, at) = offset_in(text, part).map_or((part, 0), |at| (text, at));
        source.fail(problem(&error, text, at))
    })
}

/// Parses a whole text that is within the limits.
pub(crate) fn parse_checked<'t, T: FromJson<'t>>(text: &'t str) -> serde_json::Result<Field<T>> {
    let mut parser = serde_json::Deserializer::from_str(text);
    let value = Field::deserialize(&mut parser)?;
    parser.end().map(|()| value)
}

/// Converts a parser error to a problem. The parser has seen the part of `text` from byte `at` on.
pub(crate) fn problem(error: &serde_json::Error, text: &str, at: usize) -> Problem {
    let (line, column) = match (
        line_column(text, at),
        error.line() as u64,
        error.column() as u64,
    ) {
        ((line, column), 0 | 1, within) => (line, (column + within).saturating_sub(1)),
        ((line, _), lines, within) => (line + lines - 1, within),
    };
    let message = error.to_string();
    if error.is_eof() || message.starts_with("invalid number") && ends_in_number(text) {
        let (line, column) = line_column(text, text.len());
        return Problem::Truncated {
            at: text.len() as u64,
            detail: format!("the JSON text is cut at line {line}, column {column}"),
        };
    }
    if message.starts_with("recursion limit exceeded") {
        return Problem::TooDeep {
            limit: 128,
            line,
            column,
        };
    }
    let message = message.split(" at line ").next().unwrap_or(&message);
    Problem::Syntax {
        line,
        column,
        message: printable(&reword(
            message,
            rest_at(&text[at..], error.line(), error.column()),
        )),
    }
}

/// Returns true if a text is cut within a number: its last character asks for a digit. The parser
/// reports such a number as invalid, not as the end of the text.
fn ends_in_number(text: &str) -> bool {
    text.ends_with(['-', '+', '.', 'e', 'E'])
}

/// Returns the rest of the line at a place.
fn rest_at(text: &str, line: usize, column: usize) -> &str {
    let line = text.lines().nth(line.saturating_sub(1)).unwrap_or("");
    line.get(column.saturating_sub(1)..).unwrap_or("")
}

/// Rewords a message of the parser for people; `rest` is the text at the place.
fn reword(message: &str, rest: &str) -> String {
    const OTHER_QUOTES: [char; 7] = [
        '\'', '`', '\u{2018}', '\u{2019}', '\u{201C}', '\u{201D}', '\u{201E}',
    ];
    const COMMENTS: [&str; 3] = ["//", "/*", "#"];
    let is_text = matches!(message, "key must be a string" | "expected value");
    if is_text && rest.starts_with(OTHER_QUOTES) {
        let quote = rest.chars().next().unwrap_or_default();
        return format!("found the quote {quote}; JSON wants double quotes around names and texts");
    }
    let is_between = message.starts_with("expected `");
    if (is_text || is_between) && COMMENTS.iter().any(|mark| rest.starts_with(mark)) {
        return "found a comment; JSON has none".into();
    }
    let end = rest.find(|c: char| !c.is_ascii_alphanumeric() && c != '-');
    match (message, &rest[..end.unwrap_or(rest.len())]) {
        ("expected value", word @ ("NaN" | "Infinity" | "nan" | "inf")) => {
            format!("expected a number, found {word}; JSON has no such number")
        }
        ("invalid number", word) if word.contains("nfinity") => {
            "expected a number, found -Infinity; JSON has no such number".into()
        }
        ("number out of range", _) => "the number exceeds the range of double precision".into(),
        ("key must be a string", _) => "expected a key in quotes; check for a surplus comma".into(),
        ("trailing comma", _) => "surplus comma after the last value".into(),
        ("trailing characters", _) if rest.starts_with('{') => {
            "a second object follows; write each layout to a file of its own".into()
        }
        ("trailing characters", _) => "surplus text after the end of the layout".into(),
        ("expected value", "") => "expected a value".into(),
        ("expected value", word) => format!("expected a value, found `{word}`"),
        (other, _) => other.into(),
    }
}
