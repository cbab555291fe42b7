use std::fs;
use std::io::{self, ErrorKind, Write};
use std::path::Path;

use guideway::{SaveError, replace_file};
use serde::Serialize;
use serde_json::json;

use super::Failure;
use super::activity::Activity;

/// Version of the JSON answers. A new key does not raise it; a changed or missing one does.
pub(crate) const REPORT_VERSION: u32 = 1;

/// Where answers go, and how.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Output {
    json: bool,
    quiet: bool,
}

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

impl Output {
    pub(crate) fn new(json: bool, quiet: bool) -> Self {
        Self { json, quiet }
    }

    /// Whether answers are JSON.
    pub(crate) fn is_json(self) -> bool {
        self.json
    }

    /// Shows what takes long, until the answer is dropped.
    pub(crate) fn activity(self, what: impl Into<String>) -> Activity {
        Activity::start(what.into(), !self.quiet && !self.json)
    }

    /// Answers with a report: JSON if that was asked for, else the text that `text` makes.
    pub(crate) fn report<T: Serialize>(
        self,
        name: &str,
        body: &T,
        text: impl FnOnce() -> String,
    ) -> Result<(), Failure> {
        if self.json {
            print(&envelope(name, REPORT_VERSION, body)?)
        } else if self.quiet {
            Ok(())
        } else {
            print(text().as_bytes())
        }
    }

    /// Says something beside the answer, where it does not mix with bytes on standard output.
    pub(crate) fn note(self, text: &str) {
        if !self.quiet && !self.json {
            // A note that cannot be shown changes nothing about the work.
            let _ = writeln!(io::stderr(), "{text}");
        }
    }

    /// Reports a failure.
    pub(crate) fn failure(self, failure: &Failure) {
        let Failure {
            code,
            message,
            remedy,
        } = failure;
        if self.json {
            let error = json!({ "code": code, "message": message, "remedy": remedy });
            if let Ok(bytes) = envelope("error", REPORT_VERSION, &json!({ "error": error })) {
                // The exit code says the same to a reader that has gone away.
                let _ = print(&bytes);
            }
        } else {
            let _ = writeln!(io::stderr(), "error: {message}\nhint: {remedy}");
        }
    }
}

fn envelope<T: Serialize>(name: &str, version: u32, body: &T) -> Result<Vec<u8>, Failure> {
    let whole = Envelope {
        guideway: Header {
            report: name,
            version,
        },
        body,
    };
    let mut bytes = serde_json::to_vec_pretty(&whole).map_err(|error| Failure {
        code: "json",
        message: format!("cannot write the report as JSON: {error}"),
        remedy: "Leave --json out".into(),
    })?;
    bytes.push(b'\n');
    Ok(bytes)
}

/// Saves a report in the form that `--json` prints.
pub(crate) fn save_report<T: Serialize>(
    path: &Path,
    name: &str,
    version: u32,
    body: &T,
) -> Result<(), Failure> {
    let bytes = envelope(name, version, body)?;
    save(path, &bytes)
}

/// Saves a file whole or not at all.
pub(crate) fn save(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    let write = |file: &Path| {
        fs::write(file, bytes).map_err(|problem| SaveError {
            path: path.to_owned(),
            problem,
        })
    };
    Ok(replace_file(path, write)?)
}

/// Writes to standard output. A reader that wants no more, such as `head`, is no failure.
pub(crate) fn print(bytes: &[u8]) -> Result<(), Failure> {
    let mut stdout = io::stdout().lock();
    match stdout.write_all(bytes).and_then(|()| stdout.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(Failure {
            code: "stdout",
            message: format!("cannot write to standard output: {error}"),
            remedy: "Check where the output is sent to".into(),
        }),
        _ => Ok(()),
    }
}
