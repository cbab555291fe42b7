//! Converts text files to UTF-8: bytes in the encoding that they declare in, UTF-8 out.
//!
//! | bytes | encoding |
//! |---|---|
//! | a byte order mark | the one that it marks |
//! | every other one of the first bytes is zero | UTF-16 |
//! | three of each four first bytes are zero | UTF-32 |
//! | `<?xml ... encoding="..."?>` | the declared one, with the feature `xml` |
//! | any others | unchanged: UTF-8, or a format that is not text |

use std::borrow::Cow;

use crate::Problem;
#[cfg(feature = "xml")]
use crate::xml::from_declared;

/// Returns the bytes of a text in UTF-8; other bytes unchanged.
///
/// # Errors
/// When the declared encoding is not known, or when the bytes are not in it.
pub(crate) fn to_utf8(bytes: &[u8]) -> Result<Cow<'_, [u8]>, Problem> {
    let text = match bytes {
        [0xFF, 0xFE, 0, 0, rest @ ..] => utf_32(rest, 4, u32::from_le_bytes),
        [0, 0, 0xFE, 0xFF, rest @ ..] => utf_32(rest, 4, u32::from_be_bytes),
        [a, 0, 0, 0, b, 0, 0, 0, ..] if is_text(*a) && is_text(*b) => {
            utf_32(bytes, 0, u32::from_le_bytes)
        }
        [0, 0, 0, a, 0, 0, 0, b, ..] if is_text(*a) && is_text(*b) => {
            utf_32(bytes, 0, u32::from_be_bytes)
        }
        [0xFF, 0xFE, rest @ ..] => utf_16(rest, 2, UTF_16LE),
        [0xFE, 0xFF, rest @ ..] => utf_16(rest, 2, UTF_16BE),
        [a, 0, b, 0, ..] if is_text(*a) && is_text(*b) => utf_16(bytes, 0, UTF_16LE),
        [0, a, 0, b, ..] if is_text(*a) && is_text(*b) => utf_16(bytes, 0, UTF_16BE),
        #[cfg(feature = "xml")]
        _ => return from_declared(bytes),
        #[cfg(not(feature = "xml"))]
        _ => return Ok(Cow::Borrowed(bytes)),
    };
    text.map(|text| Cow::Owned(text.into_bytes()))
}

