//! Reads style sheets as drawing programs write them: rules for an element, a class or an
//! identifier, in; declarations per element, out.
//!
//! Not based on `simplecss`, whose time grows with the square of the length. Cost: O(length) to
//! read, one hash lookup per tag, class and identifier of an element.

use std::collections::HashMap;

use roxmltree::Node;

/// The rules of all style sheets of a file.
#[derive(Default)]
pub(super) struct StyleSheet<'d> {
    /// The declarations of every rule, in file order.
    rules: Vec<&'d str>,
    /// Indices into `rules` per selector, such as `path`, `.road`, `path.road` or `#road7`.
    selectors: HashMap<&'d str, Vec<usize>>,
    /// Number of unsupported selectors: combinators, pseudo-classes, attributes, at-rules.
    pub(super) ignored_selectors: usize,
}

impl<'d> StyleSheet<'d> {
    /// Reads all `style` elements.
    pub(super) fn read(root: Node<'d, '_>) -> Self {
        let mut sheet = Self::default();
        for style in root.descendants().filter(|node| node.has_tag_name("style")) {
            sheet.add(style.text().unwrap_or_default());
        }
        sheet
    }

    fn add(&mut self, mut text: &'d str) {
        loop {
            text = skip_blank(text);
            let Some(end) = text.find(['{', ';', '}']) else {
                return;
            };
            let (head, rest) = (text[..end].trim(), &text[end + 1..]);
            if head.starts_with('@') || text[end..].starts_with(['}', ';']) {
                let is_block = text[end..].starts_with('{');
                text = if is_block { after_block(rest) } else { rest };
                self.ignored_selectors += usize::from(is_block);
                continue;
            }
            let length = rest.find('}').unwrap_or(rest.len());
            self.rules.push(&rest[..length]);
            text = rest.get(length + 1..).unwrap_or_default();
            for selector in head.split(',').map(str::trim) {
                match is_simple(selector) {
                    true => self
                        .selectors
                        .entry(selector)
                        .or_default()
                        .push(self.rules.len() - 1),
                    false => self.ignored_selectors += 1,
                }
            }
        }
    }

    /// The declarations of all rules that match an element, by rising specificity.
    pub(super) fn matching(&self, node: Node<'_, '_>) -> impl Iterator<Item = &'d str> {
        /// Classes per element that are looked up; bounds the time of a hostile file.
        const MAX_CLASSES: usize = 64;
        let mut found: Vec<(u8, usize)> = Vec::new();
        let mut look_up = |specificity, selector: &str| {
            let rules = self.selectors.get(selector).into_iter().flatten();
            found.extend(rules.map(|&rule| (specificity, rule)));
        };
        if !self.rules.is_empty() {
            let tag = node.tag_name().name();
            look_up(0, "*");
            look_up(1, tag);
            let classes = node.attribute("class").unwrap_or_default();
            for class in classes.split_ascii_whitespace().take(MAX_CLASSES) {
                look_up(2, &format!(".{class}"));
                look_up(3, &format!("{tag}.{class}"));
            }
            if let Some(id) = node.attribute("id") {
                look_up(4, &format!("#{id}"));
            }
            found.sort_unstable();
        }
        found.into_iter().map(|(_, rule)| self.rules[rule])
    }
}

/// Splits declarations into names and values. Ignores `!important`.
pub(super) fn declarations(text: &str) -> impl Iterator<Item = (&str, &str)> {
    let pairs = text.split(';').filter_map(|part| part.split_once(':'));
    pairs.map(|(name, value)| {
        let value = value.split('!').next().unwrap_or(value);
        // A comment may precede the name.
        let name = name.rsplit("*/").next().unwrap_or(name);
        (name.trim(), value.trim())
    })
}

/// Whether a selector is an element, a class, an element with a class, or an identifier.
fn is_simple(selector: &str) -> bool {
    let is_name = |c: char| c.is_alphanumeric() || "-_.#*".contains(c);
    !selector.is_empty()
        && selector.chars().all(is_name)
        && selector.matches(['.', '#']).count() < 2
}

/// Strips leading white space, comments and the HTML comment marks for old browsers.
fn skip_blank(mut text: &str) -> &str {
    loop {
        text = text.trim_start();
        let end = match () {
            () if text.starts_with("/*") => "*/",
            () if text.starts_with("<!--") => "--",
            () if text.starts_with("-->") => ">",
            () => return text,
        };
        let found = text
            .get(2..)
            .and_then(|rest| Some(rest.find(end)? + 2 + end.len()));
        text = found.map_or("", |at| &text[at..]);
    }
}

/// The text after the end of a block, which may contain blocks.
fn after_block(text: &str) -> &str {
    let mut depth = 1_usize;
    for (at, brace) in text.match_indices(['{', '}']) {
        depth = if brace == "{" { depth + 1 } else { depth - 1 };
        if depth == 0 {
            return &text[at + 1..];
        }
    }
    ""
}

#[cfg(test)]
mod tests {
    use super::*;

    fn matching(sheet: &str, element: &str) -> (Vec<String>, usize) {
        let document = roxmltree::Document::parse(element).unwrap();
        let mut rules = StyleSheet::default();
        rules.add(sheet);
        let node = document.root_element();
        let all = rules.matching(node).flat_map(declarations);
        (
            all.map(|(n, v)| format!("{n}={v}")).collect(),
            rules.ignored_selectors,
        )
    }

    #[test]
    fn orders_rules_by_specificity() {
        let sheet = "/* a note */ #p{stroke:red} .a, .b { fill : none ;; stroke:blue!important }
            path { stroke:black; /* b */ fill: url(#x) } path.b{ opacity:.5 } <!-- --> *{fill:red}";
        let (found, ignored) = matching(sheet, "<path id='p' class='b c'/>");
        let expected = [
            "fill=red",
            "stroke=black",
            "fill=url(#x)",
            "fill=none",
            "stroke=blue",
            "opacity=.5",
            "stroke=red",
        ];
        assert_eq!(
            (found.as_slice(), ignored),
            (expected.map(String::from).as_slice(), 0)
        );
    }

    #[test]
    fn counts_and_skips_unsupported_selectors() {
        let sheet = "@import 'x'; @media print { .a { fill: red } } \
            g .a, a:hover, [x] { fill: red } .a{fill:blue}";
        assert_eq!(
            matching(sheet, "<g class='a'/>"),
            (vec!["fill=blue".to_owned()], 4)
        );
        for broken in [
            "}",
            ".a {",
            ".a",
            "{}",
            "/*",
            "@media {",
            "} .b {fill:x",
            "<!-",
            ".",
        ] {
            matching(broken, "<g class='a'/>");
        }
    }
}
