//! Lines: finds the line of each element of the layout, from its first byte, and of each
//! diagnostic, from the path of its element such as `layouts[0].nodes[3].x`, by a second scan over
//! the text.

use std::borrow::Cow;
use std::collections::HashMap;
use std::ops::Range;

use guideway_layout::{Diagnostic, Layout, LineIndex, Origin, TextPosition};

use super::scan::{items_at, member, offset_in, unescaped};
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
        let starts = starts_of_findings(layout, part).into_iter();
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
    let starts = starts_of_findings(layout, &skeleton.text);
    for (diagnostic, start) in layout.diagnostics.iter_mut().zip(starts) {
        let place = &mut diagnostic.place;
        if let (None, Some(start)) = (place.line, start) {
            *place = std::mem::take(place).at(skeleton.position(start));
        }
    }
}

/// Sets the place of findings about parts of one value, whose element is `of` and whose text begins
/// at `position`: that of the innermost part that exists. One scan finds all of them.
pub(crate) fn find_lines_within<'d>(
    findings: impl Iterator<Item = &'d mut Diagnostic>,
    of: &str,
    text: &str,
    position: TextPosition,
) {
    let findings: Vec<&mut Diagnostic> = findings.collect();
    let steps = |finding: &&mut Diagnostic| {
        let within = finding.place.element.strip_prefix(of);
        within.unwrap_or_default().to_owned()
    };
    let elements: Vec<String> = findings.iter().map(steps).collect();
    let starts = starts(elements.iter().map(|within| steps_of(within).skip(1)), text);
    let starts = starts.into_iter().map(Option::unwrap_or_default);
    let mut in_order: Vec<(usize, &mut Diagnostic)> = starts.zip(findings).collect();
    in_order.sort_by_key(|&(start, _)| start);
    let (mut at, mut position) = (0, position);
    for (start, finding) in in_order {
        position = position.after(&text.as_bytes()[at..start]);
        at = start;
        let place = &mut finding.place;
        *place = std::mem::take(place).at(position);
        place.origin = None;
    }
}

/// The first byte of the element of each diagnostic; none for one of the whole text.
fn starts_of_findings(layout: &Layout, text: &str) -> Vec<Option<usize>> {
    let findings = layout.diagnostics.iter();
    starts(
        findings.map(|finding| steps_of(&finding.place.element)),
        text,
    )
}

/// The first byte of each of some elements, or of the innermost enclosing one that exists but for
/// the whole text.
fn starts<'e, S: Iterator<Item = Step<'e>>>(
    elements: impl Iterator<Item = S>,
    text: &str,
) -> Vec<Option<usize>> {
    let mut wanted = ElementTree::default();
    let nodes: Vec<usize> = elements.map(|element| wanted.add(element)).collect();
    if nodes.is_empty() {
        return Vec::new();
    }
    let mut scan = ElementScan {
        text,
        bytes: text.as_bytes(),
        at: 0,
        starts: vec![None; wanted.nodes.len()],
    };
    scan.value(ROOT, &wanted);
    scan.starts[ROOT] = None;
    let of_innermost = |node: usize| {
        let mut outwards = std::iter::successors(Some(node), |&node| wanted.nodes[node].parent);
        outwards.find_map(|node| scan.starts[node])
    };
    nodes.into_iter().map(of_innermost).collect()
}

/// The steps of an element such as `layouts[0].nodes[3].x`.
fn steps_of(element: &str) -> impl Iterator<Item = Step<'_>> {
    element
        .split(['.', '['])
        .map(|part| match part.strip_suffix(']').map(str::parse) {
            Some(Ok(index)) => Step::Index(index),
            _ => Step::Key(Cow::Borrowed(part)),
        })
}

/// A step from a value to a child value.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
enum Step<'e> {
    Key(Cow<'e, str>),
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
    /// Adds the element to which some steps lead; returns its node.
    fn add(&mut self, steps: impl Iterator<Item = Step<'e>>) -> usize {
        let mut node = ROOT;
        for step in steps {
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
    text: &'t str,
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

    /// Skips past a string and returns what it says.
    fn string(&mut self) -> Cow<'t, str> {
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
        let inner = self.text.get(start..self.at).unwrap_or_default();
        self.at += 1;
        match inner.contains('\\') {
            true => unescaped(&self.text[start - 1..self.at]).into(),
            false => inner.into(),
        }
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
    fn findings_about_parts_of_a_value_get_their_lines_and_columns() {
        let text = "{\"a\": [1,\n{\"\\u0062\": 2}], \"c\": 3}";
        let elements = [
            "e[7].c",
            "e[7].a[1].b",
            "e[7]",
            "e[7].a[0]",
            "e[7].a[5].x",
            "f",
        ];
        let mut layout = Layout::default();
        for element in elements {
            let place = || Place::element(element);
            layout
                .diagnostics
                .push(Code::Attribute, place, String::new, "");
        }
        let position = TextPosition { line: 4, column: 9 };
        find_lines_within(layout.diagnostics.iter_mut(), "e[7]", text, position);
        let found: Vec<_> = layout
            .diagnostics
            .iter()
            .map(|finding| (finding.place.line, finding.place.column))
            .collect();
        let at = |line, column| (Some(line), Some(column));
        let whole = at(4, 9);
        assert_eq!(
            found,
            [at(5, 22), at(5, 12), whole, at(4, 16), at(4, 15), whole]
        );
    }

    #[test]
    fn repeated_key_gets_its_last_line() {
        assert_eq!(line_of("a.b", "{\"a\": {\"b\": 1,\n\"b\": 2}}"), Some(2));
    }
}
