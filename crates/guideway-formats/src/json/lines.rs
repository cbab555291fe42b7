//! Lines: finds the line of each element of the layout, from its first byte, and of each
//! diagnostic, from the path of its element such as `layouts[0].nodes[3].x`, by a second scan over
//! the text.

use std::collections::HashMap;
use std::ops::Range;

use guideway_layout::{Layout, LineIndex, Origin};

use super::scan::{items_at, member, offset_in};
use super::skeleton::Skeleton;

/// Returns the places in a document of the items of an array that its root object has, if it has
/// one.
pub(crate) fn root_items(document: &str, key: &str) -> Option<Vec<Range<usize>>> {
    let root = document.len() - document.trim_start().len();
    let array = member(document, root, key)?;
    document[array.clone()]
        .starts_with('[')
        .then(|| items_at(document, array.start))
}

/// Sets the line of each diagnostic to that of its element in the text of the file, or of the
/// innermost enclosing object that exists; elements are those of a part of the text, `document`.
/// Keeps the lines of the rows of the layout, unless it keeps the text.
pub(crate) fn find_lines(layout: &mut Layout, file: &str, document: Option<&str>) {
    let keeps_text = layout.provenance.text.is_some();
    if keeps_text && layout.diagnostics.is_empty() {
        return;
    }
    let lines = LineIndex::new(file);
    if !keeps_text {
        let spans = [
            &mut layout.paths.source,
            &mut layout.nodes.source,
            &mut layout.stations.source,
        ];
        spans
            .into_iter()
            .for_each(|spans| spans.keep_positions(&lines));
    }
    let document = document.and_then(|part| Some((part, offset_in(file, part)?)));
    let starts = document.map_or_else(Vec::new, |(part, before)| {
        let starts = starts(layout, part).into_iter();
        starts
            .map(|start| start.map(|start| before + start))
            .collect()
    });
    let mut starts = starts.into_iter();
    for diagnostic in layout.diagnostics.iter_mut() {
        let place = &mut diagnostic.place;
        let own = match place.origin {
            Some(Origin::Byte(byte)) => Some(byte),
            _ => None,
        };
        if let Some(byte) = starts.next().flatten().or(own) {
            *place = std::mem::take(place).at(lines.position(byte));
        }
        place.origin = place
            .origin
            .filter(|origin| !matches!(origin, Origin::Byte(_)));
    }
}

/// Sets the line of each diagnostic about a part of the skeleton of the file.
pub(crate) fn find_skeleton_lines(layout: &mut Layout, skeleton: &Skeleton) {
    let starts = starts(layout, &skeleton.text);
    for (diagnostic, start) in layout.diagnostics.iter_mut().zip(starts) {
        let place = &mut diagnostic.place;
        if let (None, Some(start)) = (place.line, start) {
            *place = std::mem::take(place).at(skeleton.position(start));
        }
    }
}

/// The first byte in a text of the part of its value to which an element such as `.nodes[3].x`
/// leads, or of the innermost part that exists.
pub(crate) fn offset_of(text: &str, element: &str) -> usize {
    let mut at = 0;
    for step in element.split(['.', '[']).skip(1) {
        let part = match step.strip_suffix(']').map(str::parse::<usize>) {
            Some(Ok(index)) => items_at(text, at).into_iter().nth(index),
            _ => member(text, at, step),
        };
        let Some(part) = part else { break };
        at = part.start;
    }
    at
}

/// The first byte of the element of each diagnostic.
fn starts(layout: &Layout, text: &str) -> Vec<Option<usize>> {
    let mut wanted = ElementTree::default();
    let elements = layout.diagnostics.iter().map(|d| &d.place.element);
    let nodes: Vec<usize> = elements.map(|element| wanted.add(element)).collect();
    if nodes.is_empty() {
        return Vec::new();
    }
    let mut scan = ElementScan {
        bytes: text.as_bytes(),
        at: 0,
        starts: vec![None; wanted.nodes.len()],
    };
    scan.value(ROOT, &wanted);
    // A diagnostic of the whole file has no line.
    scan.starts[ROOT] = None;
    let of_innermost = |node: usize| {
        let mut outwards = std::iter::successors(Some(node), |&node| wanted.nodes[node].parent);
        outwards.find_map(|node| scan.starts[node])
    };
    nodes.into_iter().map(of_innermost).collect()
}

/// A step from a value to a child value.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Step<'e> {
    Key(&'e str),
    Index(usize),
}

/// The elements to find, as a tree of steps from the root.
struct ElementTree<'e> {
    nodes: Vec<Node>,
    children: HashMap<(usize, Step<'e>), usize>,
}

const ROOT: usize = 0;

#[derive(Default)]
struct Node {
    parent: Option<usize>,
    has_children: bool,
}

impl Default for ElementTree<'_> {
    fn default() -> Self {
        Self {
            nodes: vec![Node::default()],
            children: HashMap::new(),
        }
    }
}

