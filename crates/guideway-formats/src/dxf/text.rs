//! Text decoder: decodes the text values of a DXF file to Unicode, by its release and code page.

use crate::charset::Charset;
use crate::dos_page::DosPage;

/// Decoder of the text values of a file.
#[derive(Debug)]
pub(super) struct TextDecoder {
    page: CodePage,
    /// True if a text that is UTF-8 is read as such, whatever the code page.
    prefers_utf8: bool,
}

/// A code page.
#[derive(Clone, Copy, Debug)]
enum CodePage {
    Known(Charset),
    Dos(DosPage),
}

/// First release whose texts are UTF-8.
const UTF8_SINCE: &str = "AC1021";

impl Default for TextDecoder {
    fn default() -> Self {
        Self {
            page: CodePage::Known(Charset::WINDOWS_1252),
            prefers_utf8: true,
        }
    }
}

impl TextDecoder {
    /// Makes the decoder of a file from its release (`$ACADVER`) and code page (`$DWGCODEPAGE`).
    /// Windows-1252 stands for a missing or unknown page.
    ///
    /// Before release 2007 the code page counts. But many programs wrote UTF-8 even then, and a
    /// whole file of another encoding is UTF-8 by chance only if it has very few letters. In the
    /// pages of East Asia, such letters look like two bytes of UTF-8; their own have three there.
    pub(super) fn new(release: &str, page: Option<&[u8]>, bytes: &[u8]) -> Self {
        let page = page.and_then(code_page);
        let is_by_chance = |text: &str| {
            let is_east_asian = matches!(page, Some(CodePage::Known(page)) if page.is_east_asian());
            is_east_asian && text.chars().all(|letter| letter < '\u{800}')
        };
        let is_text = || str::from_utf8(bytes).is_ok_and(|text| !is_by_chance(text));
        let is_utf8 = page.is_none() || release >= UTF8_SINCE || is_text();
        Self {
            page: page.unwrap_or(CodePage::Known(Charset::WINDOWS_1252)),
            prefers_utf8: is_utf8,
        }
    }

    /// Decodes a text value, with the escapes `\U+00E4` (Unicode), `\M+5BBF5` (a code page and two
    /// bytes in it), `^I` (tab), `^J` (line feed), `^M` (carriage return) and `^ ` (a caret).
    pub(super) fn decode(&self, bytes: &[u8]) -> String {
        let text = match str::from_utf8(bytes) {
            Ok(text) if self.prefers_utf8 || text.is_ascii() => text.to_owned(),
            _ => self.page.decode(bytes),
        };
        if text.contains("\\U+") || text.contains("\\M+") || text.contains('^') {
            return unescape(&text);
        }
        text
    }

    /// Decodes a text that is split over several values, even within a letter or an escape.
    pub(super) fn decode_parts<'p>(&self, parts: impl Iterator<Item = &'p [u8]>) -> String {
        self.decode(&parts.collect::<Vec<_>>().concat())
    }
}

impl CodePage {
    fn decode(self, bytes: &[u8]) -> String {
        match self {
            Self::Known(charset) => charset.decode(bytes).0,
            Self::Dos(page) => page.decode(bytes),
        }
    }
}

/// Returns whether a code page is known.
pub(super) fn is_known_page(page: &[u8]) -> bool {
    code_page(page).is_some()
}

