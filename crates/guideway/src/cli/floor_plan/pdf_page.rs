//! Draws a page of a PDF as an image, by the program `pdftoppm` of Poppler: a damaged or hostile
//! file can end that process only.

use std::io::{ErrorKind, Read};
use std::path::{Path, absolute};
use std::process::{Child, ChildStdout, Command, Stdio};
use std::sync::mpsc;
use std::thread;
use std::time::Duration;

use guideway::formats::raster::{self, Raster};
use guideway::layout::{UserError, shown_path};

const PROGRAM: &str = "pdftoppm";
/// Pixels per inch of paper. Derived: a page of A0 has 62 million pixels, near the limit of images.
const DPI: u32 = 200;
/// Most time that a page may take.
const MAX_TIME: Duration = Duration::from_secs(60);
/// Most bytes of the image of a page.
const MAX_BYTES: u64 = 1 << 28;

/// Draws a page, counted from 1.
///
/// # Errors
/// When Poppler is missing or cannot draw the page, or the page exceeds a limit: a minute, the
/// pixels of an image.
pub(super) fn read(path: &Path, page: u32) -> Result<Raster, UserError> {
    let bytes = draw(Command::new(PROGRAM), path, page, MAX_TIME)?;
    let name = format!("page {page} of {}", shown_path(path));
    Ok(raster::read_bytes(bytes, &name)?)
}

fn draw(
    mut program: Command,
    path: &Path,
    page: u32,
    max_time: Duration,
) -> Result<Vec<u8>, UserError> {
    let name = shown_path(path);
    // A name must not look like an option.
    let file = absolute(path).unwrap_or_else(|_| path.to_path_buf());
    let (page_text, dpi) = (page.to_string(), DPI.to_string());
    program
        .args(["-png", "-singlefile", "-cropbox", "-r", &dpi])
        .args(["-f", &page_text, "-l", &page_text])
        .arg(file)
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::null());
    let mut child = program.spawn().map_err(|error| match error.kind() {
        ErrorKind::NotFound => problem(
            format!("{name}: pages of PDF are drawn by `{PROGRAM}`, which is not installed"),
            "Install Poppler (Debian: apt install poppler-utils), or save the page as PNG or SVG",
        ),
        _ => problem(
            format!("{name}: `{PROGRAM}` cannot be started: {error}"),
            "Save the page as PNG or SVG",
        ),
    })?;
    let bytes = child
        .stdout
        .take()
        .and_then(|out| read_within(out, max_time));
    let Some(bytes) = bytes else {
        end(&mut child);
        let seconds = max_time.as_secs();
        return Err(problem(
            format!(
                "{name}: page {page} takes more than {seconds} seconds or {MAX_BYTES} bytes to draw"
            ),
            "Save the page as PNG or SVG",
        ));
    };
    match child.wait() {
        Ok(status) if status.success() && !bytes.is_empty() => Ok(bytes),
        _ => Err(problem(
            format!(
                "{name}: `{PROGRAM}` cannot draw page {page}: the file has fewer pages, is \
                 damaged, or needs a password"
            ),
            "Choose another page, such as `plan.pdf@page=1,px-per-m=40`, or save it as PNG",
        )),
    }
}

/// Reads all output; `None` if it takes too long or is too long.
fn read_within(out: ChildStdout, max_time: Duration) -> Option<Vec<u8>> {
    let (sender, receiver) = mpsc::channel();
    thread::spawn(move || {
        let mut bytes = Vec::new();
        let read = out.take(MAX_BYTES + 1).read_to_end(&mut bytes);
        // Nobody waits after the time is over.
        let _ = sender.send(read.map(|_| bytes));
    });
    let bytes = receiver.recv_timeout(max_time).ok()?.ok()?;
    (bytes.len() as u64 <= MAX_BYTES).then_some(bytes)
}

fn end(child: &mut Child) {
    // It may have ended already.
    let _ = child.kill();
    let _ = child.wait();
}

fn problem(message: String, remedy: &str) -> UserError {
    UserError::new("floor-plan", message, remedy)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fails(program: Command, max_time: Duration) -> String {
        let outcome = draw(program, Path::new("a.pdf"), 7, max_time);
        outcome.unwrap_err().to_string()
    }

    #[test]
    fn missing_program_is_named_with_its_package() {
        let error = fails(Command::new("no-such-program-of-guideway"), MAX_TIME);
        assert!(error.contains("poppler-utils"), "{error}");
    }

    #[cfg(unix)]
    #[test]
    fn failing_and_endless_programs_are_errors() {
        let shell = |script: &str| {
            let mut shell = Command::new("sh");
            shell.args(["-c", script]);
            shell
        };
        let error = fails(shell("exit 1"), MAX_TIME);
        assert!(error.contains("cannot draw page 7"), "{error}");
        let error = fails(shell("exec sleep 60"), Duration::ZERO);
        assert!(error.contains("takes more than 0 seconds"), "{error}");
    }
}
