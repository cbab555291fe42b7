//! Converts text files to UTF-8: bytes in the encoding that they declare in, UTF-8 out.
//!
//! | bytes | encoding |
//! |---|---|
//! | a byte order mark | the one that it marks |
//! | every other one of the first bytes is zero | UTF-16 |
//! | three of each four first bytes are zero | UTF-32 |
//! | `<?xml ... encoding="..."?>` | the declared one |
//! | any others | unchanged: UTF-8, or a format that is not text |

use std::borrow::Cow;

use encoding_rs::{DecoderResult, Encoding, UTF_8, UTF_16BE, UTF_16LE};
use guideway_layout::Place;

use crate::Problem;
use crate::dos_page::DosPage;
use crate::text::printable;

/// Longest XML declaration that is searched for an encoding, in bytes.
const MAX_DECLARATION: usize = 1024;

/// Returns the bytes of a text in UTF-8; other bytes unchanged.
///
/// # Errors
/// When the declared encoding is not known, or when the bytes are not in it.
pub(crate) fn to_utf8(bytes: &[u8]) -> Result<Cow<'_, [u8]>, Problem> {
    let (encoding, start) = match bytes {
        [0xFF, 0xFE, 0, 0, rest @ ..] => return owned(utf_32(rest, 4, u32::from_le_bytes)),
        [0, 0, 0xFE, 0xFF, rest @ ..] => return owned(utf_32(rest, 4, u32::from_be_bytes)),
        [a, 0, 0, 0, b, 0, 0, 0, ..] if is_text(*a) && is_text(*b) => {
            return owned(utf_32(bytes, 0, u32::from_le_bytes));
        }
        [0, 0, 0, a, 0, 0, 0, b, ..] if is_text(*a) && is_text(*b) => {
            return owned(utf_32(bytes, 0, u32::from_be_bytes));
        }
        [0xFF, 0xFE, ..] => (UTF_16LE, 2),
        [0xFE, 0xFF, ..] => (UTF_16BE, 2),
        [a, 0, b, 0, ..] if is_text(*a) && is_text(*b) => (UTF_16LE, 0),
        [0, a, 0, b, ..] if is_text(*a) && is_text(*b) => (UTF_16BE, 0),
        _ => match declared(bytes) {
            // The bytes of ASCII are those of UTF-8; a label that the text outgrew.
            Some(label) if is_ascii_label(label) && str::from_utf8(bytes).is_ok() => (UTF_8, 0),
            Some(label) => match Encoding::for_label_no_replacement(label) {
                Some(encoding) => (encoding, 0),
                None => {
                    let page = DosPage::of_label(label);
                    let page = page.ok_or_else(|| unknown(&String::from_utf8_lossy(label)))?;
                    return owned(Ok(page.decode(bytes)));
                }
            },
            None => (UTF_8, 0),
        },
    };
    // A declaration of UTF-16 that can be read byte by byte is wrong.
    let is_wide = bytes
        .get(start..start + 2)
        .is_some_and(|pair| pair.contains(&0));
    if encoding == UTF_8 || (start == 0 && !is_wide && encoding.output_encoding() == UTF_8) {
        return Ok(Cow::Borrowed(bytes));
    }
    owned(decode(encoding, &bytes[start..], start))
}

fn owned(text: Result<String, Problem>) -> Result<Cow<'static, [u8]>, Problem> {
    text.map(|text| Cow::Owned(text.into_bytes()))
}

fn is_ascii_label(label: &[u8]) -> bool {
    let label = label.to_ascii_lowercase();
    label.ends_with(b"ascii") || label.starts_with(b"ansi_x3.4")
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

/// Decodes bytes of an encoding; `start` is their place in the file.
fn decode(encoding: &'static Encoding, bytes: &[u8], start: usize) -> Result<String, Problem> {
    let mut decoder = encoding.new_decoder_without_bom_handling();
    let length = decoder.max_utf8_buffer_length_without_replacement(bytes.len());
    let mut text = String::new();
    text.try_reserve_exact(length.unwrap_or(usize::MAX))
        .map_err(|_| Problem::Io(std::io::ErrorKind::OutOfMemory.into()))?;
    match decoder.decode_to_string_without_replacement(bytes, &mut text, true) {
        (DecoderResult::InputEmpty, _) => Ok(text),
        (_, read) => Err(Problem::WrongEncoding {
            encoding: encoding.name(),
            at: (start + read) as u64,
        }),
    }
}

/// Returns the encoding that an XML declaration states.
fn declared(bytes: &[u8]) -> Option<&[u8]> {
    let text = bytes.trim_ascii_start().strip_prefix(b"<?xml")?;
    let text = &text[..text.len().min(MAX_DECLARATION)];
    let end = text.windows(2).position(|pair| pair == b"?>")?;
    let key = b"encoding";
    let at = text[..end]
        .windows(key.len())
        .position(|word| word == key)?;
    let rest = text[at + key.len()..end].trim_ascii_start();
    let rest = rest.strip_prefix(b"=")?.trim_ascii_start();
    let (quote, rest) = rest.split_first()?;
    let length = rest.iter().position(|byte| byte == quote)?;
    Some(&rest[..length])
}

fn unknown(label: &str) -> Problem {
    Problem::Unsupported {
        place: Place::element("the head of the file"),
        what: format!("the encoding `{}`", printable(label)),
        remedy: "Save the file as UTF-8".into(),
    }
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
            error.to_string().contains("not UTF-16LE at byte 6"),
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
