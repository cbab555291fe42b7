//! Arguments of `view`.

use std::path::PathBuf;

use guideway::AUTO;
use guideway::layout::{UserError, shown_path};

use crate::cli::error::usage_error;
use crate::cli::output::Output;
use crate::cli::values;

#[derive(Debug, clap::Args)]
#[command(
    after_help = "F1 in the window lists all keys. Files can also be dropped onto the window."
)]
pub(crate) struct Args {
    /// Layout files; the content decides the format
    #[arg(value_name = "FILE")]
    pub(super) files: Vec<PathBuf>,
    /// File to show below the layouts: a layout, a drawing, a `map.yaml` of ROS, or a PNG, JPEG,
    /// PBM, PGM or PPM image with its scale, such as `hall.png@px-per-m=20,offset=-3,-2`
    #[arg(long, value_name = "FILE", conflicts_with = "measure")]
    pub(super) floor_plan: Option<String>,
    /// Render method, from `guideway methods`; `auto` selects `gpu` with graphics hardware, else
    /// `cpu`
    #[arg(
        long,
        value_name = "NAME[+OPTION]",
        default_value = AUTO,
        value_parser = values::MethodSpec
    )]
    pub(super) method: String,
    /// Print to standard error when each file is read, shown, editable and checked
    #[arg(long, conflicts_with = "measure")]
    pub(super) timings: bool,
    /// Measure frame times without a window: open one file, pan, zoom and edit it
    #[arg(long)]
    pub(super) measure: bool,
}

impl Args {
    /// Rejects what no window can show, before one opens: the words of the desktop would hide it.
    pub(super) fn check(&self, out: &Output) -> Result<(), UserError> {
        if self.measure && self.files.len() != 1 {
            return Err(usage_error(
                "--measure takes exactly one file",
                "Name one, such as `guideway view site.arrow --measure`",
            ));
        }
        if out.is_json() && !self.measure {
            return Err(usage_error(
                "`view` has no JSON output",
                "Use `info --json`, `check --json` or `view --measure --json`",
            ));
        }
        match self.files.iter().find(|file| !file.exists()) {
            None => Ok(()),
            Some(file) => Err(UserError::new(
                "not-found",
                format!("{}: the file does not exist", shown_path(file)),
                "Check the spelling and the folder",
            )),
        }
    }
}
