//! JSON scan: finds the members and items of objects and arrays in a text whose syntax is valid, by
//! their byte ranges.

use std::ops::Range;

/// A member of an object, by byte ranges in the text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct MemberRange {
    /// The key with its quotes.
    pub(crate) key: Range<usize>,
    pub(crate) value: Range<usize>,
}

impl MemberRange {
    /// Returns whether the member has this key, which contains no character that JSON escapes.
    pub(crate) fn has_key(&self, text: &str, key: &str) -> bool {
        let written = &text[self.key.start + 1..self.key.end - 1];
        written == key || written.contains('\\') && unescaped(&text[self.key.clone()]) == key
    }
}

/// Returns the first byte of a part of a text; `None` for a text of its own.
pub(crate) fn offset_in(text: &str, part: &str) -> Option<usize> {
    let start = (part.as_ptr() as usize).checked_sub(text.as_ptr() as usize)?;
    (start + part.len() <= text.len()).then_some(start)
}

/// Returns the content of a string in quotes.
pub(crate) fn unescaped(quoted: &str) -> String {
    serde_json::from_str(quoted).unwrap_or_default()
}

/// Returns the members of the object at byte `at`; none for another value.
pub(crate) fn members(text: &str, at: usize) -> Vec<MemberRange> {
    let mut all = Vec::new();
    if text.as_bytes().get(at) != Some(&b'{') {
        return all;
    }
    let mut at = skip_separators(text, at + 1);
    while text.as_bytes().get(at) == Some(&b'"') {
        let key = at..value_end(text, at);
        let start = skip_separators(text, key.end);
        let value = start..value_end(text, start);
        at = skip_separators(text, value.end);
        all.push(MemberRange { key, value });
    }
    all
}

/// Returns the value of the last member with this key of the object at byte `at`.
pub(crate) fn member(text: &str, at: usize, key: &str) -> Option<Range<usize>> {
    let all = members(text, at).into_iter();
    let found = all.rev().find(|member| member.has_key(text, key));
    found.map(|member| member.value)
}

/// Returns the items of the array at byte `at`; none for another value.
pub(crate) fn items_at(text: &str, at: usize) -> Vec<Range<usize>> {
    let mut all = Vec::new();
    if text.as_bytes().get(at) != Some(&b'[') {
        return all;
    }
    let mut at = skip_separators(text, at + 1);
    while !matches!(text.as_bytes().get(at), None | Some(b']')) {
        let item = at..value_end(text, at);
        at = skip_separators(text, item.end);
        all.push(item);
    }
    all
}

/// Returns the byte after the value that begins at byte `at`.
pub(crate) fn value_end(text: &str, at: usize) -> usize {
    let bytes = text.as_bytes();
    let (mut at, mut depth) = (at, 0_usize);
    while let Some(&byte) = bytes.get(at) {
        at += 1;
        match byte {
            b'"' => at = string_end(bytes, at),
            b'{' | b'[' => depth += 1,
            b'}' | b']' => depth = depth.saturating_sub(1),
            b',' | b':' | b' ' | b'\t' | b'\r' | b'\n' => continue,
            // A number, `true`, `false` or `null`.
            _ => {
                let ends = |b: &u8| b",:]} \t\r\n".contains(b);
                at += bytes[at..].iter().take_while(|b| !ends(b)).count();
            }
        }
        if depth == 0 {
            return at;
        }
    }
    bytes.len()
}

/// Returns the byte after the quote that ends a string; `at` is inside of it.
fn string_end(bytes: &[u8], mut at: usize) -> usize {
    while let Some(&byte) = bytes.get(at) {
        at += 1;
        match byte {
            b'"' => return at,
            b'\\' => at += 1,
            _ => {}
        }
    }
    bytes.len()
}

/// Skips white space, commas and colons.
fn skip_separators(text: &str, at: usize) -> usize {
    let is_between = |b: &&u8| b",: \t\r\n".contains(b);
    at + text.as_bytes()[at.min(text.len())..]
        .iter()
        .take_while(is_between)
        .count()
}

/// Appends a valid JSON text without white space between its tokens.
pub(crate) fn push_compact(text: &str, out: &mut String) {
    let bytes = text.as_bytes();
    let mut from = 0;
    while from < bytes.len() {
        let at = match bytes[from] {
            b' ' | b'\t' | b'\r' | b'\n' => {
                from += 1;
                continue;
            }
            b'"' => string_end(bytes, from + 1),
            _ => {
                let ends = |b: &u8| b"\" \t\r\n".contains(b);
                from + bytes[from..].iter().take_while(|b| !ends(b)).count()
            }
        };
        out.push_str(&text[from..at]);
        from = at;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_members_and_items() {
        let text = r#" { "a\"b" : [1 , "]," ,{"c":-2e5}], "d":true ,"e" : {} }"#;
        let all = members(text, 1);
        let parts = |m: &MemberRange| (&text[m.key.clone()], &text[m.value.clone()]);
        let found: Vec<_> = all.iter().map(parts).collect();
        let list = r#"[1 , "]," ,{"c":-2e5}]"#;
        assert_eq!(
            found,
            [(r#""a\"b""#, list), ("\"d\"", "true"), ("\"e\"", "{}")]
        );
        assert!(all[0].has_key(text, "a\"b") && !all[0].has_key(text, "a"));
        let items = items_at(text, all[0].value.start);
        let items: Vec<_> = items.into_iter().map(|item| &text[item]).collect();
        assert_eq!(items, ["1", "\"],\"", "{\"c\":-2e5}"]);
        assert!(members(text, all[1].value.start).is_empty());
        assert!(items_at("[ ]", 0).is_empty() && members("{\n}", 0).is_empty());
    }

    #[test]
    fn compact_text_keeps_the_white_space_of_strings() {
        let mut out = String::new();
        push_compact("{ \"a b\" : [ 1.50,\n\ttrue, \" \\\" \" ] }", &mut out);
        assert_eq!(out, "{\"a b\":[1.50,true,\" \\\" \"]}");
    }
}
