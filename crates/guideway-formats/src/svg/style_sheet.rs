//! Reads style sheets as drawing programs write them: rules for an element, a class or an
//! identifier, in; declarations per element, out.
//!
//! Not based on `simplecss`, whose time grows with the square of the length. All rules of a
//! selector are folded into one declaration per property. Cost: O(length) to read; one hash lookup
//! and at most one declaration per property for each tag, class and identifier of an element.

use std::collections::HashMap;

use roxmltree::Node;

use super::cascade::{Cascade, INLINE};

/// The rules of all style sheets of a file.
#[derive(Default)]
pub(super) struct StyleSheet<'d> {
    /// The folded declarations per selector, such as `path`, `.road`, `path.road` or `#road7`.
    selectors: HashMap<&'d str, Cascade<'d>>,
    rule_count: usize,
    /// Number of unsupported selectors: combinators, pseudo-classes, attributes, at-rules.
    pub(super) ignored_selectors: usize,
    /// Names of style sheets in other files, which are not read.
    pub(super) in_other_files: Vec<&'d str>,
}

impl<'d> StyleSheet<'d> {
    /// Reads all `style` elements.
    pub(super) fn read(root: Node<'d, '_>) -> Self {
        let mut sheet = Self::default();
        let around = root.document().root();
        let instructions = around.children().filter_map(|node| node.pi());
        for instruction in instructions.filter(|pi| pi.target == "xml-stylesheet") {
            sheet.add_other_file(instruction.value.and_then(href));
        }
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
            if is_screen(head) && text[end..].starts_with('{') {
                // Its rules count as if they stood outside; its end is skipped as a lone brace.
                text = rest;
                continue;
            }
            if head.starts_with('@') || text[end..].starts_with(['}', ';']) {
                let is_block = text[end..].starts_with('{');
                text = if is_block { after_block(rest) } else { rest };
                self.ignored_selectors += usize::from(is_block);
                self.add_other_file(head.strip_prefix("@import").and_then(import));
                continue;
            }
            let length = rest.find('}').unwrap_or(rest.len());
            let mut rule = Cascade::default();
            rule.add_block(&rest[..length], 0, self.rule_count);
            self.rule_count += 1;
            text = rest.get(length + 1..).unwrap_or_default();
            for selector in head.split(',').map(str::trim) {
                match is_simple(selector) {
                    true => self.selectors.entry(selector).or_default().merge(&rule, 0),
                    false => self.ignored_selectors += 1,
                }
            }
        }
    }

    /// Adds the name of a style sheet, unless it is within this file.
    fn add_other_file(&mut self, name: Option<&'d str>) {
        /// Names that are reported; bounds the findings of a hostile file.
        const MAX_NAMES: usize = 8;
        let name = name.filter(|name| !name.starts_with('#') && !name.starts_with("data:"));
        if self.in_other_files.len() < MAX_NAMES {
            self.in_other_files.extend(name);
        }
    }

    /// The winning declarations of an element: of its attributes, the rules that match it and its
    /// attribute `style`.
    pub(super) fn cascade(&self, node: Node<'d, '_>) -> Cascade<'d> {
        /// Classes per element that are looked up; bounds the time of a hostile file.
        const MAX_CLASSES: usize = 64;
        let mut cascade = Cascade::default();
        let attributes = node.attributes();
        for attribute in attributes.filter(|a| a.namespace().is_none()) {
            cascade.add_attribute(attribute.name(), attribute.value());
        }
        let mut look_up = |specificity, selector: &str| {
            if let Some(rules) = self.selectors.get(selector) {
                cascade.merge(rules, specificity);
            }
        };
        if !self.selectors.is_empty() {
            let tag = node.tag_name().name();
            look_up(1, "*");
            look_up(2, tag);
            let classes = node.attribute("class").unwrap_or_default();
            for class in classes.split_ascii_whitespace().take(MAX_CLASSES) {
                look_up(3, &format!(".{class}"));
                look_up(4, &format!("{tag}.{class}"));
            }
            if let Some(id) = node.attribute("id") {
                look_up(5, &format!("#{id}"));
            }
        }
        cascade.add_block(node.attribute("style").unwrap_or_default(), INLINE, 0);
        cascade
    }
}

