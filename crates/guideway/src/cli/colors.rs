//! Colors of a report on a terminal: the words that begin its lines, such as `error:` and `hint:`.

/// The words and their colors (ECMA-48, select graphic rendition): bold red, yellow, blue, green.
const WORDS: [(&str, &str); 5] = [
    ("error", "\x1b[1;31m"),
    ("warning", "\x1b[1;33m"),
    ("info", "\x1b[1;34m"),
    ("note", "\x1b[1;34m"),
    ("hint", "\x1b[1;32m"),
];
const END: &str = "\x1b[0m";

/// Colors the first word of each line if it is a severity or a hint, with a colon, or behind a
/// count: `error: node-gap (2)`, `12  warning kink: ...`.
pub(crate) fn paint(text: &str) -> String {
    let mut painted = String::with_capacity(text.len());
    for line in text.split_inclusive('\n') {
        let is_before = |c: char| c == ' ' || c == ',' || c.is_ascii_digit();
        let rest = line.trim_start_matches(is_before);
        let before = &line[..line.len() - rest.len()];
        let end = if before.trim().is_empty() { ':' } else { ' ' };
        let found = WORDS.iter().find_map(|(word, color)| {
            let after = rest.strip_prefix(word)?;
            after.starts_with(end).then_some((word, color, after))
        });
        painted += before;
        match found {
            Some((word, color, after)) => {
                for part in [*color, *word, END, after] {
                    painted += part;
                }
            }
            None => painted += rest,
        }
    }
    painted
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_that_begin_a_line_have_colors() {
        let text = "error: kink (1)\n  - path \"a\": info\n    hint: do\n    \
                    1,234  warning kink: x\n";
        let painted = paint(text);
        assert_eq!(
            painted,
            "\x1b[1;31merror\x1b[0m: kink (1)\n  - path \"a\": info\n    \
             \x1b[1;32mhint\x1b[0m: do\n    \
             1,234  \x1b[1;33mwarning\x1b[0m kink: x\n"
        );
        for plain in [
            "errors: 2\n",
            "no hint: here",
            "12 errors",
            "error",
            "",
            "\n\n",
        ] {
            assert_eq!(paint(plain), plain);
        }
    }
}
