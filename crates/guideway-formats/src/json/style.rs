//! Style of a JSON text: line breaks, indentation and spaces, to render new values as their
//! neighbors are written.

use super::scan::{items_at, members};
use super::tree::Tree;

/// Style of a text.
#[derive(Debug, PartialEq)]
pub(crate) struct Style {
    /// Line break between members; empty for a text whose objects are on one line.
    newline: &'static str,
    /// Indentation of a level.
    unit: String,
}

/// Spaces of values on one line.
#[derive(Clone, Copy)]
struct Spaces {
    colon: &'static str,
    comma: &'static str,
    /// Space after an opening brace and before a closing one.
    brace: &'static str,
}

impl Style {
    /// Detects the style of a text from its root object.
    pub(crate) fn of(text: &str) -> Self {
        let first = text.find('{').map_or("", |at| &text[at + 1..]);
        let space = &first[..first.len() - first.trim_start().len()];
        let unit = space.rsplit_once('\n').map(|(_, unit)| unit.to_owned());
        let newline = match &unit {
            Some(unit) if !unit.is_empty() && space.contains('\r') => "\r\n",
            Some(unit) if !unit.is_empty() => "\n",
            _ => "",
        };
        Self {
            newline,
            unit: unit.unwrap_or_default(),
        }
    }

    /// Renders a value for a line with this indentation. Parts of a multi-line value are on one
    /// line where those of the template, a similar value of the text, are.
    pub(crate) fn render(&self, tree: &Tree<'_>, indent: &str, template: Option<&str>) -> String {
        let mut out = String::new();
        self.push(tree, indent, template, &mut out);
        out
    }

    /// Renders a member of an object whose members have this indentation.
    pub(crate) fn render_member(
        &self,
        key: &str,
        tree: &Tree<'_>,
        indent: &str,
        siblings: &str,
    ) -> String {
        let mut out = Tree::Text(key.into()).to_text();
        out.push_str(spaces(siblings).colon);
        let is_on_one_line = !siblings.contains('\n');
        let template = is_on_one_line.then_some(siblings);
        self.push(tree, indent, template, &mut out);
        out
    }

    /// Renders the items of a list that is empty, with the white space around them.
    pub(crate) fn render_first(&self, items: &[Tree<'_>], indent: &str) -> String {
        let inner = format!("{}{indent}{}", self.newline, self.unit);
        let items = items.iter().map(|item| {
            let item = self.render(item, &format!("{indent}{}", self.unit), None);
            format!("{inner}{item}")
        });
        let items: Vec<String> = items.collect();
        match self.newline {
            "" => items.join(", "),
            newline => format!("{}{newline}{indent}", items.join(",")),
        }
    }

    fn push(&self, tree: &Tree<'_>, indent: &str, template: Option<&str>, out: &mut String) {
        let opened;
        let tree = match tree {
            Tree::Raw(text) if text.starts_with(['{', '[']) => {
                opened = Tree::opened(text);
                &opened
            }
            tree => tree,
        };
        let (open, close, count) = match tree {
            Tree::Object(members) => ('{', '}', members.len()),
            Tree::Array(items) => ('[', ']', items.len()),
            scalar => return out.push_str(&scalar.to_text()),
        };
        let is_on_one_line = match template {
            Some(text) => !text.contains('\n'),
            None => self.newline.is_empty(),
        };
        let spaces = template.map_or(DEFAULT_SPACES, spaces);
        let inner = match is_on_one_line {
            true => String::new(),
            false => format!("{indent}{}", self.unit),
        };
        let newline = if self.newline.is_empty() {
            "\n"
        } else {
            self.newline
        };
        out.push(open);
        let brace = if is_on_one_line && open == '{' && count > 0 {
            spaces.brace
        } else {
            ""
        };
        out.push_str(brace);
        for i in 0..count {
            if i > 0 {
                out.push_str(if is_on_one_line { spaces.comma } else { "," });
            }
            if !is_on_one_line {
                out.push_str(newline);
                out.push_str(&inner);
            }
            match tree {
                Tree::Object(members) => {
                    let (key, value) = &members[i];
                    out.push_str(&Tree::Text(key.as_ref().into()).to_text());
                    out.push_str(spaces.colon);
                    let template = self.part(template, |text| member_of(text, key));
                    self.push(value, &inner, template, out);
                }
                Tree::Array(items) => {
                    let template = self.part(template, first_item);
                    self.push(&items[i], &inner, template, out);
                }
                _ => {}
            }
        }
        out.push_str(brace);
        if !is_on_one_line && count > 0 {
            out.push_str(newline);
            out.push_str(indent);
        }
        out.push(close);
    }

    /// The part of a template; a template on one line is that of its parts too.
    fn part<'t>(
        &self,
        template: Option<&'t str>,
        part: impl Fn(&'t str) -> Option<&'t str>,
    ) -> Option<&'t str> {
        let text = template?;
        if text.contains('\n') {
            part(text)
        } else {
            Some(text)
        }
    }
}