/// The reference in an instruction `xml-stylesheet`, such as `type="text/css" href="a.css"`.
fn href(instruction: &str) -> Option<&str> {
    let (_, rest) = instruction.split_once("href")?;
    quoted(rest.trim_start().strip_prefix('=')?.trim_start())
}

/// The name in a rule `@import`, such as `url("a.css") screen`.
fn import(rule: &str) -> Option<&str> {
    let rule = rule.trim();
    match rule.strip_prefix("url(") {
        Some(rest) => {
            let (name, _) = rest.split_once(')')?;
            Some(quoted(name.trim()).unwrap_or(name.trim()))
        }
        None => quoted(rule),
    }
}

/// The content of the quotes at the start of a text.
fn quoted(text: &str) -> Option<&str> {
    let quote = text.chars().next().filter(|c| matches!(c, '"' | '\''))?;
    let (content, _) = text[1..].split_once(quote)?;
    Some(content)
}

/// Tells if a head is that of rules for every screen.
fn is_screen(head: &str) -> bool {
    let query = head.strip_prefix("@media").map(str::trim);
    query.is_some_and(|query| ["", "all", "screen", "only screen"].contains(&query))
}

/// Tells if a selector is an element, a class, an element with a class, or an identifier.
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
    use crate::svg::cascade::Property;

    fn strokes(sheet: &str, element: &str) -> (Option<String>, usize) {
        let document = roxmltree::Document::parse(element).unwrap();
        let mut rules = StyleSheet::default();
        rules.add(sheet);
        let cascade = rules.cascade(document.root_element());
        let stroke = cascade.value(Property::Stroke);
        (stroke.map(str::to_owned), rules.ignored_selectors)
    }

    #[test]
    fn the_most_specific_and_then_the_last_rule_wins() {
        for (sheet, expected) in [
            ("", "white"),
            ("*{stroke:red}", "red"),
            ("path { stroke: red } * { stroke: blue }", "red"),
            (
                "/* a note */ .a, .b { fill : none ;; stroke:red } path{stroke:blue}",
                "red",
            ),
            (".b{stroke:blue} .c{stroke:green} .b{stroke:red}", "red"),
            (".b{stroke:blue} .b{stroke:red} .c{stroke:green}", "green"),
            ("path.b{stroke:red} .c{stroke:blue}", "red"),
            (" <!-- #p{stroke:red} --> path.b{stroke:blue}", "red"),
            ("*{stroke:red!important} #p{stroke:blue}", "red"),
            (
                "@media screen { .b{stroke:blue} .b{stroke:red} } *{stroke:green}",
                "red",
            ),
            (".b{stroke:red} .b{stroke:nonsense}", "red"),
        ] {
            let (found, ignored) = strokes(sheet, "<path id='p' class='b c' stroke='white'/>");
            assert_eq!((found.as_deref(), ignored), (Some(expected), 0), "{sheet}");
        }
    }

    #[test]
    fn counts_and_skips_unsupported_selectors() {
        let sheet = "@import 'x'; @media print { .a { stroke: red } } \
            g .a, a:hover, [x] { stroke: red } .a{stroke:blue}";
        let expected = (Some("blue".to_owned()), 4);
        assert_eq!(strokes(sheet, "<g class='a'/>"), expected);
        for broken in [
            "}",
            ".a {",
            ".a",
            "{}",
            "/*",
            "@media {",
            "} .b {stroke:x",
            "<!-",
            ".",
        ] {
            strokes(broken, "<g class='a'/>");
        }
    }
}
