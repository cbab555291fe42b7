//! Style sheets, as drawing programs write them: rules for an element, a class or an identifier.
//!
//! Read here and not by `simplecss`, which takes a time that grows with the square of the length.

use std::collections::HashMap;

use roxmltree::Node;

/// The rules of a file.
#[derive(Default)]
pub(super) struct Sheet<'d> {
    /// Declarations of every rule, in the order of the file.
    rules: Vec<&'d str>,
    /// The rules of a selector, such as `path`, `.road`, `path.road` or `#road7`.
    selectors: HashMap<&'d str, Vec<usize>>,
    /// How many selectors are not read: those of several parts, of states, of attributes.
    pub(super) left_out: usize,
}

impl<'d> Sheet<'d> {
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
                self.left_out += usize::from(is_block);
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
                    false => self.left_out += 1,
                }
            }
        }
    }

    /// The declarations that the rules give an element, the weakest rule first.
    pub(super) fn of(&self, node: Node<'_, '_>) -> impl Iterator<Item = &'d str> {
        /// Most classes of one element that are looked for.
        const MOST_CLASSES: usize = 64;
        let mut found: Vec<(u8, usize)> = Vec::new();
        let mut look = |strength, selector: &str| {
            let rules = self.selectors.get(selector).into_iter().flatten();
            found.extend(rules.map(|&rule| (strength, rule)));
        };
        if !self.rules.is_empty() {
            let tag = node.tag_name().name();
            look(0, "*");
            look(1, tag);
            let classes = node.attribute("class").unwrap_or_default();
            for class in classes.split_ascii_whitespace().take(MOST_CLASSES) {
                look(2, &format!(".{class}"));
                look(3, &format!("{tag}.{class}"));
            }
            if let Some(id) = node.attribute("id") {
                look(4, &format!("#{id}"));
            }
            found.sort_unstable();
        }
        found.into_iter().map(|(_, rule)| self.rules[rule])
    }
}

/// The names and values of a list of declarations. Which ones are `!important` does not count.
pub(super) fn declarations(text: &str) -> impl Iterator<Item = (&str, &str)> {
    let pairs = text.split(';').filter_map(|part| part.split_once(':'));
    pairs.map(|(name, value)| {
        let value = value.split('!').next().unwrap_or(value);
        // A comment may be before a name.
        let name = name.rsplit("*/").next().unwrap_or(name);
        (name.trim(), value.trim())
    })
}

/// Whether a selector is an element, a class, both, or an identifier.
fn is_simple(selector: &str) -> bool {
    let is_name = |c: char| c.is_alphanumeric() || "-_.#*".contains(c);
    !selector.is_empty()
        && selector.chars().all(is_name)
        && selector.matches(['.', '#']).count() < 2
}

/// A text without spaces, comments and marks of old browsers at its beginning.
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

/// What follows a block with blocks inside.
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

    fn of(sheet: &str, element: &str) -> (Vec<String>, usize) {
        let document = roxmltree::Document::parse(element).unwrap();
        let mut rules = Sheet::default();
        rules.add(sheet);
        let node = document.root_element();
        let all = rules.of(node).flat_map(declarations);
        (
            all.map(|(n, v)| format!("{n}={v}")).collect(),
            rules.left_out,
        )
    }

    #[test]
    fn stronger_rules_come_later() {
        let sheet = "/* a note */ #p{stroke:red} .a, .b { fill : none ;; stroke:blue!important }
            path { stroke:black; /* b */ fill: url(#x) } path.b{ opacity:.5 } <!-- --> *{fill:red}";
        let (found, left_out) = of(sheet, "<path id='p' class='b c'/>");
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
            (found.as_slice(), left_out),
            (expected.map(String::from).as_slice(), 0)
        );
    }

    #[test]
    fn what_is_not_read_is_counted_and_passed_over() {
        let sheet = "@import 'x'; @media print { .a { fill: red } } g .a, a:hover, [x] { fill: red } .a{fill:blue}";
        assert_eq!(
            of(sheet, "<g class='a'/>"),
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
            of(broken, "<g class='a'/>");
        }
    }
}
