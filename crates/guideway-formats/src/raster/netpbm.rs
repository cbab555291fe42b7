//! Reads PGM, the gray images of Netpbm: P2 (numbers as text) and P5 (bytes), up to 16 bits.
//!
//! A header of magic, width, height and greatest value, separated by white space, with comments
//! from `#` to the end of a line; then the values, row by row from the top. Source: the man page
//! `pgm(5)` of Netpbm.

use guideway_layout::Place;

use super::image::{Raster, check_pixels};
use crate::Problem;

/// Greatest value that the format allows for its brightest pixel.
const MAX_MAXVAL: u64 = 65_535;

/// Returns `true` if bytes begin as PGM.
pub(super) fn is_pgm(bytes: &[u8]) -> bool {
    matches!(bytes, [b'P', b'2' | b'5', next, ..] if next.is_ascii_whitespace() || *next == b'#')
}

/// Reads the first image of a file for which [`is_pgm`] holds.
///
/// # Errors
/// When the header is damaged, the size exceeds the limit, or values are missing or too great.
pub(super) fn read(bytes: &[u8]) -> Result<Raster, Problem> {
    let is_text = bytes.starts_with(b"P2");
    let mut header = Numbers { bytes, at: 2 };
    let width = header.next("width")?;
    let height = header.next("height")?;
    let maxval = header.next("greatest value")?;
    if !(1..=MAX_MAXVAL).contains(&maxval) {
        let detail = format!("{maxval} is not from 1 to {MAX_MAXVAL}");
        return Err(damaged("greatest value", detail));
    }
    let count = check_pixels(width, height)?;
    let values = match is_text {
        true => text_values(header, count, maxval)?,
        false => byte_values(header, count, maxval)?,
    };
    Ok(Raster {
        width: width as usize,
        height: height as usize,
        pixels: values,
        has_alpha: false,
        png: None,
    })
}

/// The pixels of P2.
fn text_values(
    mut numbers: Numbers<'_>,
    count: usize,
    maxval: u64,
) -> Result<Vec<[u8; 4]>, Problem> {
    // A value takes at least a digit and a space: checked before memory is allocated.
    numbers.require(2 * count - 1, count)?;
    let pixel = |_| {
        let value = numbers.next("pixel")?;
        gray(value, maxval)
    };
    (0..count).map(pixel).collect()
}

/// The pixels of P5: one byte per value, or two, the greater first, if values exceed a byte.
fn byte_values(header: Numbers<'_>, count: usize, maxval: u64) -> Result<Vec<[u8; 4]>, Problem> {
    let size = if maxval < 256 { 1 } else { 2 };
    // One character of white space separates the header from the values.
    let values = Numbers {
        at: header.at + 1,
        ..header
    };
    values.require(count * size, count)?;
    let values = values.rest().chunks_exact(size).take(count);
    let number = |bytes: &[u8]| bytes.iter().fold(0, |sum, &b| sum << 8 | u64::from(b));
    values.map(|bytes| gray(number(bytes), maxval)).collect()
}

/// An opaque gray of 8 bits.
fn gray(value: u64, maxval: u64) -> Result<[u8; 4], Problem> {
    if value > maxval {
        let detail = format!("{value} exceeds the greatest value of the header, {maxval}");
        return Err(damaged("pixel", detail));
    }
    let level = ((value * 255 + maxval / 2) / maxval) as u8;
    Ok([level, level, level, 255])
}

fn damaged(place: &str, detail: String) -> Problem {
    Problem::Damaged {
        place: Place::element(place),
        detail,
    }
}

/// The decimal numbers of a file, between white space and comments.
#[derive(Clone, Copy)]
struct Numbers<'b> {
    bytes: &'b [u8],
    /// Bytes before the next number.
    at: usize,
}

