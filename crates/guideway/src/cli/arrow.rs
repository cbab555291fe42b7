//! Arrow files as outputs: checks their names.

use std::path::Path;

use guideway::layout::{UserError, shown_path};

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
                shown_path(output)
            ),
            "Rename the output, such as `site.arrow`; `guideway render` writes pictures",
        ));
    }
    input::check_output(None, output)
}
