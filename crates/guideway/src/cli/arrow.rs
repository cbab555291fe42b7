//! Writing Arrow files from the command.

use std::io::{self, ErrorKind};
use std::path::Path;

use guideway::formats::arrow::{WriteError, WriteProblem};
use guideway::{SaveError, replace_file};

use super::{Failure, input};

/// Endings of the names of the files that can be written.
const ENDINGS: [&str; 2] = ["arrow", "feather"];

/// Whether the name of a file is that of an Arrow file.
pub(crate) fn has_ending(output: &Path) -> bool {
    let ending = output.extension().unwrap_or_default();
    ENDINGS.iter().any(|e| ending.eq_ignore_ascii_case(e))
}

/// Refuses what cannot be an Arrow output, before any long work is done.
pub(crate) fn check_output(output: &Path) -> Result<(), Failure> {
    if !has_ending(output) {
        return Err(Failure {
            code: "target-format",
            message: format!(
                "{}: only Arrow files can be written, which end in .arrow or .feather",
                output.display()
            ),
            remedy: "Name the output so, such as `site.arrow`; for a picture use `guideway render`"
                .into(),
        });
    }
    if output.exists() && !output.is_file() {
        return Err(unwritten(output, ErrorKind::IsADirectory.into()));
    }
    input::check_output(None, output)
}

/// Lets `write` make an Arrow file that appears whole or not at all, and returns its size too.
pub(crate) fn replace<T>(
    output: &Path,
    write: impl FnOnce(&Path) -> Result<T, WriteError>,
) -> Result<(T, u64), Failure> {
    replace_file(output, |file| {
        let result = write(file).map_err(|error| {
            let remedy = error.remedy().into();
            match error.problem {
                WriteProblem::Io(problem) => unwritten(output, problem),
                other => Failure {
                    code: "save",
                    message: format!("{}: {other}", output.display()),
                    remedy,
                },
            }
        })?;
        let size = std::fs::metadata(file).map_err(|problem| unwritten(output, problem))?;
        Ok((result, size.len()))
    })
}

fn unwritten(output: &Path, problem: io::Error) -> Failure {
    SaveError {
        path: output.to_owned(),
        problem,
    }
    .into()
}
