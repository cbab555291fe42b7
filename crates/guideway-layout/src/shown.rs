//! Names of files and texts from files, as they are shown: without characters that steer a terminal
//! or reverse the direction of writing.

use std::borrow::Cow;
use std::path::Path;

/// The name of a file for messages, on one line: see [`shown_text`].
pub fn shown_path(path: &Path) -> String {
    shown_text(&path.to_string_lossy()).into_owned()
}

/// A text for messages: characters that [`is_hidden`] become escapes such as `\n` and `\u{1b}`.
pub fn shown_text(text: &str) -> Cow<'_, str> {
    escaped(text, is_hidden)
}

/// A text of several lines for a terminal: as [`shown_text`], with line breaks and tabs.
pub fn shown_lines(text: &str) -> Cow<'_, str> {
    escaped(text, |c| is_hidden(c) && !matches!(c, '\n' | '\t'))
}

fn escaped(text: &str, is_escaped: impl Fn(char) -> bool) -> Cow<'_, str> {
    if !text.contains(&is_escaped) {
        return text.into();
    }
    let mut shown = String::with_capacity(text.len() + 8);
    for c in text.chars() {
        match is_escaped(c) {
            true => shown.extend(c.escape_default()),
            false => shown.push(c),
        }
    }
    shown.into()
}

/// Returns `true` if a character is not shown but changes how others are: control characters, line
/// separators, and the marks, embeddings, overrides and isolates of bidirectional text.
pub fn is_hidden(c: char) -> bool {
    c.is_control()
        || matches!(
            c,
            '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}'
        )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn escapes_what_steers_a_terminal_or_reverses_text() {
        for (name, shown) in [
            ("hall 2/plan é.json", "hall 2/plan é.json"),
            ("a\u{1b}[2Jb", r"a\u{1b}[2Jb"),
            ("a\nerror: b", r"a\nerror: b"),
            ("a\u{9b}31mb\u{7f}", r"a\u{9b}31mb\u{7f}"),
            ("nosj\u{202e}.exe", r"nosj\u{202e}.exe"),
            ("\u{2067}a\u{2069}\u{200f}", r"\u{2067}a\u{2069}\u{200f}"),
        ] {
            assert_eq!(shown_path(Path::new(name)), shown);
        }
        assert_eq!(shown_lines("a\tb\n\u{1b}c"), "a\tb\n\\u{1b}c");
    }
}
