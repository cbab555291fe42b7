//! Decodes text values of a DXF file to Unicode.

/// Decodes a text value: UTF-8 (since release 2007), else Latin-1 as an approximation of
/// Windows-1252, with `\U+00E4` escapes in both.
pub(super) fn decode_text(bytes: &[u8]) -> String {
    let text = match std::str::from_utf8(bytes) {
        Ok(text) => text.to_owned(),
        Err(_) => bytes.iter().map(|&b| char::from(b)).collect(),
    };
    let mut parts = text.split(r"\U+");
    let mut decoded = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let digits = part.get(..4).and_then(|d| u32::from_str_radix(d, 16).ok());
        match digits.and_then(char::from_u32) {
            Some(character) => {
                decoded.push(character);
                decoded.push_str(&part[4..]);
            }
            None => {
                decoded.push_str(r"\U+");
                decoded.push_str(part);
            }
        }
    }
    decoded
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decodes_utf8_latin_1_and_unicode_escapes() {
        assert_eq!(decode_text(b"W\xE4nde"), "Wände");
        assert_eq!(decode_text("Wände".as_bytes()), "Wände");
        assert_eq!(decode_text(br"W\U+00E4nde\U+"), r"Wände\U+");
        assert_eq!(decode_text(br"\U+ZZZZ\U+D800"), r"\U+ZZZZ\U+D800");
    }
}
