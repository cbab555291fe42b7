//! JSON documents: splits a text that has several values, as loggers and databases write them, into
//! its objects.
//!
//! | text | standard or writer |
//! |---|---|
//! | one object per line | JSON lines, GeoJSON lines |
//! | objects after the control character RS | RFC 7464, RFC 8142 |
//! | an array of objects | exports of databases |
//! | `topic {...}` or `time topic {...}`, or `{"topic": ..., "payload": {...}}` | clients of MQTT |

use std::borrow::Cow;

use super::scan::{member, unescaped};
use crate::sniff::is_before_payload;

/// Record separator of RFC 7464.
const SEPARATOR: char = '\u{1E}';

/// Returns the objects of a text that is a sequence or an array of objects. Any other text is one
/// document: its reader reports what is wrong with it.
pub(crate) fn documents(text: &str) -> Vec<&str> {
    split(text).unwrap_or_else(|| vec![text])
}

fn split(text: &str) -> Option<Vec<&str>> {
    let mut rest = skip_blanks(text);
    let is_array = rest.starts_with('[');
    if is_array {
        rest = skip_blanks(&rest[1..]);
    }
    let mut all = Vec::new();
    while !rest.is_empty() {
        if is_array && rest.starts_with(']') {
            return skip_blanks(&rest[1..]).is_empty().then_some(all);
        }
        rest = skip_topic(rest)?;
        // A cut object reaches to the end of the text; its parser says so.
        let end = object_end(rest).unwrap_or(rest.len());
        all.push(&rest[..end]);
        rest = skip_blanks(&rest[end..]);
        if is_array {
            rest = skip_blanks(rest.strip_prefix(',').unwrap_or(rest));
        }
    }
    (!is_array && !all.is_empty()).then_some(all)
}

fn skip_blanks(text: &str) -> &str {
    text.trim_start_matches(|c: char| c.is_ascii_whitespace() || c == SEPARATOR)
}

/// Skips what a log has before an object on its line, such as a time and a topic; `None` if no
/// object follows.
fn skip_topic(text: &str) -> Option<&str> {
    let start = text.find('{')?;
    let (before, object) = text.split_at(start);
    (before.is_empty() || is_before_payload(before.as_bytes())).then_some(object)
}

/// Returns the byte after the object at the start of a text.
fn object_end(text: &str) -> Option<usize> {
    let (mut depth, mut is_string, mut is_escaped) = (0_u64, false, false);
    for (at, byte) in text.bytes().enumerate() {
        match byte {
            _ if is_escaped => is_escaped = false,
            b'\\' if is_string => is_escaped = true,
            b'"' => is_string = !is_string,
            _ if is_string => {}
            b'{' | b'[' => depth += 1,
            b'}' | b']' => {
                depth = depth.checked_sub(1)?;
                if depth == 0 {
                    return Some(at + 1);
                }
            }
            _ => {}
        }
    }
    None
}

/// Returns the payload of a message, which a client of MQTT wraps with its topic: an object, or a
/// text that holds one. Other documents are returned as they are.
pub(crate) fn payload(document: &str) -> Cow<'_, str> {
    // Only valid JSON can be scanned.
    let is_valid = || serde_json::from_str::<serde::de::IgnoredAny>(document).is_ok();
    if !document.contains("\"payload\"") || !is_valid() {
        return document.into();
    }
    let start = document.len() - document.trim_start().len();
    let Some(value) = member(document, start, "payload") else {
        return document.into();
    };
    let value = &document[value];
    match value.as_bytes().first() {
        Some(b'{') => value.into(),
        Some(b'"') => unescaped(value).into(),
        _ => document.into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sequences_and_arrays_are_split() {
        for text in [
            "{\"a\": 1}\n{\"b\": \"}\\\"{\"}\n",
            "\u{1E}{\"a\": 1}\n\u{1E}{\"b\": \"}\\\"{\"}\n",
            "[{\"a\": 1}, {\"b\": \"}\\\"{\"}]",
            "[\n{\"a\": 1}\n,\n{\"b\": \"}\\\"{\"}\n]\n",
            "a/b {\"a\": 1}\na/c {\"b\": \"}\\\"{\"}",
            "2024-01-01 00:00 a/b {\"a\": 1}\n[17] a/c: {\"b\": \"}\\\"{\"}",
            "{\"a\": 1}{\"b\": \"}\\\"{\"}",
        ] {
            let expected = ["{\"a\": 1}", "{\"b\": \"}\\\"{\"}"];
            assert_eq!(documents(text), expected, "{text}");
        }
        for text in [
            "{} garbage",
            "[1, 2]",
            "[{}, 3]",
            "[{}",
            "{}]",
            "",
            "topic {}",
        ] {
            assert_eq!(documents(text), [text], "{text}");
        }
        assert_eq!(documents("{} {\"cut\": ["), ["{}", "{\"cut\": ["]);
    }

    #[test]
    fn payloads_are_unwrapped() {
        for (document, expected) in [
            (r#"{"topic": "t", "payload": {"a": 1}}"#, r#"{"a": 1}"#),
            (r#"{"payload": "{\"a\": 1}"}"#, r#"{"a": 1}"#),
            (r#"{"payload": 3}"#, r#"{"payload": 3}"#),
            (r#"{"a": "\"payload\""}"#, r#"{"a": "\"payload\""}"#),
            (r#"{"payload": {"#, r#"{"payload": {"#),
        ] {
            assert_eq!(payload(document), expected);
        }
    }
}