/// Returns the code page of a name such as `ANSI_936`, `dos850`, `ISO8859-2` or `BIG5`.
fn code_page(name: &[u8]) -> Option<CodePage> {
    let name = str::from_utf8(name).ok()?.trim().to_ascii_uppercase();
    let digits = name.trim_start_matches(|c: char| !c.is_ascii_digit());
    Some(CodePage::Known(match (name.as_str(), digits) {
        ("GB2312" | "GBK", _) | (_, "936") => Charset::GBK,
        ("BIG5", _) | (_, "950") => Charset::BIG5,
        ("KSC5601", _) | (_, "949") => Charset::EUC_KR,
        ("MACINTOSH" | "MAC-ROMAN", _) => Charset::MACINTOSH,
        ("ASCII" | "US_ASCII", _) | (_, "1252" | "8859-1") => Charset::WINDOWS_1252,
        (_, "874") => Charset::WINDOWS_874,
        (_, "932") => Charset::SHIFT_JIS,
        (_, "1250") => Charset::WINDOWS_1250,
        (_, "1251") => Charset::WINDOWS_1251,
        (_, "1253") => Charset::WINDOWS_1253,
        (_, "1254" | "8859-9") => Charset::WINDOWS_1254,
        (_, "1255") => Charset::WINDOWS_1255,
        (_, "1256") => Charset::WINDOWS_1256,
        (_, "1257") => Charset::WINDOWS_1257,
        (_, "1258") => Charset::WINDOWS_1258,
        (_, "866") => Charset::IBM866,
        (_, "8859-2") => Charset::ISO_8859_2,
        (_, "8859-3") => Charset::ISO_8859_3,
        (_, "8859-4") => Charset::ISO_8859_4,
        (_, "8859-5") => Charset::ISO_8859_5,
        (_, "8859-6") => Charset::ISO_8859_6,
        (_, "8859-7") => Charset::ISO_8859_7,
        (_, "8859-8") => Charset::ISO_8859_8,
        (_, number) => return DosPage::of_number(number).map(CodePage::Dos),
    }))
}

/// Replaces the escapes of a text; what only looks like one stays.
fn unescape(text: &str) -> String {
    let mut decoded = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(at) = rest.find(['\\', '^']) {
        decoded.push_str(&rest[..at]);
        rest = &rest[at..];
        let escape = unicode_escape(rest).or_else(|| page_escape(rest));
        let (letters, length) = escape
            .or_else(|| caret_escape(rest))
            .unwrap_or_else(|| (rest[..1].to_owned(), 1));
        decoded.push_str(&letters);
        rest = &rest[length..];
    }
    decoded + rest
}

/// Returns the character of an escape such as `^I` at the start of a text, and the bytes that it
/// takes.
///
/// The DXF reference has an escape for each control character. Those that no text has are read as
/// two letters, because many programs write a caret in a name as it is: `A^B`.
fn caret_escape(text: &str) -> Option<(String, usize)> {
    let letter = match text.get(..2)? {
        "^I" => "\t",
        "^J" => "\n",
        "^M" => "\r",
        "^ " => "^",
        _ => return None,
    };
    Some((letter.to_owned(), 2))
}

/// Returns the letter of an escape such as `\U+00E4` at the start of a text, or of two that are a
/// surrogate pair, and the bytes that it takes.
fn unicode_escape(text: &str) -> Option<(String, usize)> {
    const LENGTH: usize = 7;
    let unit = |at: usize| {
        let digits = text.get(at..)?.strip_prefix("\\U+")?.get(..4)?;
        u16::from_str_radix(digits, 16).ok()
    };
    let units = [unit(0)?, unit(LENGTH).unwrap_or_default()];
    let letter = char::decode_utf16(units).next()?.ok()?;
    Some((letter.to_string(), LENGTH * letter.len_utf16()))
}

