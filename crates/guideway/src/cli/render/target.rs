//! Output of `render`: a file, or PNG on standard output.

use std::path::Path;

use guideway::compose::{ComposeError, Picture, Rendered};
use guideway::formats::Progress;
use guideway::layout::UserError;
use guideway::scene::Method;
use guideway::write_png_by;

use crate::cli::output::Output;
use crate::cli::picture_file::is_svg;
use crate::cli::stdout::{self, Stdout};

/// The output of a picture.
pub(super) enum Target<'a> {
    StandardOutput,
    File(&'a Path),
}

impl<'a> Target<'a> {
    /// The output that `-o` names.
    ///
    /// # Errors
    /// When standard output is a terminal or takes the JSON report.
    pub(super) fn new(path: &'a Path, out: &Output) -> Result<Self, UserError> {
        if !stdout::is_stdout(path) {
            return Ok(Self::File(path));
        }
        stdout::check(out, Some("PNG"))?;
        Ok(Self::StandardOutput)
    }

    /// Returns `true` if the output is an SVG file.
    pub(super) fn is_vector(&self) -> bool {
        match self {
            Self::StandardOutput => false,
            Self::File(path) => is_svg(path),
        }
    }

    /// Renders a picture as PNG.
    pub(super) fn write_png(
        &self,
        picture: &Picture,
        method: &dyn Method,
        progress: &dyn Progress,
    ) -> Result<Rendered, ComposeError> {
        match self {
            Self::File(path) => picture.save_png(method, path, progress),
            Self::StandardOutput => {
                let fail = |problem| ComposeError::from(stdout::fail(problem));
                let mut stdout = Stdout::lock();
                let (size, texts) = (picture.viewport.size, picture.png_texts()?);
                let written = write_png_by(&mut stdout, size, &texts, fail, |sink| {
                    picture.render(method, progress, sink)
                });
                match stdout.take_failure() {
                    Some(failure) => Err(failure.into()),
                    None => written,
                }
            }
        }
    }
}
