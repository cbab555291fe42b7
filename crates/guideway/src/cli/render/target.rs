//! Output of `render`: a file, or PNG on standard output.

use std::io::{self, IsTerminal, Write};
use std::path::Path;

use guideway::compose::{ComposeError, Picture, Rendered};
use guideway::formats::Progress;
use guideway::layout::UserError;
use guideway::scene::Method;
use guideway::{SaveError, write_png_by};

use crate::cli::error::usage_error;
use crate::cli::output::Output;

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
        if path != Path::new("-") {
            return Ok(Self::File(path));
        }
        if out.is_json() {
            return Err(usage_error(
                "standard output cannot hold both the picture and the JSON report",
                "Write the picture to a file, such as `-o site.png --json`",
            ));
        }
        if io::stdout().is_terminal() {
            return Err(usage_error(
                "refusing to write PNG data to a terminal",
                "Redirect it, such as `guideway render site.lif.json -o - | feh -`, or write to a \
                 file",
            ));
        }
        Ok(Self::StandardOutput)
    }

    /// Returns `true` if the output is an SVG file.
    pub(super) fn is_vector(&self) -> bool {
        match self {
            Self::StandardOutput => false,
            Self::File(path) => {
                let extension = path.extension().unwrap_or_default();
                extension.eq_ignore_ascii_case("svg")
            }
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
                let fail = |problem| {
                    ComposeError::from(SaveError {
                        path: "-".into(),
                        problem,
                    })
                };
                let stdout = IgnoreBrokenPipe(io::stdout().lock());
                write_png_by(stdout, picture.viewport.size, fail, |sink| {
                    picture.render(method, progress, sink)
                })
            }
        }
    }
}

/// Standard output. A closed pipe is not an error: the reader has seen enough.
struct IgnoreBrokenPipe(io::StdoutLock<'static>);

impl Write for IgnoreBrokenPipe {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        ignore_broken_pipe(self.0.write(bytes), bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        ignore_broken_pipe(self.0.flush(), ())
    }
}

fn ignore_broken_pipe<T>(outcome: io::Result<T>, success: T) -> io::Result<T> {
    match outcome {
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(success),
        outcome => outcome,
    }
}