impl<'e> ElementTree<'e> {
    /// Adds an element such as `layouts[0].nodes[3].x`; returns its node.
    fn add(&mut self, element: &'e str) -> usize {
        let mut node = ROOT;
        for part in element.split(['.', '[']) {
            let step = match part.strip_suffix(']').map(str::parse) {
                Some(Ok(index)) => Step::Index(index),
                _ => Step::Key(part),
            };
            let new = self.nodes.len();
            let child = *self.children.entry((node, step)).or_insert(new);
            if child == new {
                self.nodes[node].has_children = true;
                self.nodes.push(Node {
                    parent: Some(node),
                    has_children: false,
                });
            }
            node = child;
        }
        node
    }
}

/// Scan over a text that was parsed before, so its syntax is valid.
struct ElementScan<'t> {
    bytes: &'t [u8],
    at: usize,
    /// First byte of each element of the tree that was found.
    starts: Vec<Option<usize>>,
}

impl<'t> ElementScan<'t> {
    /// Records the place of a wanted value, scans its children, and skips past it.
    fn value(&mut self, node: usize, wanted: &ElementTree<'_>) {
        let first = self.peek();
        // The last one of repeated keys is used.
        self.starts[node] = Some(self.at);
        let is_container = matches!(first, Some(b'{' | b'['));
        if !is_container || !wanted.nodes[node].has_children {
            return self.skip();
        }
        self.at += 1;
        let mut index = 0;
        while let Some(byte) = self.peek() {
            let step = match byte {
                b'}' | b']' => {
                    self.at += 1;
                    return;
                }
                b',' | b':' => {
                    self.at += 1;
                    continue;
                }
                _ if first == Some(b'[') => Step::Index(index),
                _ => {
                    let key = self.string();
                    self.peek();
                    self.at += 1;
                    self.peek();
                    Step::Key(key)
                }
            };
            index += 1;
            match wanted.children.get(&(node, step)) {
                Some(&child) => self.value(child, wanted),
                None => self.skip(),
            }
        }
    }

    /// Skips white space and returns the next byte.
    fn peek(&mut self) -> Option<u8> {
        while let Some(&byte) = self.bytes.get(self.at) {
            if !b" \t\r\n".contains(&byte) {
                return Some(byte);
            }
            self.at += 1;
        }
        None
    }

    /// Skips past a string and returns the text between its quotes.
    fn string(&mut self) -> &'t str {
        let start = self.at + 1;
        self.at = start;
        while let Some(&byte) = self.bytes.get(self.at) {
            match byte {
                b'\\' => self.at += 1,
                b'"' => break,
                _ => {}
            }
            self.at += 1;
        }
        let inner = self.bytes.get(start..self.at).unwrap_or_default();
        self.at += 1;
        std::str::from_utf8(inner).unwrap_or_default()
    }

    /// Skips past any value.
    fn skip(&mut self) {
        let mut depth = 0_usize;
        while let Some(byte) = self.peek() {
            match byte {
                b'"' => drop(self.string()),
                b'{' | b'[' => {
                    depth += 1;
                    self.at += 1;
                }
                b'}' | b']' => {
                    depth = depth.saturating_sub(1);
                    self.at += 1;
                }
                _ => self.at += 1,
            }
            let next = self.bytes.get(self.at);
            let continues = next.is_some_and(|b| !b", \t\r\n]}".contains(b));
            if depth == 0 && !continues {
                return;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use guideway_layout::{Code, Place};

    use super::*;

    fn line_of(element: &str, text: &str) -> Option<u32> {
        let mut layout = Layout::default();
        let place = || Place::element(element);
        layout
            .diagnostics
            .push(Code::Attribute, place, String::new, "");
        find_lines(&mut layout, text, Some(text));
        layout.diagnostics.iter().next().and_then(|d| d.place.line)
    }

    #[test]
    fn diagnostic_gets_the_line_of_its_element() {
        let text = "{\n\"a\": [1, \"}]\\\",{\",\n{\"b\": 3,\n\"c\":\n[4, [5,\n6]]}],\
                    \n\"d\": {\"e\": 1e5}}";
        for (element, line) in [
            ("a", Some(2)),
            ("a[1]", Some(2)),
            ("a[2]", Some(3)),
            ("a[2].b", Some(3)),
            ("a[2].c", Some(5)),
            ("a[2].c[1][1]", Some(6)),
            ("d.e", Some(7)),
            // A missing field has the line of its object.
            ("a[2].x.y", Some(3)),
            ("a[9]", Some(2)),
            ("the root", None),
            ("x", None),
        ] {
            assert_eq!(line_of(element, text), line, "{element}");
        }
    }

    #[test]
    fn repeated_key_gets_its_last_line() {
        assert_eq!(line_of("a.b", "{\"a\": {\"b\": 1,\n\"b\": 2}}"), Some(2));
    }
}