/// Returns the letter of an escape such as `\M+5BBF5` at the start of a text, and the bytes that it
/// takes. The first digit is the code page.
fn page_escape(text: &str) -> Option<(String, usize)> {
    let digits = text.strip_prefix("\\M+")?.get(..5)?;
    let (page, digits) = digits.split_at_checked(1)?;
    let charset = match page {
        "1" => Charset::SHIFT_JIS,
        "2" => Charset::BIG5,
        "3" => Charset::EUC_KR,
        "5" => Charset::GBK,
        _ => return None,
    };
    let bytes = u16::from_str_radix(digits, 16).ok()?.to_be_bytes();
    let bytes = match bytes[0] {
        0 => &bytes[1..],
        _ => &bytes[..],
    };
    let (letter, is_wrong) = charset.decode(bytes);
    (!is_wrong).then_some((letter, 8))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decodes_by_code_page_and_release() {
        for (release, page, bytes, expected) in [
            ("AC1015", "ANSI_936", &b"\xBB\xF5\xBC\xDC"[..], "货架"),
            ("AC1015", "GB2312", b"\xBB\xF5\xBC\xDC", "货架"),
            ("AC1015", "ANSI_1250", b"\x8Ccie\xBFka", "Ścieżka"),
            ("AC1015", "ansi_1251", b"\xEF\xF3\xF2\xFC", "путь"),
            ("AC1015", "ANSI_932", b"\x92\xCA\x98H", "通路"),
            ("AC1015", "ANSI_949", b"\xB1\xE6", "길"),
            ("AC1009", "dos850", b"W\x84nde", "Wände"),
            ("AC1009", "DOS437", b"\xE1\x81", "ßü"),
            ("AC1009", "dos866", b"\xAF\xE3\xE2\xEC", "путь"),
            ("AC1009", "DOS852", b"Dr\xA0ha \xA7", "Dráha ž"),
            ("AC1009", "dos857", b"yol\xA7\x8D", "yolğı"),
            ("AC1015", "ISO8859-2", b"\xB6", "ś"),
            ("AC1015", "iso8859-9", b"yol\xF0\xFD", "yolğı"),
            ("AC1015", "ANSI_1252", b"W\xE4nde \x80", "Wände €"),
            // Another program's UTF-8 under a code page, and the UTF-8 of release 2007.
            ("AC1015", "ANSI_936", "货架".as_bytes(), "货架"),
            ("AC1021", "ANSI_936", "货架".as_bytes(), "货架"),
            ("AC1021", "ANSI_1252", b"W\xE4nde", "Wände"),
        ] {
            let decoder = TextDecoder::new(release, Some(page.as_bytes()), bytes);
            assert_eq!(decoder.decode(bytes), expected, "{release} {page}");
        }
        assert!(!is_known_page(b"ANSI_1361") && !is_known_page(b""));
        // By chance UTF-8 too, in a file that is not.
        let mixed = b"\xC4\xA3 \xBB\xF5";
        let decoder = TextDecoder::new("AC1015", Some(b"ANSI_936"), mixed);
        assert_eq!(decoder.decode(&mixed[..2]), "模");
    }

    #[test]
    fn decodes_utf8_latin_1_and_escapes_without_a_page() {
        let decode = |bytes: &[u8]| TextDecoder::default().decode(bytes);
        assert_eq!(decode(b"W\xE4nde"), "Wände");
        assert_eq!(decode("Wände".as_bytes()), "Wände");
        assert_eq!(decode(br"W\U+00E4nde\U+"), r"Wände\U+");
        assert_eq!(decode(br"\U+ZZZZ\U+D800"), r"\U+ZZZZ\U+D800");
        assert_eq!(decode(br"\U+D83D\U+DE9A \U+D83D"), r"🚚 \U+D83D");
        assert_eq!(decode(br"\M+5BBF5\M+5BCDC"), "货架");
        assert_eq!(decode(br"a\M+192CA\b"), r"a通\b");
        assert_eq!(decode(br"\M+9BBF5\M+5BB\M+5\"), r"\M+9BBF5\M+5BB\M+5\");
    }

    #[test]
    fn decodes_carets_once() {
        let decode = |bytes: &[u8]| TextDecoder::default().decode(bytes);
        assert_eq!(decode(b"Gang^I1^J^M"), "Gang\t1\n\r");
        assert_eq!(decode(b"^ I ^  "), "^I ^ ");
        // No escapes of texts.
        assert_eq!(decode(b"A^B ^i^^I^"), "A^B ^i^\t^");
        assert_eq!(decode("^ä".as_bytes()), "^ä");
        // The character of an escape begins no other escape.
        assert_eq!(decode(br"\U+005EI ^ \U+0041"), "^I ^A");
        let parts = ["a^", "Ib\\U+00", "E4\u{e4}"];
        let bytes = parts.map(str::as_bytes).into_iter();
        let parts = bytes.chain([&b"\xC3"[..], b"\xA4"]);
        assert_eq!(TextDecoder::default().decode_parts(parts), "a\tbäää");
    }
}