fn member_of<'t>(text: &'t str, key: &str) -> Option<&'t str> {
    let all = members(text, 0).into_iter();
    let mut found = all.filter(|member| member.has_key(text, key));
    found.next().map(|member| &text[member.value])
}

fn first_item(text: &str) -> Option<&str> {
    let first = items_at(text, 0).into_iter().next();
    first.map(|item| &text[item])
}

const DEFAULT_SPACES: Spaces = Spaces {
    colon: ": ",
    comma: ", ",
    brace: "",
};

/// Detects the spaces of a text: those after its colons, commas and braces.
fn spaces(text: &str) -> Spaces {
    let colon = match text.find("\":") {
        Some(at) if !text[at + 2..].starts_with([' ', '\n', '\r']) => ":",
        _ => ": ",
    };
    let is_tight = text.contains(",\"") || text.contains(",{");
    Spaces {
        colon,
        comma: if is_tight { "," } else { ", " },
        brace: if text.contains("{ \"") { " " } else { "" },
    }
}

/// Returns the indentation of the line of byte `at`.
pub(super) fn line_indent(text: &str, at: usize) -> &str {
    let start = text[..at].rfind('\n').map_or(0, |newline| newline + 1);
    let line = &text[start..];
    &line[..line.len() - line.trim_start_matches([' ', '\t']).len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tree() -> Tree<'static> {
        Tree::Raw(r#"{"id":"a","at":{"x":1,"y":2},"list":[[1],[]]}"#.into())
    }

    #[test]
    fn renders_as_the_neighbor() {
        let style = Style::of("{\r\n  \"a\": 1}");
        assert_eq!((style.newline, style.unit.as_str()), ("\r\n", "  "));
        let neighbor = "{\r\n    \"id\": 0,\r\n    \"at\": {\"x\": 3, \"y\": 4}}";
        let text = style.render(&tree(), "  ", Some(neighbor));
        assert_eq!(
            text,
            "{\r\n    \"id\": \"a\",\r\n    \"at\": {\"x\": 1, \"y\": 2},\r\n    \
             \"list\": [\r\n      [\r\n        1\r\n      ],\r\n      []\r\n    ]\r\n  }"
        );
        assert_eq!(
            style.render(&tree(), "", Some(r#"{"id":0,"b":1}"#)),
            tree().to_text()
        );
        let one_line = Style::of("{\"a\": 1}");
        assert_eq!(
            one_line.render(&tree(), "", None),
            r#"{"id": "a", "at": {"x": 1, "y": 2}, "list": [[1], []]}"#
        );
    }

    #[test]
    fn line_indent_is_that_of_the_line() {
        let text = "{\n\t  \"a\": 1}";
        assert_eq!(line_indent(text, 8), "\t  ");
        assert_eq!(line_indent(text, 0), "");
    }
}
