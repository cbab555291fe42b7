//! Outcome of a read: compares it with the expected one, and checks texts of errors and
//! diagnostics.

use std::collections::BTreeSet;
use std::panic::{AssertUnwindSafe, catch_unwind};

use guideway_formats::{ReadError, ReadOptions, read_bytes};
use guideway_layout::{CheckOptions, Code, FindingKind, Layout, Severity};

/// Reason why the outcome of a file is wrong.
#[derive(Debug, PartialEq, thiserror::Error)]
pub(crate) enum Failure {
    #[error("{file}: the reader panicked")]
    Panic { file: String },
    #[error("{file}: expected `{expected}`, found `{found}`{details}")]
    Outcome {
        file: String,
        expected: String,
        found: String,
        details: String,
    },
    #[error("{file}: incomplete error text: {text}")]
    ErrorText { file: String, text: String },
    #[error("{file}: path {path} is not finite")]
    NonFinite { file: String, path: String },
    #[error("{file}: incomplete diagnostic: {diagnostic}")]
    Diagnostic { file: String, diagnostic: String },
}

/// Reads bytes; a panic is a failure.
pub(crate) fn read(file: &str, bytes: &[u8]) -> Result<Result<Layout, ReadError>, Failure> {
    let read = || read_bytes(file, bytes, &ReadOptions::default());
    catch_unwind(AssertUnwindSafe(read)).map_err(|_| Failure::Panic { file: file.into() })
}

/// Reads bytes and compares the outcome with the expected one.
pub(crate) fn check(file: &str, bytes: &[u8], expected: &str) -> Result<(), Failure> {
    let result = read(file, bytes)?;
    let outcome = match &result {
        Ok(layout) => {
            check_layout(file, layout)?;
            format!("ok {}", codes(layout).join(","))
        }
        Err(error) => {
            check_error(file, error)?;
            format!("error {}", error.code())
        }
    };
    if outcome.trim() == expected {
        return Ok(());
    }
    let details = match result {
        Ok(layout) => {
            let diagnostics = layout.diagnostics.iter();
            let lines = diagnostics.map(|d| format!("\n  {}: {}", d.place, d.message));
            lines.collect()
        }
        Err(error) => format!("\n  {error}"),
    };
    Err(Failure::Outcome {
        file: file.into(),
        expected: expected.into(),
        found: outcome.trim().into(),
        details,
    })
}

/// Checks that any bytes give a valid layout or a complete error.
pub(crate) fn check_any(file: &str, bytes: &[u8]) {
    match read(file, bytes).unwrap() {
        Ok(layout) => check_layout(file, &layout).unwrap(),
        Err(error) => check_error(file, &error).unwrap(),
    }
}

/// Returns the codes of the reader, and the warnings of a check of the layout.
fn codes(layout: &Layout) -> Vec<&'static str> {
    let checked = guideway_layout::check(layout, &CheckOptions::default());
    let kinds = FindingKind::of([&checked]).into_iter();
    let warned = kinds.filter(|kind| kind.severity > Severity::Info);
    let warned = warned.map(|kind| kind.code);
    let found = layout.diagnostics.counts().map(|(code, _)| code);
    let all: BTreeSet<Code> = found.chain(warned).collect();
    all.into_iter().map(Code::name).collect()
}

/// Checks that an error names the file, the problem and the remedy.
pub(crate) fn check_error(file: &str, error: &ReadError) -> Result<(), Failure> {
    let (text, remedy) = (error.to_string(), error.remedy());
    let is_complete = text.contains(file)
        && text.len() > file.len() + remedy.len() + 10
        && !remedy.is_empty()
        && text.contains(&remedy)
        && !text.contains('\0');
    let file = file.into();
    is_complete
        .then_some(())
        .ok_or(Failure::ErrorText { file, text })
}

/// Checks that a layout can be drawn, and that each diagnostic has place, message and remedy.
fn check_layout(file: &str, layout: &Layout) -> Result<(), Failure> {
    for path in layout.paths.iter() {
        let mut points = path.runs().flat_map(|run| run.iter());
        if !points.all(|p| p.is_finite()) {
            let (file, path) = (file.into(), path.id().into());
            return Err(Failure::NonFinite { file, path });
        }
    }
    for diagnostic in layout.diagnostics.iter() {
        let texts = [
            &diagnostic.place.element,
            &diagnostic.message,
            &diagnostic.remedy,
        ];
        if texts.iter().any(|text| text.is_empty()) {
            let diagnostic = format!("{diagnostic:?}");
            let file = file.into();
            return Err(Failure::Diagnostic { file, diagnostic });
        }
    }
    Ok(())
}
