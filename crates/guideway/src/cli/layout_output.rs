//! Output of a layout: a file or standard output, and its format.

use std::io::Write;
use std::path::Path;

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use guideway::arrow::{Precision, WriteOptions, write_layout};
use guideway::formats::{Losses, Target, WriteError, WriteProblem};
use guideway::layout::{Layout, UserError, shown_path};
use guideway::replace_file;
use serde_json::{Value, json};

use super::input::check_output;
use super::output::{Output, is_stdout};
use super::progress_bar::ProgressBar;
use super::stdout::{self, Stdout};
use super::{limits, text};

/// A file or standard output, and the format that `--to` names.
#[derive(Clone, Copy)]
pub(crate) struct LayoutOutput<'a> {
    path: &'a Path,
    to: Option<Target>,
}

/// A layout that was written.
pub(crate) struct Written {
    pub(crate) target: Target,
    pub(crate) losses: Losses,
    pub(crate) bytes: u64,
    pub(crate) ms: f64,
}

/// Parses the identifier of a target, with its extensions in the help.
pub(crate) fn target_parser() -> impl TypedValueParser<Value = Target> {
    let values = Target::ALL.iter().map(|target| {
        let extensions = target.extensions().join(", ");
        let help = match extensions.as_str() {
            "" => target.description().to_owned(),
            extensions => format!("{}: {extensions}", target.description()),
        };
        PossibleValue::new(target.id()).help(help)
    });
    PossibleValuesParser::new(values)
        .try_map(|id| Target::from_id(&id).ok_or("the list of formats has this identifier"))
}

impl<'a> LayoutOutput<'a> {
    /// The output that a path and `--to` name. Checked before any long work.
    ///
    /// # Errors
    /// When the extension is that of no format, when the file cannot be written or is an input, or
    /// when standard output is a terminal that would take binary data or holds the JSON report.
    pub(crate) fn new<'i>(
        path: &'a Path,
        to: Option<Target>,
        inputs: impl IntoIterator<Item = &'i Path>,
        out: &Output,
    ) -> Result<Self, UserError> {
        let is_of_source = is_stdout(path) || Target::depends_on_source(path);
        if to.is_none() && !is_of_source && promised(path).is_none() {
            return Err(no_target(path));
        }
        match is_stdout(path) {
            true => stdout::check(out, to.and_then(binary))?,
            false => check_output(inputs, path)?,
        }
        Ok(Self { path, to })
    }

    /// The format of a layout there: that of `--to`, else that of the extension, else that of the
    /// file that was read.
    ///
    /// # Errors
    /// When none of them can be written.
    pub(crate) fn target(&self, layout: &Layout) -> Result<Target, UserError> {
        match self.to {
            Some(target) => Ok(target),
            None if is_stdout(self.path) => {
                Target::of_source(layout).ok_or_else(|| no_target(self.path))
            }
            None => target_to_save(layout, self.path),
        }
    }

    /// Writes a layout. Says if the extension promises another format.
    pub(crate) fn write(
        &self,
        layout: &Layout,
        target: Target,
        out: &Output,
    ) -> Result<Written, UserError> {
        let progress = out.progress(format!("writing {}", shown_path(self.path)));
        let (losses, bytes) = match is_stdout(self.path) {
            true => {
                stdout::check(out, binary(target))?;
                write_stdout(target, layout, &progress)?
            }
            false => write_file(target, layout, self.path, &progress)?,
        };
        let ms = progress.finish();
        if let Some(note) = contradiction(target, self.path) {
            out.note(&note);
        }
        Ok(Written {
            target,
            losses,
            bytes,
            ms,
        })
    }
}

impl Written {
    /// The losses of the format, for a report.
    pub(crate) fn losses_json(&self) -> Value {
        let losses = self.losses.iter().map(
            |loss| json!({ "place": loss.what, "count": loss.count, "message": loss.to_string() }),
        );
        losses.collect()
    }

    /// The losses of the format, a line each.
    pub(crate) fn losses_text(&self) -> String {
        if self.losses.is_empty() {
            return String::new();
        }
        let name = self.target.name();
        let mut words = format!("{name} cannot hold, or holds in another form:\n");
        for loss in self.losses.iter() {
            let what = text::single_line(&loss.what, 80);
            let detail = text::single_line(&loss.noun(), 200);
            words += &format!("  {what}: {} {detail}\n", text::count(loss.count));
        }
        words
    }
}

