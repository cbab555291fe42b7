//! Arguments of `view`; opens the window.

use std::path::PathBuf;
use std::sync::Arc;

use guideway::AUTO;
use guideway::layout::{UserError, shown_path};
use guideway_viewer::LaunchOptions;

use super::measure;
use super::services::CliServices;
use crate::cli::error::{Exit, usage_error};
use crate::cli::output::Output;
use crate::cli::values;

#[derive(Debug, clap::Args)]
#[command(
    after_help = "F1 in the window lists all keys. Files can also be dropped onto the window."
)]
pub(crate) struct Args {
    /// Layout files; the content decides the format
    #[arg(value_name = "FILE")]
    files: Vec<PathBuf>,
    /// File to show below the layouts: a layout, a drawing, a `map.yaml` of ROS, or a PNG, JPEG
    /// or PGM image with its scale, such as `hall.png@px-per-m=20,offset=-3,-2`
    #[arg(long, value_name = "FILE", conflicts_with = "measure")]
    floor_plan: Option<String>,
    /// Render method, from `guideway methods`; `auto` selects `gpu` with graphics hardware, else
    /// `cpu`
    #[arg(
        long,
        value_name = "NAME[+OPTION]",
        default_value = AUTO,
        value_parser = values::MethodSpec
    )]
    method: String,
    /// Print to standard error when each file is read, shown, editable and checked
    #[arg(long, conflicts_with = "measure")]
    timings: bool,
    /// Measure frame times without a window: open one file, pan, zoom and edit it
    #[arg(long)]
    measure: bool,
}

pub(crate) fn run(args: &Args, out: &Output) -> Result<Exit, UserError> {
    let method = (args.method != AUTO).then(|| args.method.clone());
    if args.measure {
        return measure::measure(&args.files, method, out);
    }
    if out.is_json() {
        return Err(usage_error(
            "`view` has no JSON output",
            "Use `info --json`, `check --json` or `view --measure --json`",
        ));
    }
    for file in &args.files {
        // Before a window opens: the words of the desktop would hide this.
        if !file.exists() {
            return Err(UserError::new(
                "not-found",
                format!("{}: the file does not exist", shown_path(file)),
                "Check the spelling and the folder",
            ));
        }
    }
    let services = CliServices::for_window(args.timings);
    let launch = LaunchOptions {
        files: args.files.clone(),
        floor_plan: args.floor_plan.clone().unwrap_or_default(),
        method,
    };
    guideway_viewer::run(Arc::new(services), launch)?;
    Ok(Exit::Clean)
}
