//! The lines of findings, which are known by their place in the structure of the file.

use std::collections::HashMap;

use guideway_layout::Layout;

/// Gives each finding of a layout the line of its element in the text that it was read from, or that of the
/// innermost object around it if there is no such element. Costs nothing where nothing was found.
pub(crate) fn add_lines(layout: &mut Layout, text: &str) {
    let lines = lines(layout, text);
    for (finding, line) in layout.diagnostics.iter_mut().zip(lines) {
        finding.place.line = line;
    }
}

fn lines(layout: &Layout, text: &str) -> Vec<Option<u32>> {
    let mut wanted = Wanted::default();
    let findings = layout.diagnostics.iter();
    let nodes: Vec<usize> = findings.map(|f| wanted.add(&f.place.element)).collect();
    if nodes.is_empty() {
        return Vec::new();
    }
    let mut scan = Scan {
        bytes: text.as_bytes(),
        at: 0,
        line: 1,
        lines: vec![None; wanted.nodes.len()],
    };
    scan.value(ROOT, &wanted);
    // A finding about the whole file has no line.
    scan.lines[ROOT] = None;
    let of_innermost = |node: usize| {
        let mut outwards = std::iter::successors(Some(node), |&node| wanted.nodes[node].parent);
        outwards.find_map(|node| scan.lines[node])
    };
    nodes.into_iter().map(of_innermost).collect()
}

/// A step from a value to one within it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Step<'e> {
    Key(&'e str),
    Index(usize),
}

/// The places that are looked for, as a tree.
struct Wanted<'e> {
    nodes: Vec<Node>,
    children: HashMap<(usize, Step<'e>), usize>,
}

const ROOT: usize = 0;

#[derive(Default)]
struct Node {
    parent: Option<usize>,
    has_children: bool,
}

impl Default for Wanted<'_> {
    fn default() -> Self {
        Self {
            nodes: vec![Node::default()],
            children: HashMap::new(),
        }
    }
}

impl<'e> Wanted<'e> {
    /// Adds an element such as `layouts[0].nodes[3].x`.
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

/// Goes through a text that was parsed before, and so is sound.
struct Scan<'t> {
    bytes: &'t [u8],
    at: usize,
    line: u32,
    /// The line of each wanted element, once it was met.
    lines: Vec<Option<u32>>,
}

impl<'t> Scan<'t> {
    /// Goes past the value of a wanted place.
    fn value(&mut self, node: usize, wanted: &Wanted<'_>) {
        let first = self.peek();
        // Where a key comes twice, the last one counts.
        self.lines[node] = Some(self.line);
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
                    let key = self.text();
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

    /// The next byte that is no white space.
    fn peek(&mut self) -> Option<u8> {
        while let Some(&byte) = self.bytes.get(self.at) {
            match byte {
                b'\n' => self.line = self.line.saturating_add(1),
                b' ' | b'\t' | b'\r' => {}
                _ => return Some(byte),
            }
            self.at += 1;
        }
        None
    }

    /// Goes past a text, and returns what stands between its quotes.
    fn text(&mut self) -> &'t str {
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

    /// Goes past any value.
    fn skip(&mut self) {
        let mut depth = 0_usize;
        while let Some(byte) = self.peek() {
            match byte {
                b'"' => drop(self.text()),
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
            let goes_on = next.is_some_and(|b| !b", \t\r\n]}".contains(b));
            if depth == 0 && !goes_on {
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
        add_lines(&mut layout, text);
        layout.diagnostics.iter().next().and_then(|f| f.place.line)
    }

    #[test]
    fn a_finding_has_the_line_of_its_element() {
        let text = "{\n\"a\": [1, \"}]\\\",{\",\n{\"b\": 3,\n\"c\":\n[4, [5,\n6]]}],\n\"d\": {\"e\": 1e5}}";
        for (element, line) in [
            ("a", Some(2)),
            ("a[1]", Some(2)),
            ("a[2]", Some(3)),
            ("a[2].b", Some(3)),
            ("a[2].c", Some(5)),
            ("a[2].c[1][1]", Some(6)),
            ("d.e", Some(7)),
            // What is missing is missing from something.
            ("a[2].x.y", Some(3)),
            ("a[9]", Some(2)),
            ("the root", None),
            ("x", None),
        ] {
            assert_eq!(line_of(element, text), line, "{element}");
        }
    }

    #[test]
    fn of_equal_keys_the_last_counts() {
        assert_eq!(line_of("a.b", "{\"a\": {\"b\": 1,\n\"b\": 2}}"), Some(2));
    }
}
