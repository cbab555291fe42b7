//! Text inside of markup.

/// Text that stays text, in an element or in an attribute between double quotes.
pub(super) fn escape(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => safe.push_str("&amp;"),
            '<' => safe.push_str("&lt;"),
            '>' => safe.push_str("&gt;"),
            '"' => safe.push_str("&quot;"),
            // What XML takes nowhere, not even escaped.
            '\u{fffe}' | '\u{ffff}' => safe.push('\u{fffd}'),
            c if c.is_control() && !c.is_ascii_whitespace() => safe.push('\u{fffd}'),
            '\u{c}' => safe.push(' '),
            c => safe.push(c),
        }
    }
    safe
}

/// An element with text in it.
pub(super) fn element(name: &str, text: &str) -> String {
    format!("<{name}>{}</{name}>\n", escape(text))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn any_text_is_text_in_markup() {
        let odd = "<b a=\"1\">&amp;\u{1b}\u{0}\u{c}\u{ffff}\u{85}é\n";
        let markup = format!("<p t=\"{0}\">{0}</p>", escape(odd));
        let document = roxmltree::Document::parse(&markup).expect("well-formed");
        let text = document.root_element().text().unwrap();
        assert_eq!(text, "<b a=\"1\">&amp;\u{fffd}\u{fffd} \u{fffd}\u{fffd}é\n");
    }
}
