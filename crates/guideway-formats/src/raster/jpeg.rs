//! Reads JPEG files, baseline and progressive, gray or in color.

use guideway_layout::Place;
use zune_jpeg::JpegDecoder;
use zune_jpeg::errors::DecodeErrors;
use zune_jpeg::zune_core::bytestream::ZCursor;
use zune_jpeg::zune_core::colorspace::ColorSpace;
use zune_jpeg::zune_core::options::DecoderOptions;

use super::image::{Raster, check_pixels};
use crate::Problem;

/// First bytes of a JPEG file: the marker of its start, and the begin of the next one.
const MAGIC: &[u8] = b"\xFF\xD8\xFF";
/// Longest side of an image, in pixels: the most that JPEG can tell.
const MAX_SIDE: usize = 65_535;

/// Returns `true` if bytes begin as JPEG.
pub(super) fn is_jpeg(bytes: &[u8]) -> bool {
    bytes.starts_with(MAGIC)
}

/// Reads a file for which [`is_jpeg`] holds.
///
/// # Errors
/// When the file is damaged, its size exceeds the limit, or its colors are those of print.
pub(super) fn read(bytes: &[u8]) -> Result<Raster, Problem> {
    let fail = |error| problem(&error, bytes.len());
    let options = DecoderOptions::default()
        .set_max_width(MAX_SIDE)
        .set_max_height(MAX_SIDE)
        // Rows that are missing are an error, not a gray rest.
        .set_strict_mode(true)
        .jpeg_set_out_colorspace(ColorSpace::RGB);
    let mut decoder = JpegDecoder::new_with_options(ZCursor::new(bytes), options);
    decoder.decode_headers().map_err(fail)?;
    let Some(info) = decoder.info() else {
        return Err(damaged("its size is missing".to_owned()));
    };
    let (width, height) = (usize::from(info.width), usize::from(info.height));
    let count = check_pixels(width as u64, height as u64)?;
    if !has_end(bytes) {
        return Err(problem(&DecodeErrors::ExhaustedData, bytes.len()));
    }
    let samples = decoder.decode().map_err(fail)?;
    if samples.len() != 3 * count {
        return Err(damaged(format!(
            "{} color samples for {count} pixels",
            samples.len()
        )));
    }
    let pixels = samples.chunks_exact(3);
    Ok(Raster {
        width,
        height,
        pixels: pixels.map(|p| [p[0], p[1], p[2], u8::MAX]).collect(),
        has_alpha: false,
        png: None,
    })
}

/// Returns `true` if the last scan has an end: the decoder takes missing last bytes for zeros.
fn has_end(bytes: &[u8]) -> bool {
    let is = |marker: u8| move |two: &[u8]| two == [0xFF, marker];
    let scan = bytes.windows(2).rposition(is(0xDA));
    scan.is_some_and(|at| bytes[at..].windows(2).any(is(0xD9)))
}

fn problem(error: &DecodeErrors, size: usize) -> Problem {
    match error {
        DecodeErrors::ExhaustedData | DecodeErrors::IoErrors(_) => Problem::Truncated {
            at: size as u64,
            detail: "rows of pixels are missing".into(),
        },
        DecodeErrors::Unsupported(_) => Problem::Unsupported {
            place: Place::element("JPEG data"),
            what: format!("{error}"),
            remedy: "Save the image as PNG".into(),
        },
        _ => damaged(error.to_string()),
    }
}

fn damaged(detail: String) -> Problem {
    Problem::Damaged {
        place: Place::element("JPEG data"),
        detail,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 16 x 8 pixels: the left half red, the right half blue.
    const HALVES: &[u8] = include_bytes!("halves.jpg");
    const GRAY: &[u8] = include_bytes!("gray.jpg");

    #[test]
    fn colors_stand_where_they_are_in_the_file() {
        let image = read(HALVES).unwrap();
        assert_eq!((image.width, image.height), (16, 8));
        let is_near = |at: usize, color: [u8; 4]| {
            let pairs = image.pixels[at].into_iter().zip(color);
            pairs.map(|(a, b)| a.abs_diff(b)).max() <= Some(6)
        };
        for row in 0..8 {
            assert!(is_near(16 * row + 1, [255, 0, 0, 255]));
            assert!(is_near(16 * row + 14, [0, 0, 255, 255]));
        }
        let gray = read(GRAY).unwrap();
        let [r, g, b, a] = gray.pixels[0];
        assert!(r == g && g == b && a == 255 && r.abs_diff(128) < 4);
    }

    #[test]
    fn each_damage_is_an_error_and_none_a_panic() {
        for end in 3..HALVES.len() {
            let error = read(&HALVES[..end]).err();
            assert!(error.is_some(), "cut after {end} bytes");
        }
        for at in 2..HALVES.len() {
            let mut bytes = HALVES.to_vec();
            bytes[at] ^= 0xA5;
            // Most are damaged, some show other colors.
            let _ = read(&bytes);
        }
    }

    #[test]
    fn size_beyond_the_limit_is_named_before_memory_is_taken() {
        let mut bytes = HALVES.to_vec();
        let frame = bytes
            .windows(2)
            .position(|two| two == [0xFF, 0xC0])
            .unwrap();
        bytes[frame + 5..frame + 9].fill(0xFF);
        let error = read(&bytes).err().unwrap().to_string();
        assert!(error.contains("67108864"), "{error}");
    }
}
