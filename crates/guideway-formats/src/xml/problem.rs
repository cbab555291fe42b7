//! Converts faults of XML to problems with line and column.

use roxmltree::Error;

use crate::Problem;
use crate::text::{line_column, printable};

/// The problem of markup that begins at a byte and does not end.
pub(super) fn unterminated(text: &str, at: usize) -> Problem {
    let (line, column) = line_column(text, at);
    Problem::Truncated {
        at: text.len() as u64,
        detail: format!("the markup at line {line}, column {column} is not terminated"),
    }
}

/// Converts an error of the parser. `elements` is the limit of elements.
pub(super) fn problem(error: &Error, text: &str, elements: u64) -> Problem {
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
