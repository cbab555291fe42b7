//! Errors of the command itself, and exit codes. Each crate converts its own errors to
//! [`UserError`].

use std::io;
use std::path::Path;

use guideway::layout::{UserError, shown_path};

/// Code of errors in the arguments.
const USAGE: &str = "usage";

/// Arguments that contradict each other, or lack one.
pub(crate) fn usage_error(message: impl Into<String>, remedy: impl Into<String>) -> UserError {
    UserError::new(USAGE, message, remedy)
}

/// An error of the argument parser, on one line.
pub(crate) fn parser_error(error: &clap::Error) -> UserError {
    let text = error.to_string();
    let message = text.strip_prefix("error: ").unwrap_or(&text);
    let first = message.split("\n\n").next().unwrap_or(message);
    let words: Vec<&str> = first.split_whitespace().collect();
    usage_error(words.join(" "), "See `guideway --help`")
}

/// Why a file beside the layouts cannot be read.
pub(crate) fn unreadable(error: &io::Error) -> String {
    match error.kind() {
        io::ErrorKind::NotFound => "the file does not exist".to_owned(),
        _ => error.to_string(),
    }
}

/// An output file that is also an input.
pub(crate) fn same_file_error(path: &Path) -> UserError {
    UserError::new(
        "same-file",
        format!("{}: the output would replace an input", shown_path(path)),
        "Choose another name for the output",
    )
}

/// A report that cannot be encoded as JSON. `remedy` names the option that avoids JSON.
pub(crate) fn json_error(error: &serde_json::Error, remedy: &str) -> UserError {
    let message = format!("cannot write the report as JSON: {error}");
    UserError::new("json", message, remedy)
}

/// Outcome of a subcommand that ran to its end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Exit {
    /// Success.
    Clean,
    /// `check` found what it must not pass, or `diff --exit-code` found differences.
    Found,
    /// `check` could read no file, or `bench` measured no method.
    Failed,
    /// Ctrl-C stopped the command; its results so far are saved.
    Interrupted,
}

impl Exit {
    /// The exit code of the process.
    pub(crate) fn code(self) -> u8 {
        match self {
            Self::Clean => 0,
            Self::Found => 1,
            Self::Failed => ERROR,
            Self::Interrupted => INTERRUPTED as u8,
        }
    }
}

/// Exit code of every error.
pub(crate) const ERROR: u8 = 2;
/// Exit code after Ctrl-C: 128 plus the number of the signal, the convention of shells.
pub(crate) const INTERRUPTED: i32 = 130;
