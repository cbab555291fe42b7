//! Output of a picture: a file or standard output, as PNG, SVG or PDF.

use std::path::Path;

use guideway::compose::{ComposeError, Picture, Rendered, VectorFormat};
use guideway::formats::Progress;
use guideway::layout::UserError;
use guideway::scene::Method;
use guideway::write_png_by;

use super::input::check_output;
use super::output::{Output, is_stdout};
use super::picture_file::PictureFormat;
use super::stdout::{self, Stdout};

/// The output of a picture.
#[derive(Clone, Copy)]
pub(crate) struct PictureOutput<'a> {
    /// The file; `None` for standard output.
    pub(crate) file: Option<&'a Path>,
    pub(crate) format: PictureFormat,
}

impl<'a> PictureOutput<'a> {
    /// The output that a path and `--to` name. Checked before any long work.
    ///
    /// # Errors
    /// When standard output is a terminal or takes the JSON report, the extension of the file is
    /// not that of a picture, or the file cannot be written or is an input.
    pub(crate) fn new<'i>(
        path: &'a Path,
        to: Option<PictureFormat>,
        inputs: impl IntoIterator<Item = &'i Path>,
        out: &Output,
    ) -> Result<Self, UserError> {
        let format = PictureFormat::of_output(path, to)?;
        let file = (!is_stdout(path)).then_some(path);
        match file {
            Some(file) => check_output(inputs, file)?,
            None => {
                let binary = match format {
                    PictureFormat::Png => Some("PNG"),
                    PictureFormat::Pdf => Some("PDF"),
                    PictureFormat::Svg => None,
                };
                stdout::check(out, binary)?;
            }
        }
        Ok(Self { file, format })
    }

    /// Renders a picture; its pixels are those of the `cpu` method.
    ///
    /// # Errors
    /// When the picture cannot be rendered, or the output fails.
    pub(crate) fn write(
        &self,
        picture: &Picture,
        progress: &dyn Progress,
    ) -> Result<Rendered, UserError> {
        match self.format.vector() {
            Some(format) => Ok(self.write_vector(picture, format)?),
            None => Ok(self.write_png(picture, &*guideway::method("cpu")?, progress)?),
        }
    }

    /// Renders a picture as PNG.
    pub(crate) fn write_png(
        &self,
        picture: &Picture,
        method: &dyn Method,
        progress: &dyn Progress,
    ) -> Result<Rendered, ComposeError> {
        if let Some(path) = self.file {
            return picture.save_png(method, path, progress);
        }
        let (size, header) = (picture.viewport.size, picture.png_header()?);
        to_stdout(|stdout| {
            write_png_by(stdout, size, &header, failed, |sink| {
                picture.render(method, progress, sink)
            })
        })
    }

    /// Writes a picture as curves.
    pub(crate) fn write_vector(
        &self,
        picture: &Picture,
        format: VectorFormat,
    ) -> Result<Rendered, ComposeError> {
        match self.file {
            Some(path) => picture.save_vector(format, path),
            None => to_stdout(|stdout| picture.write_vector(format, stdout, failed)),
        }
    }
}

fn failed(problem: std::io::Error) -> ComposeError {
    stdout::fail(problem).into()
}

/// Writes to standard output, whose own error goes before that of an encoder.
fn to_stdout(
    write: impl FnOnce(&mut Stdout) -> Result<Rendered, ComposeError>,
) -> Result<Rendered, ComposeError> {
    let mut stdout = Stdout::lock();
    let written = write(&mut stdout);
    match stdout.take_failure() {
        Some(failure) => Err(failure.into()),
        None => written,
    }
}
