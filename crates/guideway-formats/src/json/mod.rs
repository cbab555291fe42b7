//! Reading JSON that need not be what the format says: every field tells what was found in its place.
//!
//! A wrong type must not end the read, and the file must not become a tree of values that is many times
//! its size. So the fields that are needed are read straight into records, and the rest is skipped.

mod attributes;
mod check;
mod field;
mod later;
mod limits;
mod lines;
mod record;

pub(crate) use self::attributes::{AttributeKey, Attributes, HasAttributes};
pub(crate) use self::check::{items, within};
pub(crate) use self::field::{Field, FromJson, Key};
pub(crate) use self::later::Later;
pub(crate) use self::lines::add_lines;
pub(crate) use self::record::record;

use serde::Deserialize;

use crate::source::Source;
use crate::text::{line_column, printable};
use crate::{Problem, ReadError};

/// Parses a whole text as one value.
pub(crate) fn parse<'t, T: FromJson<'t>>(
    source: &Source<'_>,
    text: &'t str,
) -> Result<Field<T>, ReadError> {
    limits::check(text, &source.options.limits).map_err(|p| source.fail(p))?;
    source.check_cancelled()?;
    let mut parser = serde_json::Deserializer::from_str(text);
    let value = Field::deserialize(&mut parser);
    value
        .and_then(|value| parser.end().map(|()| value))
        .map_err(|error| source.fail(problem(&error, text, 0)))
}

/// What is wrong with a text, of which the part from byte `at` on was parsed.
fn problem(error: &serde_json::Error, text: &str, at: usize) -> Problem {
    let (line, column) = match (
        line_column(text, at),
        error.line() as u64,
        error.column() as u64,
    ) {
        ((line, column), 0 | 1, within) => (line, (column + within).saturating_sub(1)),
        ((line, _), lines, within) => (line + lines - 1, within),
    };
    if error.is_eof() {
        let (line, column) = line_column(text, text.len());
        return Problem::Truncated {
            at: text.len() as u64,
            detail: format!("the JSON goes on after line {line}, column {column}"),
        };
    }
    let message = error.to_string();
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
        message: printable(&friendly(
            message,
            word_at(&text[at..], error.line(), error.column()),
        )),
    }
}

/// What stands at a place, as far as it is one word.
fn word_at(text: &str, line: usize, column: usize) -> &str {
    let line = text.lines().nth(line.saturating_sub(1)).unwrap_or("");
    let from = line.get(column.saturating_sub(1)..).unwrap_or("");
    let end = from.find(|c: char| !c.is_ascii_alphanumeric() && c != '-');
    &from[..end.unwrap_or(from.len())]
}

fn friendly(message: &str, word: &str) -> String {
    match (message, word) {
        ("expected value", "NaN" | "Infinity" | "nan" | "inf") => {
            format!("{word} stands where JSON wants a number; JSON has no such number")
        }
        ("invalid number", _) if word.contains("nfinity") => {
            "-Infinity stands where JSON wants a number; JSON has no such number".into()
        }
        ("number out of range", _) => "the number is too large for any computer to hold".into(),
        ("key must be a string", _) => {
            "a key in quotes was expected; perhaps there is a comma too many".into()
        }
        ("trailing comma", _) => "there is a comma after the last value".into(),
        ("trailing characters", _) => "there is more text after the end of the layout".into(),
        ("expected value", "") => "a value was expected here".into(),
        ("expected value", word) => format!("a value was expected here, not `{word}`"),
        (other, _) => other.into(),
    }
}
