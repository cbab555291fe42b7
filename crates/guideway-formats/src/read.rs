//! Entry points of reading: opens a file or takes bytes, detects the format and calls its reader.

use std::fs::{File, Metadata};
use std::io::{self, Read};
use std::path::Path;

use guideway_layout::{Layout, Limits, Place, try_reserve};

use crate::encoding::to_utf8;
#[cfg(unix)]
use crate::input::ReadAheadFile;
use crate::input::{Input, MAX_KEPT_BYTES, Parts};
use crate::other_format::other_format;
use crate::ros_map::is_ros_map;
use crate::sniff::has_lif_key;
use crate::source::{ReadOptions, STEPS_PER_BYTE, Source};
use crate::unpack::unpack;
use crate::{Format, Problem, ReadError, sniff};

/// Bytes of the head of a file that tell its format.
const HEAD_BYTES: u64 = 64 << 10;

/// Reads a layout file. The content decides the format, not the name of the file.
///
/// # Errors
/// When the file cannot be read, has an unknown format, exceeds a limit, or is damaged as a whole.
/// Faults of single elements are diagnostics in [`Layout::diagnostics`].
pub fn read_file(path: &Path, options: &ReadOptions<'_>) -> Result<Layout, ReadError> {
    let name = path.to_string_lossy().into_owned();
    let fail = |problem| ReadError::new(&name, problem);
    let mut file = open(path).map_err(fail)?;
    let size = file.metadata().map_err(io_problem).map_err(fail)?.len();
    check_size(size, &options.limits).map_err(fail)?;
    #[cfg(unix)]
    let head = head(&mut file).map_err(io_problem).map_err(fail)?;
    #[cfg(unix)]
    if let Some(format) = format_in_parts(&head, size) {
        let name = &name;
        let file = ReadAheadFile::new(file, size, path);
        let source = Source { name, options };
        source.check_format(format)?;
        return read_input(source, format, &Input::File(&file));
    }
    let bytes = read_whole(&mut file, options).map_err(fail)?;
    read_bytes(&name, &bytes, options)
}

/// Reads a layout from a stream to its end, such as standard input; error texts call the source
/// `name`.
///
/// # Errors
/// See [`read_file`].
pub fn read_stream(
    name: &str,
    stream: &mut dyn Read,
    options: &ReadOptions<'_>,
) -> Result<Layout, ReadError> {
    let bytes = read_chunks(stream, Vec::new(), 0, options);
    read_bytes(name, &bytes.map_err(|p| ReadError::new(name, p))?, options)
}

/// Reads a layout from parts; error texts call the source `name`. Of a format whose reader takes
/// parts, the bytes are never in memory as a whole.
///
/// # Errors
/// See [`read_file`].
pub fn read_parts(
    name: &str,
    parts: &dyn Parts,
    options: &ReadOptions<'_>,
) -> Result<Layout, ReadError> {
    let source = Source { name, options };
    let size = parts.byte_count();
    check_size(size as u64, &options.limits).map_err(|p| source.fail(p))?;
    let input = Input::Parts(parts);
    let mut bytes = Vec::new();
    let head = input.part(0..size.min(HEAD_BYTES as usize), &mut bytes);
    let head = head.map_err(|p| source.fail(p))?;
    if let Some(format) = format_in_parts(head, size as u64) {
        source.check_format(format)?;
        return read_input(source, format, &input);
    }
    let whole = input.part(0..size, &mut bytes);
    read_bytes(name, whole.map_err(|p| source.fail(p))?, options)
}

/// Reads a layout from bytes; error texts call the source `name`.
///
/// # Errors
/// See [`read_file`].
pub fn read_bytes(
    name: &str,
    bytes: &[u8],
    options: &ReadOptions<'_>,
) -> Result<Layout, ReadError> {
    let source = Source { name, options };
    source.check_cancelled()?;
    if bytes.is_empty() {
        return Err(source.fail(Problem::Empty));
    }
    check_size(bytes.len() as u64, &options.limits).map_err(|p| source.fail(p))?;
    let unpacked = unpack(bytes, &options.limits).map_err(|p| source.fail(p))?;
    let text = to_utf8(&unpacked).map_err(|p| source.fail(p))?;
    let bytes: &[u8] = &text;
    let format = sniff(bytes);
    // Some of them begin as a layout does.
    if let Some(problem) = other_format(bytes) {
        return Err(source.fail(problem));
    }
    format.map_or(Ok(()), |format| source.check_format(format))?;
    match format {
        Some(format @ (Format::Arrow | Format::Lif)) => {
            read_input(source, format, &Input::Bytes(bytes))
        }
        #[cfg(feature = "opentcs")]
        Some(Format::OpenTcs) => crate::opentcs::read(source, bytes),
        #[cfg(feature = "dxf")]
        Some(Format::Dxf) => crate::dxf::read(source, bytes),
        #[cfg(feature = "svg")]
        Some(Format::Svg) => crate::svg::read(source, bytes),
        #[cfg(feature = "rmf")]
        Some(Format::Rmf) => crate::rmf::read(source, bytes),
        #[cfg(feature = "opendrive")]
        Some(Format::OpenDrive) => crate::opendrive::read(source, bytes),
        #[cfg(feature = "lanelet2")]
        Some(Format::Lanelet2) => crate::lanelet2::read(source, bytes),
        #[cfg(feature = "geojson")]
        Some(Format::GeoJson) => crate::geojson::read(source, bytes),
        #[cfg(feature = "vda5050")]
        Some(Format::Vda5050) => crate::vda5050::read(source, bytes),
        #[cfg(not(feature = "all"))]
        Some(format) => Err(source.fail(not_built(format))),
        None if is_ros_map(bytes) => Err(source.fail(Problem::FloorPlan)),
        None => Err(source.fail(unknown_format(bytes))),
    }
}

