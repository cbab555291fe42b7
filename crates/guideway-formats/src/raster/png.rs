//! Reads PNG files of any color type and depth.

use std::io::{Cursor, ErrorKind};

use guideway_layout::Place;
use png::{ColorType, Decoder, DecodingError, Limits, Transformations};

use super::image::{MAX_PIXELS, Raster, check_pixels};
use crate::Problem;

/// First bytes of a PNG file.
const MAGIC: &[u8] = b"\x89PNG";

/// Whether bytes begin as PNG.
pub(super) fn is_png(bytes: &[u8]) -> bool {
    bytes.starts_with(MAGIC)
}

/// Reads a file for which [`is_png`] holds.
///
/// # Errors
/// When the file is damaged or its size exceeds the limit.
pub(super) fn read(bytes: Vec<u8>) -> Result<Raster, Problem> {
    let raster = decode(&bytes)?;
    Ok(Raster {
        png: Some(bytes),
        ..raster
    })
}

fn decode(bytes: &[u8]) -> Result<Raster, Problem> {
    let fail = |error| problem(&error, bytes.len());
    let limits = Limits {
        bytes: 4 * MAX_PIXELS as usize,
    };
    let mut decoder = Decoder::new_with_limits(Cursor::new(bytes), limits);
    decoder.set_transformations(Transformations::normalize_to_color8() | Transformations::ALPHA);
    let mut reader = decoder.read_info().map_err(fail)?;
    let info = reader.info();
    let (width, height) = (info.width, info.height);
    let has_alpha = info.trns.is_some()
        || matches!(info.color_type, ColorType::GrayscaleAlpha | ColorType::Rgba);
    let count = check_pixels(width.into(), height.into())?;
    let mut samples = vec![0; reader.output_buffer_size().unwrap_or(4 * count)];
    let info = reader.next_frame(&mut samples).map_err(fail)?;
    let pixel = |p: &[u8]| match *p {
        [gray, alpha] => [gray, gray, gray, alpha],
        [r, g, b, a] => [r, g, b, a],
        _ => [0; 4],
    };
    let pixels = samples[..info.buffer_size()].chunks_exact(info.color_type.samples());
    Ok(Raster {
        width: width as usize,
        height: height as usize,
        pixels: pixels.map(pixel).collect(),
        has_alpha,
        png: None,
    })
}

fn problem(error: &DecodingError, size: usize) -> Problem {
    match error {
        DecodingError::IoError(cause) if cause.kind() == ErrorKind::UnexpectedEof => {
            Problem::Truncated {
                at: size as u64,
                detail: "rows of pixels are missing".into(),
            }
        }
        _ => Problem::Damaged {
            place: Place::element("PNG data"),
            detail: error.to_string(),
        },
    }
}
