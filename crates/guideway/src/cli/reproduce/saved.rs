//! The files of a run: writes them, and reads a run back.

use std::fs::{self, File};
use std::io::{BufReader, Read};
use std::path::Path;

use guideway::SaveError;
use guideway::layout::{UserError, shown_path};
use guideway_reproduce::report;
use guideway_reproduce::reproduce::{ResumeError, Run};
use serde::Deserialize;

use crate::cli::error::unreadable;
use crate::cli::output;

/// Name of the report, in the JSON answer and in the run file.
pub(super) const REPORT: &str = "reproduce";
/// Name of the file that holds the measurements of a run.
pub(super) const RUN_FILE: &str = "run.json";

/// Version of the run file. A new key does not raise it; a changed or removed one does.
const RUN_VERSION: u32 = 2;
/// Most bytes of a run file: the pictures of a full run take a few megabytes.
const MAX_BYTES: u64 = 256 << 20;

/// The header of a saved report.
#[derive(Deserialize)]
struct Envelope {
    guideway: Header,
}

#[derive(Deserialize)]
struct Header {
    report: String,
    version: u32,
}

/// Creates the folder if it does not exist, and checks that it can be written.
pub(super) fn create_folder(folder: &Path) -> Result<(), UserError> {
    let created = fs::create_dir_all(folder).and_then(|()| tempfile::tempfile_in(folder));
    created.map_err(|problem| SaveError {
        path: folder.to_owned(),
        problem,
    })?;
    Ok(())
}

pub(super) fn write_run(folder: &Path, run: &Run) -> Result<(), UserError> {
    output::save_report(&folder.join(RUN_FILE), REPORT, RUN_VERSION, run)
}

pub(super) fn write_report(folder: &Path, run: &Run) -> Result<(), UserError> {
    for file in report::files(run) {
        output::save(&folder.join(&file.name), file.text.as_bytes())?;
    }
    Ok(())
}

/// Reads a run that [`write_run`] has written.
pub(super) fn read(path: &Path) -> Result<Run, UserError> {
    let error = |code, problem| run_file_error(path, code, problem);
    let mut text = String::new();
    File::open(path)
        .and_then(|file| BufReader::new(file.take(MAX_BYTES + 1)).read_to_string(&mut text))
        .map_err(|problem| error("io", unreadable(&problem)))?;
    if text.len() as u64 > MAX_BYTES {
        return Err(error(
            "limit",
            format!("larger than the limit of {MAX_BYTES} bytes"),
        ));
    }
    let syntax = |problem: serde_json::Error| error("structure", problem.to_string());
    let Envelope { guideway } = serde_json::from_str(&text).map_err(syntax)?;
    if (guideway.report.as_str(), guideway.version) != (REPORT, RUN_VERSION) {
        let found = format!("{} of version {}", guideway.report, guideway.version);
        let wanted = format!("{REPORT} of version {RUN_VERSION}");
        let problem = format!("found a report `{found}`, expected `{wanted}`");
        return Err(error("structure", problem));
    }
    serde_json::from_str(&text).map_err(syntax)
}

/// Converts the error of continuing the run in a folder.
pub(super) fn resume_error(folder: &Path, error: ResumeError) -> UserError {
    let path = &folder.join(RUN_FILE);
    match error {
        ResumeError::Damaged(problem) => run_file_error(path, "structure", problem),
        ResumeError::Device { .. } => UserError {
            remedy:
                "Continue it on the computer that began it, or start a new run with another --out"
                    .to_owned(),
            ..run_file_error(path, "other-device", error.to_string())
        },
        ResumeError::Render(error) => error.into(),
    }
}

fn run_file_error(path: &Path, code: &'static str, problem: String) -> UserError {
    UserError::new(
        code,
        format!("{}: {problem}", shown_path(path)),
        format!("Name a {RUN_FILE} that `guideway reproduce` wrote"),
    )
}