/// The name of an encoding, and the number of a pair of its bytes.
type Utf16 = (&'static str, fn([u8; 2]) -> u16);

const UTF_16LE: Utf16 = ("UTF-16LE", u16::from_le_bytes);
const UTF_16BE: Utf16 = ("UTF-16BE", u16::from_be_bytes);

/// Decodes UTF-16; `start` is the place of the bytes in the file.
fn utf_16(bytes: &[u8], start: usize, (encoding, number): Utf16) -> Result<String, Problem> {
    let mut text = String::new();
    // Two bytes become at most three.
    text.try_reserve(bytes.len() / 2 * 3)
        .map_err(|_| Problem::Io(std::io::ErrorKind::OutOfMemory.into()))?;
    let wrong = |index: usize| Problem::WrongEncoding {
        encoding,
        at: (start + 2 * index) as u64,
    };
    let (pairs, rest) = bytes.as_chunks::<2>();
    let mut index = 0;
    for letter in char::decode_utf16(pairs.iter().map(|&pair| number(pair))) {
        let letter = letter.map_err(|_| wrong(index))?;
        text.push(letter);
        index += letter.len_utf16();
    }
    match rest {
        [] => Ok(text),
        _ => Err(wrong(pairs.len())),
    }
}

/// Decodes numbers of characters; `start` is the place of the bytes in the file.
fn utf_32(bytes: &[u8], start: usize, number: fn([u8; 4]) -> u32) -> Result<String, Problem> {
    let mut text = String::new();
    text.try_reserve(bytes.len())
        .map_err(|_| Problem::Io(std::io::ErrorKind::OutOfMemory.into()))?;
    let (numbers, rest) = bytes.as_chunks::<4>();
    for (index, &bytes) in numbers.iter().enumerate() {
        let letter = char::from_u32(number(bytes));
        text.push(letter.ok_or_else(|| not_utf_32(start + 4 * index))?);
    }
    match rest {
        [] => Ok(text),
        _ => Err(not_utf_32(start + 4 * numbers.len())),
    }
}

fn not_utf_32(at: usize) -> Problem {
    Problem::WrongEncoding {
        encoding: "UTF-32",
        at: at as u64,
    }
}

fn is_text(byte: u8) -> bool {
    byte.is_ascii_graphic() || byte.is_ascii_whitespace()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text(bytes: &[u8]) -> String {
        String::from_utf8(to_utf8(bytes).unwrap().into_owned()).unwrap()
    }

    fn utf_16(text: &str, bytes: fn(u16) -> [u8; 2]) -> Vec<u8> {
        text.encode_utf16().flat_map(bytes).collect()
    }

    #[test]
    fn decodes_what_is_declared() {
        let head = |label: &str| format!("<?xml version='1.0' encoding = \"{label}\" ?><a b='");
        for (label, bytes, expected) in [
            ("ISO-8859-1", &b"\xE9\xFC"[..], "éü"),
            ("windows-1250", b"\xB9\xE8", "ąč"),
            ("GBK", b"\xB5\xC0\xC2\xB7", "道路"),
            ("gb2312", b"\xC2\xB7", "路"),
            ("Shift_JIS", b"\x93\xB9", "道"),
            ("EUC-KR", b"\xB1\xE6", "길"),
            ("IBM850", b"\x82\x81", "éü"),
            ("cp-437", b"\xE1", "ß"),
            ("US-ASCII", "é".as_bytes(), "é"),
            ("us-ascii", b"\xE9", "é"),
            ("utf-8", "é".as_bytes(), "é"),
            // The bytes cannot be UTF-16.
            ("UTF-16", "é".as_bytes(), "é"),
        ] {
            let file = [head(label).as_bytes(), bytes, b"'/>"].concat();
            assert_eq!(text(&file), head(label) + expected + "'/>", "{label}");
        }
        let all = "<é>路";
        for file in [
            utf_16(&format!("\u{FEFF}{all}"), u16::to_le_bytes),
            utf_16(&format!("\u{FEFF}{all}"), u16::to_be_bytes),
        ] {
            assert_eq!(text(&file), all);
        }
        for file in [
            utf_16("levels: é", u16::to_le_bytes),
            utf_16("{ \"é", u16::to_be_bytes),
        ] {
            assert!(text(&file).ends_with('é'));
        }
    }

    #[test]
    fn decodes_utf_32_with_and_without_a_mark() {
        for all in ["{\"é\": \"路\"}", "\u{FEFF}{\"é\": \"路\"}"] {
            for bytes in [u32::to_le_bytes, u32::to_be_bytes] {
                let file: Vec<u8> = all.chars().flat_map(|c| bytes(c.into())).collect();
                assert_eq!(text(&file), all.trim_start_matches('\u{FEFF}'));
            }
        }
    }

    #[test]
    fn leaves_other_bytes_alone() {
        for bytes in [
            &b"\xEF\xBB\xBF<?xml encoding='latin1'?>"[..],
            b"{\"a\": \"\xE9\"}",
            b"ARROW1\0\0",
            b"\xFF\xFF\xFF\xFF",
            b"AutoCAD Binary DXF\r\n\x1a\0",
            b"",
            b"<",
        ] {
            assert_eq!(to_utf8(bytes).unwrap(), bytes);
        }
    }

    #[test]
    fn says_what_is_wrong() {
        let error = to_utf8(b"<?xml encoding='gbk'?>\xB5'").unwrap_err();
        assert!(error.to_string().contains("not GBK at byte"), "{error}");
        let error = to_utf8(b"<?xml encoding='cp037'?>").unwrap_err();
        assert!(error.to_string().contains("`cp037`"), "{error}");
        let error = to_utf8(b"\xFF\xFE\x3C\x00\x00\xD8").unwrap_err();
        assert!(
            error.to_string().contains("not UTF-16LE at byte 4"),
            "{error}"
        );
        for (bytes, at) in [
            (&b"{\0\0\0\"\0\0\0\0\xD8\0\0"[..], 8),
            (b"\xFF\xFE\0\0<\0", 4),
        ] {
            let error = to_utf8(bytes).unwrap_err().to_string();
            assert!(
                error.contains(&format!("not UTF-32 at byte {at}")),
                "{error}"
            );
        }
    }
}
