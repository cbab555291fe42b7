use std::fs::{self, File};
use std::io::{BufReader, Read};
use std::path::Path;

use guideway::SaveError;
use guideway_reproduce::report;
use guideway_reproduce::reproduce::{ResumeError, Run};
use serde::Deserialize;

use super::text::REPORT;
use crate::cli::Failure;
use crate::cli::output;

/// Name of the file with the run.
pub(super) const RUN: &str = "run.json";
/// Version of that file. A new key does not raise it; a changed or missing one does.
const RUN_VERSION: u32 = 2;
/// Most bytes of a run that are read: pictures of a full run take a few megabytes.
const MOST_BYTES: u64 = 256 << 20;

/// What says what a saved report is.
#[derive(Deserialize)]
struct Envelope {
    guideway: Header,
}

#[derive(Deserialize)]
struct Header {
    report: String,
    version: u32,
}

/// Makes the folder, if need be, and sees whether files can be put there.
pub(super) fn make_folder(folder: &Path) -> Result<(), Failure> {
    let made = fs::create_dir_all(folder).and_then(|()| tempfile::tempfile_in(folder));
    made.map_err(|problem| SaveError {
        path: folder.to_owned(),
        problem,
    })?;
    Ok(())
}

pub(super) fn write_run(folder: &Path, run: &Run) -> Result<(), Failure> {
    output::save_report(&folder.join(RUN), REPORT, RUN_VERSION, run)
}

pub(super) fn write_report(folder: &Path, run: &Run) -> Result<(), Failure> {
    for file in report::files(run) {
        output::save(&folder.join(&file.name), file.text.as_bytes())?;
    }
    Ok(())
}

/// Reads a run that [`write_run`] has written.
pub(super) fn read(path: &Path) -> Result<Run, Failure> {
    let refuse = |code, what| refused(path, code, what);
    let mut text = String::new();
    File::open(path)
        .and_then(|file| BufReader::new(file.take(MOST_BYTES + 1)).read_to_string(&mut text))
        .map_err(|problem| refuse("io", problem.to_string()))?;
    if text.len() as u64 > MOST_BYTES {
        return Err(refuse("limit", format!("more than {MOST_BYTES} bytes")));
    }
    let syntax = |error: serde_json::Error| refuse("structure", error.to_string());
    let Envelope { guideway } = serde_json::from_str(&text).map_err(syntax)?;
    if (guideway.report.as_str(), guideway.version) != (REPORT, RUN_VERSION) {
        let found = format!("{} of version {}", guideway.report, guideway.version);
        let wanted = format!("{REPORT} of version {RUN_VERSION}");
        let what = format!("this is a report `{found}`, not `{wanted}`");
        return Err(refuse("structure", what));
    }
    serde_json::from_str(&text).map_err(syntax)
}

/// Why the run of a folder cannot go on.
pub(super) fn cannot_go_on(folder: &Path, error: ResumeError) -> Failure {
    let path = &folder.join(RUN);
    match error {
        ResumeError::Damaged(what) => refused(path, "structure", what),
        ResumeError::Device { .. } => Failure {
            remedy: "Continue it where it was begun, or measure all of it here with another --out"
                .to_owned(),
            ..refused(path, "other-device", error.to_string())
        },
        ResumeError::Render(error) => error.into(),
    }
}

fn refused(path: &Path, code: &'static str, what: String) -> Failure {
    Failure {
        code,
        message: format!("{}: {what}", path.display()),
        remedy: format!("Give the {RUN} that `guideway reproduce` has written"),
    }
}