/// The kind of data, if people cannot read it.
fn binary(target: Target) -> Option<&'static str> {
    (target == Target::Arrow).then_some("Arrow")
}

/// The format that the extension of a file promises.
fn promised(output: &Path) -> Option<Target> {
    let name = output.file_name().unwrap_or_default();
    Target::of_file_name(&name.to_string_lossy())
}

/// Says that `--to` selects another format than the extension promises.
fn contradiction(target: Target, output: &Path) -> Option<String> {
    let promised = promised(output).filter(|promised| {
        // Versions of one format share the extension of one of them, and a route graph is GeoJSON.
        let family = |target: Target| match target {
            Target::Nav2 => Some("GeoJSON"),
            _ => target.name().split(' ').next(),
        };
        family(*promised) != family(target)
    })?;
    Some(format!(
        "note: {} holds {}, as `--to` says, though its extension is that of {}",
        shown_path(output),
        target.name(),
        promised.name()
    ))
}

/// The format to save a layout in: see [`Target::for_file`].
///
/// # Errors
/// When nothing tells the format of `output`.
pub fn target_to_save(layout: &Layout, output: &Path) -> Result<Target, UserError> {
    Target::for_file(layout, output).ok_or_else(|| no_target(output))
}

/// Nothing tells the format of an output.
fn no_target(output: &Path) -> UserError {
    if is_stdout(output) {
        return UserError::new(
            "target-format",
            "standard output has no extension that says its format, and Guideway does not write \
             the format of the input",
            "Name a format, such as `--to lif`",
        );
    }
    let error = UserError::from(guideway::SaveAsError::extension(output));
    let remedy = "Rename the output or name its format, such as `--to lif2`; `guideway render` \
                  writes pictures";
    UserError {
        remedy: remedy.to_owned(),
        ..error
    }
}

/// Writes the file atomically. Returns the losses of the format and the size of the file.
fn write_file(
    target: Target,
    layout: &Layout,
    output: &Path,
    progress: &ProgressBar,
) -> Result<(Losses, u64), UserError> {
    Ok(replace_file(output, |file| {
        file.set_limit(limits::limits().output_bytes);
        let written = target.write_watched(layout, &mut progress.counted(&mut *file), progress);
        let losses = written.map_err(|problem| write_error(output, problem))?;
        Ok::<_, WriteError>((losses, file.bytes()))
    })?)
}

/// Writes to standard output.
fn write_stdout(
    target: Target,
    layout: &Layout,
    progress: &ProgressBar,
) -> Result<(Losses, u64), UserError> {
    let mut out = Stdout::lock();
    let losses = target.write_watched(layout, &mut progress.counted(&mut out), progress);
    let losses = losses.and_then(|losses| Ok(out.flush().map(|()| losses)?));
    let losses = losses.map_err(|problem| write_error(Path::new("-"), problem))?;
    Ok((losses, out.bytes()))
}

fn write_error(output: &Path, problem: WriteProblem) -> WriteError {
    WriteError {
        path: output.to_owned(),
        problem,
    }
}

/// Writes the layout into a new file for `output`, within the limits of this run. Returns the
/// losses of the format.
///
/// # Errors
/// When the format cannot hold the layout, or the file cannot be written.
pub fn write_into(
    file: &mut guideway::NewFile,
    target: Target,
    layout: &Layout,
    output: &Path,
) -> Result<Losses, WriteError> {
    file.set_limit(limits::limits().output_bytes);
    let written = target.write(layout, file);
    written.map_err(|problem| write_error(output, problem))
}

/// A layout as Arrow with all digits of its curves, so that a page draws the same pixels. Errors
/// name `path`.
pub(crate) fn exact_arrow(layout: &Layout, path: &Path) -> Result<Vec<u8>, UserError> {
    let options = WriteOptions {
        precision: Some(Precision::exact(layout)),
    };
    let mut bytes = Vec::new();
    let written = write_layout(layout, &mut bytes, &options);
    written.map_err(|problem| WriteError {
        path: path.to_owned(),
        problem,
    })?;
    Ok(bytes)
}
