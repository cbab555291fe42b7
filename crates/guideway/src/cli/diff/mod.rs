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
use super::picture_output::PictureOutput;
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
    /// PNG, SVG or PDF picture to write: removed paths in red, new ones in green, changed ones in
    /// blue. `-` is standard output
    #[arg(long, short, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Format of the picture where the output has no extension, such as `-o - --to svg`
    #[arg(long, value_name = "FORMAT")]
    to: Option<PictureFormat>,
    /// Largest distance of curves and positions that count as equal
    #[arg(
        long,
        value_name = "METERS",
        default_value = "0.00001",
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
    let output = args.output.as_deref();
    let picture = output.map(|path| PictureOutput::new(path, args.to, files, out));
    let picture = picture.transpose()?;
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
    if let Some(picture) = &picture {
        picture::write([&old, &new], &found, picture, out)?;
    }
    let report = Report::new(files, &found, [read_ms, compare_ms]);
    let out = out.beside(output);
    out.report("diff", &report.json(&found), || match args.form {
        Form::Text => report.text(&found, args.max),
        Form::Markdown => report.markdown(&found, args.max),
    })?;
    Ok(match args.exit_code && !found.is_empty() {
        true => Exit::Found,
        false => Exit::Clean,
    })
}
