//! Reports and errors as text or JSON, and files that hold them.

use std::io::{self, ErrorKind, Write};
use std::path::Path;

use guideway::layout::{UserError, is_hidden, shown_lines};
use guideway::{SaveError, replace_file};
use serde::Serialize;
use serde_json::json;

use super::colors::paint;
use super::error::json_error;
use super::progress_bar::ProgressBar;

/// Version of the JSON reports. A new key does not raise it; a changed or removed one does.
pub(crate) const REPORT_VERSION: u32 = 1;

/// Selects text or JSON, and whether to print anything besides errors.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Output {
    json: bool,
    quiet: bool,
    /// Standard output holds a file: reports for people go to standard error.
    is_beside: bool,
}

/// A report with its header: the form of every JSON answer.
#[derive(Serialize)]
struct Envelope<'a, T> {
    guideway: Header<'a>,
    #[serde(flatten)]
    body: &'a T,
}

#[derive(Serialize)]
struct Header<'a> {
    report: &'a str,
    version: u32,
}

/// Returns `true` if a path names standard output.
pub(crate) fn is_stdout(path: &Path) -> bool {
    path == Path::new("-")
}

impl Output {
    pub(crate) fn new(json: bool, quiet: bool) -> Self {
        Self {
            json,
            quiet,
            is_beside: false,
        }
    }

    /// The output of reports beside that of a file, if there is one, which may be standard output.
    pub(crate) fn beside(self, file: Option<&Path>) -> Self {
        Self {
            is_beside: file.is_some_and(is_stdout),
            ..self
        }
    }

    /// Returns `true` if reports are JSON.
    pub(crate) fn is_json(self) -> bool {
        self.json
    }

    /// Returns `true` if reports for people are left out, but for errors.
    pub(crate) fn is_quiet(self) -> bool {
        self.quiet && !self.json
    }

    /// Shows the progress of an operation until the result is dropped.
    pub(crate) fn progress(self, label: impl Into<String>) -> ProgressBar {
        ProgressBar::start(label.into(), !self.quiet && !self.json)
    }

    /// Prints a report: as JSON under `--json`, else the result of `text`.
    pub(crate) fn report<T: Serialize>(
        self,
        name: &str,
        body: &T,
        text: impl FnOnce() -> String,
    ) -> Result<(), UserError> {
        self.report_to(None, name, body, text)
    }

    /// Saves a report in a file, in the form in which [`Self::report`] prints it; without a file,
    /// prints it.
    pub(crate) fn report_to<T: Serialize>(
        self,
        file: Option<&Path>,
        name: &str,
        body: &T,
        text: impl FnOnce() -> String,
    ) -> Result<(), UserError> {
        if let Some(file) = file {
            return match self.json {
                true => save_report(file, name, REPORT_VERSION, body),
                false => save(file, shown_lines(&text()).as_bytes()),
            };
        }
        if self.json {
            print(&envelope(name, REPORT_VERSION, body)?)
        } else if self.is_beside {
            self.note(text().trim_end());
            Ok(())
        } else if self.quiet {
            Ok(())
        } else {
            print_for_people(&shown_lines(&text()))
        }
    }

    /// Prints a note to standard error, apart from bytes on standard output.
    pub(crate) fn note(self, text: &str) {
        if !self.quiet && !self.json {
            // The result does not depend on a note that nobody can read.
            let _ = writeln!(anstream::stderr(), "{}", paint(&shown_lines(text)));
        }
    }

    /// Prints an error: as JSON to standard output, else to standard error.
    pub(crate) fn error(self, error: &UserError) {
        let UserError {
            code,
            message,
            remedy,
        } = error;
        if self.json {
            let error = json!({ "code": code, "message": message, "remedy": remedy });
            if let Ok(bytes) = envelope("error", REPORT_VERSION, &json!({ "error": error })) {
                // A reader that has closed the pipe still has the exit code.
                let _ = print(&bytes);
            }
        } else {
            let (message, remedy) = (shown_lines(message), shown_lines(remedy));
            let text = paint(&format!("error: {message}\nhint: {remedy}"));
            let _ = writeln!(anstream::stderr(), "{text}");
        }
    }
}

fn envelope<T: Serialize>(name: &str, version: u32, body: &T) -> Result<Vec<u8>, UserError> {
    let whole = Envelope {
        guideway: Header {
            report: name,
            version,
        },
        body,
    };
    json_text(&whole).map_err(|error| json_error(&error, "Omit --json"))
}

/// A value as JSON with a line break at its end. Characters of texts that would steer a terminal or
/// reverse the direction of text are escapes, which stand for the same value.
///
/// # Errors
/// When the value has no JSON.
pub(crate) fn json_text(value: &impl Serialize) -> serde_json::Result<Vec<u8>> {
    let plain = serde_json::to_string_pretty(value)? + "\n";
    let steers = |c: char| is_hidden(c) && c != '\n';
    if !plain.contains(steers) {
        return Ok(plain.into_bytes());
    }
    let mut text = String::with_capacity(plain.len() + 8);
    for c in plain.chars() {
        match steers(c) {
            // None of them is beyond the basic plane.
            true => text += &format!("\\u{:04x}", u32::from(c)),
            false => text.push(c),
        }
    }
    Ok(text.into_bytes())
}

/// Saves a report in the form that `--json` prints.
pub(crate) fn save_report<T: Serialize>(
    path: &Path,
    name: &str,
    version: u32,
    body: &T,
) -> Result<(), UserError> {
    let bytes = envelope(name, version, body)?;
    save(path, &bytes)
}

/// Saves a file atomically.
pub(crate) fn save(path: &Path, bytes: &[u8]) -> Result<(), UserError> {
    Ok(replace_file(path, |file| {
        file.write_all(bytes).map_err(|problem| SaveError {
            path: path.to_owned(),
            problem,
        })
    })?)
}

/// Writes to standard output. A closed pipe (`| head`) is not an error.
pub(crate) fn print(bytes: &[u8]) -> Result<(), UserError> {
    print_to(&mut io::stdout().lock(), bytes)
}

/// Writes text to standard output, in colors on a terminal, unless `NO_COLOR` is set, or wherever
/// `CLICOLOR_FORCE` is.
pub(crate) fn print_for_people(text: &str) -> Result<(), UserError> {
    print_to(&mut anstream::stdout().lock(), paint(text).as_bytes())
}

fn print_to(stdout: &mut impl Write, bytes: &[u8]) -> Result<(), UserError> {
    match stdout.write_all(bytes).and_then(|()| stdout.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(stdout_error(&error)),
        _ => Ok(()),
    }
}

/// Standard output cannot be written.
pub(crate) fn stdout_error(error: &io::Error) -> UserError {
    UserError::new(
        "stdout",
        format!("cannot write to standard output: {error}"),
        "Check the target of the redirection",
    )
}
