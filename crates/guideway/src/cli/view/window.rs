//! The part of the command that the program of the window shares: arguments and errors, limits,
//! files and reports.

use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Parser;
use guideway::AUTO;
use guideway::compose::FloorPlan;
use guideway::layout::{Layout, UserError};
use serde_json::Value;

use super::Args;
use crate::cli::error::{Exit, usage_error};
use crate::cli::input::Input;
use crate::cli::output::Output;
use crate::cli::start::{self, GlobalOptions};
use crate::cli::{demo, floor_plan, output, packed, process};

pub use crate::cli::image_name::explain as explain_image;
pub use crate::cli::layout_output::{target_to_save, write_into};
pub use crate::cli::limits::read_options;
pub use crate::cli::text::time as shown_time;

/// The wishes of the user of a window.
#[derive(Clone, Debug, Default)]
pub struct Request {
    /// Layout files that exist.
    pub files: Vec<PathBuf>,
    /// The file below them with its placement, such as `hall.png@px-per-m=20`; `None` without one.
    pub floor_plan: Option<String>,
    /// The render method with its options; `None` for the best on this computer.
    pub method: Option<String>,
    /// True if each stage of a file is printed to standard error with its time.
    pub prints_timings: bool,
}

/// A measurement of the window.
#[derive(Debug)]
pub struct Measured {
    /// The answer to `--json`.
    pub json: Value,
    /// The table for people.
    pub table: String,
}

/// A window.
pub trait Window {
    /// Opens the window and returns when it is closed.
    ///
    /// # Errors
    /// When no window can be opened.
    fn open(&self, request: Request) -> Result<(), UserError>;

    /// Measures frame times with the first file of the request, without a window.
    ///
    /// # Errors
    /// When the file cannot be read, or the method does not run.
    fn measure(&self, request: Request) -> Result<Measured, UserError>;
}

/// Shows layout files in a window and edits them.
#[derive(Debug, Parser)]
#[command(name = "guideway-window", version)]
struct Cli {
    #[command(flatten)]
    args: Args,
    #[command(flatten)]
    options: GlobalOptions,
}

/// Runs the program of the window with the arguments of the process, before it has a thread.
/// Returns its exit code.
pub fn main(window: &dyn Window) -> ExitCode {
    process::prepare();
    match start::parse::<Cli>(std::env::args_os().collect()) {
        Ok(Cli { args, options }) => start::run(&options, |out| run(window, args, out)),
        Err(exit) => exit,
    }
}

fn run(window: &dyn Window, args: Args, out: &Output) -> Result<Exit, UserError> {
    args.check(out)?;
    let request = Request {
        files: args.files,
        floor_plan: args.floor_plan,
        method: Some(args.method).filter(|method| method != AUTO),
        prints_timings: args.timings,
    };
    if !args.measure {
        window.open(request)?;
        return Ok(Exit::Clean);
    }
    let progress = out.progress("measuring frame times");
    let measured = window.measure(request)?;
    drop(progress);
    out.report("view", &measured.json, || measured.table)?;
    Ok(Exit::Clean)
}

/// Reads a floor plan: a file name with an optional placement, such as `hall.png@px-per-m=20`.
///
/// # Errors
/// When the placement has another form, or the file cannot be read.
pub fn read_floor_plan(plan: &str) -> Result<FloorPlan, UserError> {
    let input = Input::parse(OsString::from(plan)).map_err(|problem| {
        usage_error(
            format!("`{plan}` is not a floor plan: {problem}"),
            "Write a file name and its placement, such as `hall.png@px-per-m=20,offset=-3,-2`",
        )
    })?;
    floor_plan::read(&input, None, &Output::new(false, true))
}

/// The layout of the example site.
///
/// # Errors
/// Never, unless the program was built from a damaged file.
pub fn example_site() -> Result<Layout, UserError> {
    demo::read_site(&packed::site()?)
}

/// Saves a file atomically.
///
/// # Errors
/// When the file cannot be written.
pub fn save_file(path: &Path, bytes: &[u8]) -> Result<(), UserError> {
    output::save(path, bytes)
}
