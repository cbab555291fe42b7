//! List edits: remove parts of an array or object of a text and append others, each with one comma.

use std::ops::Range;

use super::scan::items_at;
use super::splice::Splices;
use super::style::line_indent;
use super::tree::Tree;

/// Edits of an array of a text.
pub(crate) struct ArrayEdit<'a> {
    at: usize,
    items: Vec<Range<usize>>,
    removed: Vec<bool>,
    added: Vec<Tree<'a>>,
}

impl<'a> ArrayEdit<'a> {
    /// Makes an edit of the array at byte `at`.
    pub(crate) fn new(text: &str, at: usize) -> Self {
        let items = items_at(text, at);
        Self {
            at,
            removed: vec![false; items.len()],
            items,
            added: Vec::new(),
        }
    }

    /// The items of the array.
    pub(crate) fn items(&self) -> &[Range<usize>] {
        &self.items
    }

    /// Removes an item.
    pub(crate) fn remove(&mut self, item: usize) {
        self.removed[item] = true;
    }

    /// Appends an item.
    pub(crate) fn push(&mut self, item: Tree<'a>) {
        self.added.push(item);
    }

    /// Adds the edits to the splices of the text.
    pub(crate) fn apply(self, splices: &mut Splices<'_>) {
        let text = splices.text();
        let added = match self.items.last() {
            None => vec![
                splices
                    .style()
                    .render_first(&self.added, line_indent(text, self.at)),
            ],
            Some(last) => {
                let indent = line_indent(text, last.start);
                let neighbor = Some(&text[last.clone()]);
                let render = |item: &Tree<'_>| splices.style().render(item, indent, neighbor);
                self.added.iter().map(render).collect()
            }
        };
        let edit = ListEdit {
            open: self.at,
            items: self.items,
            removed: self.removed,
            added: if self.added.is_empty() {
                Vec::new()
            } else {
                added
            },
        };
        edit.apply(splices);
    }
}

/// Edits of the parts of an array or object.
pub(super) struct ListEdit {
    /// Byte of the opening bracket.
    pub(super) open: usize,
    /// Items, or members with their keys.
    pub(super) items: Vec<Range<usize>>,
    pub(super) removed: Vec<bool>,
    /// Rendered parts; for an empty list, one text with the white space around it.
    pub(super) added: Vec<String>,
}

impl ListEdit {
    pub(super) fn apply(self, splices: &mut Splices<'_>) {
        let Self {
            open,
            items,
            removed,
            added,
        } = self;
        let text = splices.text();
        let Some(last) = items.last().cloned() else {
            if !added.is_empty() {
                let space = text[open + 1..].len() - text[open + 1..].trim_start().len();
                splices.replace(open + 1..open + 1 + space, added.concat());
            }
            return;
        };
        let before_first = &text[open + 1..items[0].start];
        let separator = match &items[..] {
            [.., before, last] => text[before.end..last.start].to_owned(),
            _ => format!(",{before_first}"),
        };
        if removed.iter().all(|&removed| removed) {
            match added.is_empty() {
                true => {
                    let after = &text[last.end..];
                    let space = after.len() - after.trim_start().len();
                    splices.replace(open + 1..last.end + space, String::new());
                }
                false => splices.replace(items[0].start..last.end, added.join(&separator)),
            }
            return;
        }
        let mut item = 0;
        while item < items.len() {
            let run = removed[item..].iter().take_while(|&&r| r).count();
            if run == 0 {
                item += 1;
                continue;
            }
            let range = match items.get(item + run) {
                Some(next) => items[item].start..next.start,
                None => items[item - 1].end..last.end,
            };
            splices.replace(range, String::new());
            item += run;
        }
        if !added.is_empty() {
            let text = added.iter().map(|item| format!("{separator}{item}"));
            splices.replace(last.end..last.end, text.collect());
        }
    }
}
