//! Output of `render`: a file or standard output, as PNG, SVG or PDF.

use std::path::Path;

use guideway::compose::{ComposeError, Picture, Rendered, VectorFormat};
use guideway::formats::Progress;
use guideway::layout::UserError;
use guideway::scene::Method;
use guideway::write_png_by;

use crate::cli::output::Output;
use crate::cli::picture_file::PictureFormat;
use crate::cli::stdout::{self, Stdout};

/// The output of a picture.
pub(super) struct Target<'a> {
    /// The file; `None` for standard output.
    pub(super) file: Option<&'a Path>,
    pub(super) format: PictureFormat,
}

impl<'a> Target<'a> {
    /// The output that `-o` and `--to` name.
    ///
    /// # Errors
    /// When standard output is a terminal or takes the JSON report, or the extension of the file is
    /// not that of a picture.
    pub(super) fn new(
        path: &'a Path,
        to: Option<PictureFormat>,
        out: &Output,
    ) -> Result<Self, UserError> {
        let format = PictureFormat::of_output(path, to)?;
        let file = (!stdout::is_stdout(path)).then_some(path);
        if file.is_none() {
            let binary = match format {
                PictureFormat::Png => Some("PNG"),
                PictureFormat::Pdf => Some("PDF"),
                PictureFormat::Svg => None,
            };
            stdout::check(out, binary)?;
        }
        Ok(Self { file, format })
    }

    /// Renders a picture as PNG.
    pub(super) fn write_png(
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
    pub(super) fn write_vector(
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