/// Reads a layout of a format whose reader takes parts of its input.
fn read_input(source: Source<'_>, format: Format, input: &Input<'_>) -> Result<Layout, ReadError> {
    match format {
        #[cfg(feature = "arrow")]
        Format::Arrow => crate::arrow::read(source, input),
        #[cfg(feature = "lif")]
        Format::Lif => crate::lif::read(source, input),
        other => Err(source.fail(not_built(other))),
    }
}

fn not_built(format: Format) -> Problem {
    Problem::Unsupported {
        place: Place::element("the file"),
        what: format!("the format {} in this build", format.name()),
        remedy: format!("Build Guideway with its feature `{}`", format.feature()),
    }
}

/// Returns the format of a file whose reader loads parts of it, so that it is not read as a whole:
/// Arrow, and LIF that is too large to be kept.
fn format_in_parts(head: &[u8], size: u64) -> Option<Format> {
    let is_large = size > MAX_KEPT_BYTES as u64;
    match sniff(head) {
        Some(Format::Arrow) => Some(Format::Arrow),
        Some(Format::Lif) if is_large && has_lif_key(head) => Some(Format::Lif),
        _ => None,
    }
}

#[cfg(unix)]
fn head(file: &mut File) -> io::Result<Vec<u8>> {
    let mut head = Vec::new();
    file.take(HEAD_BYTES).read_to_end(&mut head)?;
    io::Seek::rewind(file)?;
    Ok(head)
}

/// Reads the bytes of a file that is no layout, such as an image.
///
/// # Errors
/// When the file cannot be read, when it is larger than `max_bytes` or than the limit of layouts,
/// or when the caller cancels.
pub(crate) fn read_file_bytes(
    path: &Path,
    options: &ReadOptions<'_>,
    max_bytes: u64,
) -> Result<Vec<u8>, ReadError> {
    let limits = Limits {
        file_bytes: options.limits.file_bytes.min(max_bytes),
        ..options.limits.clone()
    };
    let options = ReadOptions { limits, ..*options };
    let bytes = open(path).and_then(|mut file| read_whole(&mut file, &options));
    bytes.map_err(|problem| ReadError::new(path.to_string_lossy(), problem))
}

fn open(path: &Path) -> Result<File, Problem> {
    // The metadata comes first: opening a pipe would wait for a writer.
    let metadata = std::fs::metadata(path).map_err(io_problem)?;
    if let Some(kind) = non_file_kind(&metadata) {
        return Err(Problem::NotAFile(kind));
    }
    File::open(path).map_err(io_problem)
}

fn io_problem(error: io::Error) -> Problem {
    match error.kind() {
        io::ErrorKind::NotFound => Problem::NotFound,
        _ => Problem::Io(error),
    }
}

/// Returns the kind of anything but a regular file.
fn non_file_kind(metadata: &Metadata) -> Option<&'static str> {
    if metadata.is_file() {
        None
    } else if metadata.is_dir() {
        Some("folder")
    } else {
        Some("pipe, socket or device")
    }
}

fn read_whole(file: &mut File, options: &ReadOptions<'_>) -> Result<Vec<u8>, Problem> {
    let total = file.metadata().map_err(io_problem)?.len();
    check_size(total, &options.limits)?;
    let mut bytes = Vec::new();
    try_reserve(&mut bytes, usize::try_from(total).unwrap_or(usize::MAX))
        .map_err(|_| Problem::Io(io::ErrorKind::OutOfMemory.into()))?;
    read_chunks(file, bytes, total, options)
}

/// Reads a stream to its end. It may be longer than `total`, so each chunk checks the size.
fn read_chunks(
    stream: &mut dyn Read,
    mut bytes: Vec<u8>,
    total: u64,
    options: &ReadOptions<'_>,
) -> Result<Vec<u8>, Problem> {
    const CHUNK: u64 = 8 << 20;
    while (&mut *stream)
        .take(CHUNK)
        .read_to_end(&mut bytes)
        .map_err(io_problem)?
        > 0
    {
        let done = bytes.len() as u64;
        check_size(done, &options.limits)?;
        if let Some(progress) = options.progress {
            progress.advance(done, total.max(done).saturating_mul(STEPS_PER_BYTE));
            if progress.cancelled() {
                return Err(Problem::Cancelled);
            }
        }
    }
    Ok(bytes)
}

fn check_size(actual: u64, limits: &Limits) -> Result<(), Problem> {
    let limit = limits.file_bytes;
    if actual <= limit {
        return Ok(());
    }
    Err(Problem::LimitReached {
        what: "bytes in the file",
        limit,
        actual,
    })
}

fn unknown_format(bytes: &[u8]) -> Problem {
    Problem::UnknownFormat {
        first_bytes: quote_or_hex(&bytes[..bytes.len().min(24)]),
    }
}

/// Formats bytes as quoted text if they are printable ASCII, else as hexadecimal numbers.
pub(crate) fn quote_or_hex(bytes: &[u8]) -> String {
    let plain = |b: &u8| b.is_ascii_graphic() || matches!(b, b' ' | b'\n' | b'\r' | b'\t');
    match std::str::from_utf8(bytes) {
        Ok(text) if bytes.iter().all(plain) => format!("{text:?}"),
        _ => {
            let hex: Vec<String> = bytes.iter().take(16).map(|b| format!("{b:02X}")).collect();
            hex.join(" ")
        }
    }
}
