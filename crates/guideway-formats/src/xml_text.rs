//! Escapes text for XML 1.0 attributes and elements.

use std::fmt::Write as _;

/// Tells if XML 1.0 can contain a character.
pub(crate) fn is_xml_char(c: char) -> bool {
    !c.is_control() && !matches!(c, '\u{FFFE}' | '\u{FFFF}')
        || matches!(c, '\t' | '\n' | '\r' | '\u{7F}'..='\u{9F}')
}

/// Escapes text for an attribute. Replaces characters that XML cannot contain with `_`.
pub(crate) fn escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            // Parsers normalize unescaped white space in attributes to spaces.
            '\t' | '\n' | '\r' => {
                // Writing to a string cannot fail.
                let _ = write!(escaped, "&#{};", u32::from(c));
            }
            c if is_xml_char(c) => escaped.push(c),
            _ => escaped.push('_'),
        }
    }
    escaped
}
