//! Arrow files as outputs: checks their names, writes them atomically.

use std::io::{self, ErrorKind};
use std::path::Path;

use guideway::formats::arrow::{WriteError, WriteProblem};
use guideway::layout::UserError;
use guideway::{SaveError, replace_file};

use super::input;

/// Extensions of Arrow files.
const EXTENSIONS: [&str; 2] = ["arrow", "feather"];

/// Rejects an output that is not an Arrow file, before any long work.
pub(crate) fn check_output(output: &Path) -> Result<(), UserError> {
    let extension = output.extension().unwrap_or_default();
    if !EXTENSIONS.iter().any(|e| extension.eq_ignore_ascii_case(e)) {
        return Err(UserError::new(
            "target-format",
            format!(
                "{}: not the name of an Arrow file, which ends in .arrow or .feather",
                output.display()
            ),
            "Rename the output, such as `site.arrow`; `guideway render` writes pictures",
        ));
    }
    if output.exists() && !output.is_file() {
        return Err(save_error(output, ErrorKind::IsADirectory.into()));
    }
    input::check_output(None, output)
}

/// Writes an Arrow file atomically with `write`. Returns its result and the size of the file.
pub(crate) fn replace<T>(
    output: &Path,
    write: impl FnOnce(&Path) -> Result<T, WriteError>,
) -> Result<(T, u64), UserError> {
    replace_file(output, |file| {
        let result = write(file).map_err(|error| {
            let remedy: String = error.remedy().into();
            match error.problem {
                WriteProblem::Io(problem) => save_error(output, problem),
                other => UserError::new("save", format!("{}: {other}", output.display()), remedy),
            }
        })?;
        let size = std::fs::metadata(file).map_err(|problem| save_error(output, problem))?;
        Ok((result, size.len()))
    })
}

fn save_error(output: &Path, problem: io::Error) -> UserError {
    SaveError {
        path: output.to_owned(),
        problem,
    }
    .into()
}