impl<'b> Numbers<'b> {
    fn rest(&self) -> &'b [u8] {
        self.bytes.get(self.at..).unwrap_or_default()
    }

    /// Fails if fewer than `needed` bytes are left, which `count` pixels take.
    fn require(&self, needed: usize, count: usize) -> Result<(), Problem> {
        let left = self.rest().len();
        if left >= needed {
            return Ok(());
        }
        Err(Problem::Truncated {
            at: self.bytes.len() as u64,
            detail: format!("{count} pixels take at least {needed} bytes, and {left} follow"),
        })
    }

    /// The next number, whose name is for errors.
    fn next(&mut self, name: &str) -> Result<u64, Problem> {
        self.skip_space();
        let digits = self.rest();
        let length = digits.iter().take_while(|b| b.is_ascii_digit()).count();
        let (number, after) = digits.split_at(length);
        let ends = |b: &u8| b.is_ascii_whitespace() || *b == b'#';
        if !after.first().is_none_or(ends) || (number.is_empty() && !after.is_empty()) {
            let found = after
                .first()
                .map_or(String::new(), |b| b.escape_ascii().to_string());
            let detail = format!("`{found}` at byte {} is no digit", self.at + length);
            return Err(damaged(name, detail));
        }
        if number.is_empty() {
            return Err(Problem::Truncated {
                at: self.bytes.len() as u64,
                detail: format!("no {name} follows"),
            });
        }
        self.at += length;
        let add = |sum: u64, b: &u8| sum.saturating_mul(10).saturating_add(u64::from(b - b'0'));
        Ok(number.iter().fold(0, add))
    }

    fn skip_space(&mut self) {
        while let Some(&byte) = self.rest().first() {
            match byte {
                b'#' => {
                    let line = self.rest().iter().position(|&b| b == b'\n');
                    self.at += line.unwrap_or(self.rest().len());
                }
                _ if byte.is_ascii_whitespace() => self.at += 1,
                _ => return,
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn levels(bytes: &[u8]) -> Vec<u8> {
        let raster = read(bytes).unwrap();
        assert_eq!((raster.width, raster.height), (3, 2));
        raster.pixels.iter().map(|pixel| pixel[0]).collect()
    }

    #[test]
    fn text_and_bytes_of_8_and_16_bits_are_the_same_image() {
        let expected = [0, 51, 102, 153, 204, 255];
        let text = b"P2\n# from a robot\n3 2 # size\n5\n0 1 2\n3 4 5";
        assert_eq!(levels(text), expected);
        assert_eq!(levels(b"P5 3 2 5\n\x00\x01\x02\x03\x04\x05"), expected);
        // The first value looks like white space, and a line end after the values is allowed.
        assert_eq!(levels(b"P5\n3\n2\n255\n\n\x33\x66\x99\xCC\xFF\n")[0], 10);
        let wide = b"P5 3 2 65535\n\x00\x00\x33\x33\x66\x66\x99\x99\xCC\xCC\xFF\xFF";
        assert_eq!(levels(wide), expected);
        assert_eq!(levels(b"P2 3 2 1000 0 200 400 600 800 1000"), expected);
    }

    #[test]
    fn damaged_files_say_where_and_why() {
        for (bytes, said) in [
            (&b"P5 "[..], "no width follows"),
            (b"P5 3 2 # 255", "no greatest value follows"),
            (
                b"P5 3 x 255\n",
                "height: the file is damaged: `x` at byte 5",
            ),
            (
                b"P5 3 2.5 255\n",
                "height: the file is damaged: `.` at byte 6",
            ),
            (
                b"P5 -3 2 255\n",
                "width: the file is damaged: `-` at byte 3",
            ),
            (b"P5 3 2 0\n", "0 is not from 1 to 65535"),
            (b"P5 3 2 65536\n", "65536 is not from 1 to 65535"),
            (b"P5 0 2 255\n", "0 x 2 pixels"),
            (
                b"P5 99999999999999999999999 2 255\n",
                "limits of 1 to 67108864",
            ),
            (b"P5 60000 60000 255\n", "60000 x 60000 pixels"),
            (
                b"P5 3 2 255\nabcde",
                "6 pixels take at least 6 bytes, and 5 follow",
            ),
            (b"P5 3 2 256\nabcdefghij", "12 bytes, and 10 follow"),
            (b"P5 3 2 255", "6 bytes, and 0 follow"),
            (b"P5 3 2 5\n\x00\x01\x02\x03\x04\x06", "6 exceeds"),
            (b"P2 8000 8000 5 1 2 3", "at least 127999999 bytes"),
            (b"P2 3 2 5 10 2 3 4 5 ", "10 exceeds"),
            (b"P2 3 2 5 1 2 3 4 5          ", "no pixel follows"),
        ] {
            let error = read(bytes).err().unwrap();
            let error = format!("{error}. {}", error.remedy());
            assert!(error.contains(said), "{}: {error}", bytes.escape_ascii());
        }
    }
}
