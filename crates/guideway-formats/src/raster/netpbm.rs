//! Reads the images of Netpbm: bits (P1, P4), gray (P2, P5) and colors (P3, P6), up to 16 bits.
//!
//! | kind | values of a pixel | as text | as bytes |
//! |---|---|---|---|
//! | PBM | 1 is black, 0 is white | P1, spaces optional | P4, 8 per byte, rows padded |
//! | PGM | from black to the greatest value | P2 | P5 |
//! | PPM | red, green, blue | P3 | P6 |
//!
//! A header of magic, width, height and greatest value (which PBM lacks), separated by white space,
//! with comments from `#` to the end of a line; then the values, row by row from the top. Source:
//! the man pages `pbm(5)`, `pgm(5)` and `ppm(5)` of Netpbm.

use guideway_layout::Place;

use super::image::{Raster, check_pixels};
use crate::Problem;

/// Greatest value that the formats allow for their brightest pixel.
const MAX_MAXVAL: u64 = 65_535;

/// Returns `true` if bytes begin as an image of Netpbm.
pub(super) fn is_netpbm(bytes: &[u8]) -> bool {
    matches!(bytes, [b'P', b'1'..=b'6', next, ..] if next.is_ascii_whitespace() || *next == b'#')
}

/// Reads the first image of a file for which [`is_netpbm`] holds.
///
/// # Errors
/// When the header is damaged, the size exceeds the limit, or values are missing or too great.
pub(super) fn read(bytes: &[u8]) -> Result<Raster, Problem> {
    let kind = bytes.get(1).copied().unwrap_or_default();
    let mut header = Numbers { bytes, at: 2 };
    let width = header.next("width")?;
    let height = header.next("height")?;
    let (channels, maxval) = match kind {
        b'1' | b'4' => (1, 1),
        b'3' | b'6' => (3, header.next("greatest value")?),
        _ => (1, header.next("greatest value")?),
    };
    if !(1..=MAX_MAXVAL).contains(&maxval) {
        let detail = format!("{maxval} is not from 1 to {MAX_MAXVAL}");
        return Err(damaged("greatest value", detail));
    }
    let count = check_pixels(width, height)?;
    let values = Values {
        count,
        channels,
        maxval,
    };
    let pixels = match kind {
        b'1' => text_bits(header, count)?,
        b'2' | b'3' => values.of_text(header)?,
        b'4' => byte_bits(header, width as usize, count)?,
        _ => values.of_bytes(header)?,
    };
    Ok(Raster {
        width: width as usize,
        height: height as usize,
        pixels,
        has_alpha: false,
        png: None,
    })
}

/// The pixels of P1: digits, with or without spaces between them.
fn text_bits(mut numbers: Numbers<'_>, count: usize) -> Result<Vec<[u8; 4]>, Problem> {
    numbers.require(count, count)?;
    (0..count).map(|_| Ok(bit(numbers.next_bit()?))).collect()
}

/// The pixels of P4: the highest bit of a byte is the leftmost one.
fn byte_bits(header: Numbers<'_>, width: usize, count: usize) -> Result<Vec<[u8; 4]>, Problem> {
    let row_bytes = width.div_ceil(8);
    let values = header.after_space();
    values.require(row_bytes * (count / width), count)?;
    let rows = values.rest().chunks_exact(row_bytes).take(count / width);
    let row = |bytes: &[u8]| -> Vec<[u8; 4]> {
        let is_black = |i: usize| bytes[i / 8] << (i % 8) & 0x80 != 0;
        (0..width).map(|i| bit(is_black(i))).collect()
    };
    Ok(rows.flat_map(row).collect())
}

/// An opaque black or white.
fn bit(is_black: bool) -> [u8; 4] {
    let level = if is_black { 0 } else { 255 };
    [level, level, level, 255]
}

/// The values of gray or colored pixels.
struct Values {
    /// Number of pixels.
    count: usize,
    /// Values per pixel: one gray, or red, green and blue.
    channels: usize,
    maxval: u64,
}

impl Values {
    /// The pixels of P2 and P3.
    fn of_text(&self, mut numbers: Numbers<'_>) -> Result<Vec<[u8; 4]>, Problem> {
        // A value takes at least a digit and a space: checked before memory is allocated.
        numbers.require(2 * self.count * self.channels - 1, self.count)?;
        let pixel = |_| self.pixel(|_| numbers.next("pixel"));
        (0..self.count).map(pixel).collect()
    }

