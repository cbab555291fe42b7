//! `guideway diff`: lists what changed from one layout to another, as text, JSON, Markdown or a
//! picture.
//!
//! | file | purpose |
//! |---|---|
//! | `report` | text, Markdown and JSON |
//! | `picture` | removed, new and changed paths in colors over the others |

mod picture;
mod report;

use std::path::PathBuf;

use clap::ValueEnum;
use guideway::layout::{CompareOptions, UserError, changes};

use self::report::Report;
use super::error::Exit;
use super::input::{self, Input};
use super::output::Output;
use super::picture_file::PictureFormat;
use super::values;

#[derive(Debug, clap::Args)]
#[command(
    after_help = "Elements are matched by identifier, then by place. As a tool of git:\n  \
    git config difftool.guideway.cmd 'guideway diff \"$LOCAL\" \"$REMOTE\"'\n  \
    git difftool --tool guideway -- site.lif.json"
)]
pub(crate) struct Args {
    /// The old layout
    #[arg(value_name = "OLD", value_parser = Input::parser())]
    old: Input,
    /// The new layout
    #[arg(value_name = "NEW", value_parser = Input::parser())]
    new: Input,
    /// Form of the list; --json prints one object
    #[arg(long, value_enum, default_value_t = Form::Text)]
    form: Form,
    /// Picture to write: removed paths in red, new ones in green, changed ones in blue
    #[arg(long, short, value_name = "PNG|SVG")]
    output: Option<PathBuf>,
    /// Largest distance of curves and positions that count as equal
    #[arg(
        long,
        value_name = "METERS",
        default_value = "0.000001",
        value_parser = values::not_negative
    )]
    tolerance: f64,
    /// Number of elements to list; the counts are of all
    #[arg(long, value_name = "COUNT", default_value_t = 100)]
    max: usize,
    /// Exit with code 1 if the layouts differ
    #[arg(long)]
    exit_code: bool,
}

/// Form of the list of changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Form {
    /// Indented text
    Text,
    /// A table for a review
    Markdown,
}

pub(crate) fn run(args: &Args, out: &Output) -> Result<Exit, UserError> {
    let files = [&args.old, &args.new].map(|input| input.path.as_path());
    if let Some(output) = &args.output {
        input::check_output(files, output)?;
        PictureFormat::of_output(output, None)?;
    }
    let (mut layouts, read_ms) = input::read_each(&[args.old.clone(), args.new.clone()], out)?;
    let new = layouts.pop().unwrap_or_default();
    let old = layouts.pop().unwrap_or_default();
    let progress = out.progress("comparing");
    let options = CompareOptions {
        tolerance_m: args.tolerance,
        ..CompareOptions::default()
    };
    let found = changes(&old, &new, &options);
    let compare_ms = progress.finish();
    if let Some(output) = &args.output {
        picture::write([&old, &new], &found, output, out)?;
    }
    let report = Report::new(files, &found, [read_ms, compare_ms]);
    out.report("diff", &report.json(&found), || match args.form {
        Form::Text => report.text(&found, args.max),
        Form::Markdown => report.markdown(&found, args.max),
    })?;
    Ok(match args.exit_code && !found.is_empty() {
        true => Exit::Found,
        false => Exit::Clean,
    })
}
