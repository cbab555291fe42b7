//! Converts XML in the encoding that it declares to UTF-8.

use std::borrow::Cow;

use guideway_layout::Place;

use crate::Problem;
use crate::charset::Charset;
use crate::dos_page::DosPage;
use crate::text::printable;

/// Longest XML declaration that is searched for an encoding, in bytes.
const MAX_DECLARATION: usize = 1024;

/// Returns the bytes of a text in UTF-8; unchanged without a declaration of another encoding.
///
/// # Errors
/// When the declared encoding is not known, or when the bytes are not in it.
pub(crate) fn from_declared(bytes: &[u8]) -> Result<Cow<'_, [u8]>, Problem> {
    let Some(label) = declared(bytes) else {
        return Ok(Cow::Borrowed(bytes));
    };
    // The bytes of ASCII are those of UTF-8; a label that the text outgrew.
    if is_ascii_label(label) && str::from_utf8(bytes).is_ok() {
        return Ok(Cow::Borrowed(bytes));
    }
    let text = match Charset::of_label(label) {
        // A declaration of UTF-16 that can be read byte by byte is wrong.
        Some(charset) if charset.is_unicode() => return Ok(Cow::Borrowed(bytes)),
        Some(charset) => decode(charset, bytes)?,
        None => {
            let page = DosPage::of_label(label);
            let page = page.ok_or_else(|| unknown(&String::from_utf8_lossy(label)))?;
            page.decode(bytes)
        }
    };
    Ok(Cow::Owned(text.into_bytes()))
}

fn is_ascii_label(label: &[u8]) -> bool {
    let label = label.to_ascii_lowercase();
    label.ends_with(b"ascii") || label.starts_with(b"ansi_x3.4")
}

fn decode(charset: Charset, bytes: &[u8]) -> Result<String, Problem> {
    charset.decode_strictly(bytes).map_err(|wrong| match wrong {
        Some(at) => Problem::WrongEncoding {
            encoding: charset.name(),
            at: at as u64,
        },
        None => Problem::Io(std::io::ErrorKind::OutOfMemory.into()),
    })
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
