//! Runs `check`: checks each file, compares with the baseline, prints the report.

use std::path::Path;

use guideway::layout::{Diagnostics, Layout, UserError, check_across};

use super::args::{Args, Format};
use super::baseline::{self, Baseline};
use super::config::Configs;
use super::findings::{CheckedFile, exit};
use super::one_file::{Checked, apply, check_file};
use super::report::{Times, report};
use super::{picture, sarif};
use crate::cli::error::{Exit, usage_error};
use crate::cli::input;
use crate::cli::output::{Output, print, save};
use crate::cli::picture_output::PictureOutput;
use crate::cli::progress_bar::plan;

pub(crate) fn run(args: &Args, out: &Output) -> Result<Exit, UserError> {
    if out.is_json() && args.format == Format::Sarif {
        return Err(usage_error(
            "--json and --format sarif select different reports",
            "Omit --json",
        ));
    }
    args.inputs
        .iter()
        .try_for_each(|input| input.check_keys())?;
    let inputs = || args.inputs.iter().map(|input| input.path.as_path());
    let written = args.write_baseline.as_deref();
    for file in args.report_file().into_iter().chain(written) {
        input::check_output(inputs(), file)?;
    }
    let baseline = args.baseline.as_deref().map(Baseline::read).transpose()?;
    input::check_stdin(&args.inputs)?;
    if args.picture.is_some() && args.inputs.len() > 1 {
        return Err(usage_error(
            "--picture draws the findings of one file",
            "Check one file, such as `guideway check site.lif.json --picture site.png`",
        ));
    }
    // A report in a file leaves standard output to the picture.
    let is_for_programs = out.is_json() || args.format != Format::Table;
    let form = Output::new(is_for_programs && args.report_file().is_none(), false);
    let picture = args.picture.as_deref();
    let picture = picture.map(|path| PictureOutput::new(path, None, inputs(), &form));
    let picture = picture.transpose()?;
    let (mut files, layouts, times) = checked(args, out)?;
    if let ([CheckedFile { unread, .. }], false) = (&mut files[..], args.format == Format::Sarif)
        && let Some(error) = unread.take()
    {
        return Err(error);
    }
    if let Some(path) = &args.write_baseline {
        write_baseline(path, &mut files)?;
    }
    if let Some(baseline) = &baseline {
        for file in files.iter_mut().filter(|file| file.unread.is_none()) {
            (file.known, file.gone) = baseline.remove_known(&file.path, &mut file.found);
        }
    }
    if let (Some(picture), [file], Some(layout)) =
        (&picture, &files[..], layouts.into_iter().next())
    {
        let name = file.path.file_name().unwrap_or_default();
        picture::write(layout, &file.found, &name.to_string_lossy(), picture, out)?;
    }
    let exit = exit(&files);
    match args.format {
        Format::Sarif => {
            let bytes = sarif::bytes(&files, exit)?;
            match args.report_file() {
                Some(file) => save(file, &bytes)?,
                None => print(&bytes)?,
            }
        }
        Format::Json => report(args, &Output::new(true, false), &files, &times)?,
        Format::Table => {
            let out = out.beside(args.picture.as_deref());
            report(args, &out, &files, &times)?;
        }
    }
    Ok(exit)
}

/// Checks each file by itself, and, as one layout, against the files before it. Returns the layouts
/// that are needed further.
fn checked(args: &Args, out: &Output) -> Result<(Vec<CheckedFile>, Vec<Layout>, Times), UserError> {
    let clearance = args.clearance.check(out)?;
    let mut configs = Configs::new(args.config.as_deref());
    let mut times = Times::default();
    let (mut files, mut layouts) = (Vec::with_capacity(args.inputs.len()), Vec::new());
    // Reading and checking each file.
    let steps = [6.0, 4.0].repeat(args.inputs.len());
    plan(1, &steps);
    for input in &args.inputs {
        let Checked {
            file,
            layout,
            read_ms,
            check_ms,
        } = check_file(args, input, &mut configs, clearance.as_ref(), out)?;
        times.read_ms += read_ms;
        times.check_ms += check_ms;
        files.push(file);
        layouts.extend(layout.filter(|_| args.together || args.picture.is_some()));
    }
    if args.together {
        let progress = out.progress("comparing the files");
        let across = check_across(&layouts.iter().collect::<Vec<_>>());
        let read = files.iter_mut().filter(|file| file.unread.is_none());
        for (file, across) in read.zip(across) {
            file.found.append(across);
        }
        times.check_ms += progress.finish();
    }
    for file in &mut files {
        apply(&file.rules, &mut file.found);
    }
    Ok((files, layouts, times))
}

/// Writes a baseline of the findings, which then are known.
fn write_baseline(path: &Path, files: &mut [CheckedFile]) -> Result<(), UserError> {
    let mut all = Vec::new();
    for file in files.iter_mut().filter(|file| file.unread.is_none()) {
        all.extend(baseline::entries(path, &file.path, &file.found)?);
        file.known = file.found.iter().count() as u64;
        file.found = Diagnostics::default();
    }
    baseline::write(path, all)
}
