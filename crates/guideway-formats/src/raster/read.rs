//! Reads an image file; its first bytes decide between PNG, JPEG and Netpbm.

use std::path::Path;

use guideway_layout::Place;

use super::image::Raster;
use super::{jpeg, netpbm, png};
use crate::read::{quote_or_hex, read_file_bytes};
use crate::{Problem, ReadError, ReadOptions};

/// Largest image file, in bytes. Derived: 8 bytes for each pixel of the largest image, the most
/// that PNG, JPEG and the binary kinds of Netpbm take, and as much again for texts in it.
const MAX_FILE_BYTES: u64 = 1 << 30;

/// Returns `true` if bytes begin as an image of a format that [`read_file`] reads.
pub fn is_raster(bytes: &[u8]) -> bool {
    png::is_png(bytes) || jpeg::is_jpeg(bytes) || netpbm::is_netpbm(bytes)
}

/// Reads a PNG, JPEG or Netpbm (PBM, PGM, PPM) image.
///
/// # Errors
/// When the file cannot be read, has another format, is damaged, or exceeds a limit: 1 GiB,
/// [`MAX_PIXELS`](super::MAX_PIXELS) pixels.
pub fn read_file(path: &Path, options: &ReadOptions<'_>) -> Result<Raster, ReadError> {
    let bytes = read_file_bytes(path, options, MAX_FILE_BYTES)?;
    read_bytes(bytes, &path.to_string_lossy())
}

/// Reads a PNG, JPEG or Netpbm (PBM, PGM, PPM) image from memory. Errors name it `name`.
///
/// # Errors
/// As [`read_file`].
pub fn read_bytes(bytes: Vec<u8>, name: &str) -> Result<Raster, ReadError> {
    read(bytes).map_err(|problem| ReadError::new(name, problem))
}

fn read(bytes: Vec<u8>) -> Result<Raster, Problem> {
    if png::is_png(&bytes) {
        return png::read(bytes);
    }
    if jpeg::is_jpeg(&bytes) {
        return jpeg::read(&bytes);
    }
    if netpbm::is_netpbm(&bytes) {
        return netpbm::read(&bytes);
    }
    if bytes.is_empty() {
        return Err(Problem::Empty);
    }
    Err(Problem::Unsupported {
        place: Place::element("first bytes"),
        what: format!(
            "an image that begins with {}",
            quote_or_hex(&bytes[..bytes.len().min(8)])
        ),
        remedy: "Save the image as PNG, JPEG, PBM, PGM or PPM".into(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn other_formats_are_named_by_their_first_bytes() {
        for (bytes, said) in [
            (&b"BM\x00\x00"[..], "42 4D 00 00"),
            (b"P7\nWIDTH 2\n", "\"P7"),
            (b"P5x 1 1 1", "P5x 1"),
        ] {
            assert!(!is_raster(bytes));
            let error = read(bytes.to_vec()).err().unwrap();
            let text = format!("{error}. {}", error.remedy());
            assert!(
                text.contains(said) && text.contains("PBM, PGM or PPM"),
                "{text}"
            );
        }
        assert!(matches!(read(Vec::new()), Err(Problem::Empty)));
    }

    #[test]
    fn damaged_png_is_an_error() {
        for bytes in [
            &b"\x89PNG"[..],
            b"\x89PNG\r\n\x1a\n",
            b"\x89PNG\r\n\x1a\nrest of it",
        ] {
            assert!(is_raster(bytes));
            let error = read(bytes.to_vec()).err().unwrap();
            assert!(["truncated", "damaged"].contains(&error.code()), "{error}");
        }
    }
}