    /// The pixels of P5 and P6: one byte per value, or two, the greater first, if values exceed a
    /// byte.
    fn of_bytes(&self, header: Numbers<'_>) -> Result<Vec<[u8; 4]>, Problem> {
        let size = if self.maxval < 256 { 1 } else { 2 };
        let values = header.after_space();
        let pixel_bytes = size * self.channels;
        values.require(self.count * pixel_bytes, self.count)?;
        let number = |bytes: &[u8]| bytes.iter().fold(0, |sum, &b| sum << 8 | u64::from(b));
        let pixel = |bytes: &[u8]| self.pixel(|i| Ok(number(&bytes[i * size..][..size])));
        let pixels = values.rest().chunks_exact(pixel_bytes).take(self.count);
        pixels.map(pixel).collect()
    }

    /// An opaque color of 8 bits per channel from the values by their index.
    fn pixel(
        &self,
        mut value: impl FnMut(usize) -> Result<u64, Problem>,
    ) -> Result<[u8; 4], Problem> {
        let mut levels = [0; 3];
        for (i, level) in levels.iter_mut().take(self.channels).enumerate() {
            let value = value(i)?;
            if value > self.maxval {
                let maxval = self.maxval;
                let detail = format!("{value} exceeds the greatest value of the header, {maxval}");
                return Err(damaged("pixel", detail));
            }
            *level = ((value * 255 + self.maxval / 2) / self.maxval) as u8;
        }
        let [r, g, b] = match self.channels {
            1 => [levels[0]; 3],
            _ => levels,
        };
        Ok([r, g, b, 255])
    }
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

    /// The values after the header, which one character of white space ends.
    fn after_space(self) -> Self {
        let at = self.at + 1;
        Self { at, ..self }
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

    /// The next digit, 0 or 1.
    fn next_bit(&mut self) -> Result<bool, Problem> {
        self.skip_space();
        let next = self.rest().first().copied();
        self.at += 1;
        match next {
            Some(digit @ (b'0' | b'1')) => Ok(digit == b'1'),
            Some(other) => {
                let (other, at) = (other.escape_ascii(), self.at - 1);
                Err(damaged(
                    "pixel",
                    format!("`{other}` at byte {at} is neither 0 nor 1"),
                ))
            }
            None => Err(Problem::Truncated {
                at: self.bytes.len() as u64,
                detail: "no pixel follows".into(),
            }),
        }
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
    fn bits_are_black_and_rows_of_bytes_are_padded() {
        let expected = [0, 255, 0, 255, 255, 0];
        assert_eq!(levels(b"P1\n# a plan\n3 2\n1 0 1\n0 0 1\n"), expected);
        assert_eq!(levels(b"P1 3 2 10 #c\n1001"), expected);
        assert_eq!(levels(b"P4\n3 2\n\xBF\x20"), expected);
        let wide = read(b"P4 9 1 \x00\x80").unwrap();
        assert_eq!(wide.pixels.iter().filter(|pixel| pixel[0] == 0).count(), 1);
        assert_eq!(wide.pixels[8], [0, 0, 0, 255]);
    }

    #[test]
    fn colors_have_three_values() {
        let expected = [[255, 0, 51, 255], [102, 255, 0, 255]];
        let text = read(b"P3 2 1 5\n5 0 1\n2 5 0\n").unwrap();
        let bytes = read(b"P6\n2 1\n255\n\xFF\x00\x33\x66\xFF\x00").unwrap();
        let wide = read(b"P6 2 1 256\n\x01\x00\x00\x00\x00\x33\x00\x66\x01\x00\x00\x00").unwrap();
        assert_eq!((text.width, text.height), (2, 1));
        for raster in [text, bytes, wide] {
            assert_eq!(raster.pixels, expected);
        }
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
            (b"P1 3 2 10120", "`2` at byte 10 is neither 0 nor 1"),
            (b"P1 3 2 10       ", "no pixel follows"),
            (b"P1 3 2 1", "6 bytes, and 2 follow"),
            (b"P4 9 2 \x00\x00\x00", "18 pixels take at least 4 bytes"),
            (b"P4 0 2 ", "0 x 2 pixels"),
            (b"P3 1 1 5 1 2", "at least 5 bytes, and 4 follow"),
            (b"P6 1 1 5 \x00\x01\x06", "6 exceeds"),
            (b"P6 1 1 300 \x00\x01", "at least 6 bytes, and 2 follow"),
        ] {
            let error = read(bytes).err().unwrap();
            let error = format!("{error}. {}", error.remedy());
            assert!(error.contains(said), "{}: {error}", bytes.escape_ascii());
        }
    }
}
