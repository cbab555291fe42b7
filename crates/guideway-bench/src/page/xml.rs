//! Escapes text for HTML and XML markup.

/// Escapes text for an element, or for an attribute in double quotes. Replaces forbidden
/// characters.
pub fn escape(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => safe.push_str("&amp;"),
            '<' => safe.push_str("&lt;"),
            '>' => safe.push_str("&gt;"),
            '"' => safe.push_str("&quot;"),
            // Characters that XML forbids, even escaped.
            '\u{fffe}' | '\u{ffff}' => safe.push('\u{fffd}'),
            c if c.is_control() && !c.is_ascii_whitespace() => safe.push('\u{fffd}'),
            '\u{c}' => safe.push(' '),
            c => safe.push(c),
        }
    }
    safe
}

/// An element with escaped text.
pub fn element(name: &str, text: &str) -> String {
    format!("<{name}>{}</{name}>\n", escape(text))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn escapes_any_text() {
        let odd = "<b a=\"1\">&amp;\u{1b}\u{0}\u{c}\u{ffff}\u{85}é\n";
        let markup = format!("<p t=\"{0}\">{0}</p>", escape(odd));
        let document = roxmltree::Document::parse(&markup).expect("well-formed");
        let text = document.root_element().text().unwrap();
        assert_eq!(text, "<b a=\"1\">&amp;\u{fffd}\u{fffd} \u{fffd}\u{fffd}é\n");
    }
}
