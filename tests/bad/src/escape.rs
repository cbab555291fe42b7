//! Escapes any bytes as lines of plain text, and reads them back.
//!
//! | escape | bytes |
//! |---|---|
//! | `\\` | a backslash |
//! | `\r` | a carriage return |
//! | `\xHH` | the byte of two hexadecimal digits |
//! | `\` at the end of a line | none: the file has no newline here |
//!
//! Everything else, line ends included, stands for itself.

use std::fmt::Write;

/// Columns after which an escaped line wraps.
const COLUMNS: usize = 96;

/// Reason why a line has an invalid escape.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("invalid escape `\\{0}`; valid are `\\\\`, `\\r`, `\\xHH`, and `\\` at the end of a line")]
pub struct EscapeError(String);

/// Whether editors and git keep a text as it is: no control character but tab and newline, and no
/// byte order mark.
pub(crate) fn is_plain(text: &str) -> bool {
    text.chars().all(is_plain_char)
}

fn is_plain_char(c: char) -> bool {
    matches!(c, '\n' | '\t') || !(c.is_control() || c == '\u{feff}')
}

/// The bytes as lines of plain text, none of which begins with `-- `.
pub(crate) fn escape(bytes: &[u8]) -> String {
    let mut text = String::new();
    let mut column = 0;
    for token in tokens(bytes) {
        let columns = token.chars().count();
        // The last column is that of the backslash.
        if column > 0 && token != "\n" && column + columns >= COLUMNS {
            text.push_str("\\\n");
            column = 0;
        }
        text.push_str(&token);
        column = if token == "\n" { 0 } else { column + columns };
    }
    if column > 0 {
        text.push_str("\\\n");
    }
    let lines = text.split_inclusive('\n');
    let lines = lines.map(|line| match line.strip_prefix('-') {
        Some(rest) if rest.starts_with("- ") => format!("\\x2d{rest}"),
        _ => line.to_owned(),
    });
    lines.collect()
}

/// Characters and escapes that stand for the bytes.
fn tokens(bytes: &[u8]) -> impl Iterator<Item = String> {
    bytes.utf8_chunks().flat_map(|chunk| {
        let valid = chunk.valid().chars().map(|c| match c {
            '\\' => "\\\\".to_owned(),
            '\r' => "\\r".to_owned(),
            c if is_plain_char(c) => c.to_string(),
            c => hex(c.encode_utf8(&mut [0; 4]).as_bytes()),
        });
        let invalid = chunk.invalid();
        valid.chain((!invalid.is_empty()).then(|| hex(invalid)))
    })
}

fn hex(bytes: &[u8]) -> String {
    bytes.iter().fold(String::new(), |mut text, byte| {
        // Writing to a string never fails.
        let _ = write!(text, "\\x{byte:02x}");
        text
    })
}

/// The bytes of one line, which ends with a newline.
pub(crate) fn unescape(line: &str) -> Result<Vec<u8>, EscapeError> {
    let mut bytes = Vec::with_capacity(line.len());
    let mut rest = line;
    while let Some((plain, escape)) = rest.split_once('\\') {
        bytes.extend(plain.as_bytes());
        let invalid = || EscapeError(escape.chars().take(3).collect::<String>().trim_end().into());
        let len = match escape.as_bytes().first() {
            Some(b'\\') => push(&mut bytes, b'\\'),
            Some(b'r') => push(&mut bytes, b'\r'),
            Some(b'\n') => 1,
            Some(b'x') => {
                let digits = escape.get(1..3).ok_or_else(invalid)?;
                if !digits.bytes().all(|b| b.is_ascii_hexdigit()) {
                    return Err(invalid());
                }
                push(
                    &mut bytes,
                    u8::from_str_radix(digits, 16).map_err(|_| invalid())?,
                );
                3
            }
            _ => return Err(invalid()),
        };
        rest = &escape[len..];
    }
    bytes.extend(rest.as_bytes());
    Ok(bytes)
}

/// Returns the length of an escape of one letter.
fn push(bytes: &mut Vec<u8>, byte: u8) -> usize {
    bytes.push(byte);
    1
}
