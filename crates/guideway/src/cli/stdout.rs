//! Standard output as the target of a file, which `-` names.

use std::io::{self, IsTerminal, Write};

use guideway::SaveError;
use guideway::layout::UserError;

use super::error::usage_error;
use super::output::Output;

/// Checks that standard output can take a file.
///
/// # Errors
/// When it takes the JSON report, or is a terminal that would take `binary` data.
pub(crate) fn check(out: &Output, binary: Option<&str>) -> Result<(), UserError> {
    if out.is_json() {
        return Err(usage_error(
            "standard output cannot hold both the file and the JSON report",
            "Write to a file, such as `-o site.png --json`",
        ));
    }
    match binary {
        Some(data) if io::stdout().is_terminal() => Err(usage_error(
            format!("refusing to write {data} data to a terminal"),
            "Redirect it, such as `guideway render site.lif.json -o - | feh -`, or write to a file",
        )),
        _ => Ok(()),
    }
}

/// An error of standard output.
pub(crate) fn fail(problem: io::Error) -> SaveError {
    SaveError {
        path: "-".into(),
        problem,
    }
}

/// Standard output. A closed pipe is not an error: the reader has seen enough.
pub(crate) struct Stdout {
    stream: io::StdoutLock<'static>,
    bytes: u64,
    /// The first error, as encoders wrap it.
    failure: Option<io::Error>,
}

impl Stdout {
    pub(crate) fn lock() -> Self {
        Self {
            stream: io::stdout().lock(),
            bytes: 0,
            failure: None,
        }
    }

    /// Bytes written so far.
    pub(crate) fn bytes(&self) -> u64 {
        self.bytes
    }
}

impl Stdout {
    /// The first error of the stream.
    pub(crate) fn take_failure(&mut self) -> Option<SaveError> {
        self.failure.take().map(fail)
    }
}

impl Write for Stdout {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = ignore_broken_pipe(self.stream.write(bytes), bytes.len());
        if let Err(error) = &written
            && self.failure.is_none()
        {
            self.failure = error.raw_os_error().map(io::Error::from_raw_os_error);
        }
        self.bytes += *written.as_ref().unwrap_or(&0) as u64;
        written
    }

    fn flush(&mut self) -> io::Result<()> {
        ignore_broken_pipe(self.stream.flush(), ())
    }
}

fn ignore_broken_pipe<T>(outcome: io::Result<T>, success: T) -> io::Result<T> {
    match outcome {
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(success),
        outcome => outcome,
    }
}
