//! Parses untrusted YAML to a tree with the line of every value.
//!
//! The tree shares aliased values instead of copying them. The number of values that all aliases
//! refer to is bounded, because nested aliases let a few lines represent billions of values. That
//! bounds merged objects too: each is an alias, or stated once.

use std::borrow::Cow;
use std::collections::{HashMap, HashSet};
use std::rc::Rc;

use saphyr_parser::{Event, Parser, ScalarStyle, ScanError};

use super::merge::merge;
use super::node::{Content, NodeData, YamlNode};
use crate::source::Source;
use crate::text::{ElementCounter, line_column, printable};
use crate::{Problem, ReadError};

/// Values that the aliases of any file may refer to, in addition to one per byte.
const BASE_ALIASED: u64 = 1 << 16;

/// The key whose value is merged into its object, as YAML 1.1 defines it.
const MERGE_KEY: &str = "<<";
const NO_OBJECT: &str = "`<<` merges objects or a list of them, and this is none";

/// A parsed file: all values, children before parents.
pub(crate) struct Yaml<'t> {
    values: Vec<NodeData<'t>>,
    /// Duplicate keys of objects with their lines; the last value of a key is used.
    pub(crate) duplicate_keys: Vec<(String, u32)>,
    /// First line of a second document, which is not read.
    pub(crate) next_document: Option<u32>,
}

impl<'t> Yaml<'t> {
    /// Parses the first document of a text.
    ///
    /// # Errors
    /// When the text is malformed or exceeds a limit, or when the caller cancels.
    pub(crate) fn parse(source: &Source<'_>, text: &'t str) -> Result<Self, ReadError> {
        let mut tree = TreeBuilder {
            yaml: Self {
                values: Vec::new(),
                duplicate_keys: Vec::new(),
                next_document: None,
            },
            counter: ElementCounter::new(text, &source.options.limits),
            text,
            open: Vec::new(),
            anchors: HashMap::new(),
            aliased_left: BASE_ALIASED + text.len() as u64,
        };
        for (count, event) in Parser::new_from_str(text).enumerate() {
            if count.is_multiple_of(1 << 16) {
                source.check_cancelled()?;
            }
            let (event, span) = event.map_err(|error| source.fail(problem(&error, text)))?;
            let line = u32::try_from(span.start.line()).unwrap_or(u32::MAX);
            if matches!(event, Event::DocumentStart(_)) && !tree.yaml.values.is_empty() {
                tree.yaml.next_document = Some(line);
                break;
            }
            tree.push_event(event, line).map_err(|p| source.fail(p))?;
        }
        Ok(tree.yaml)
    }

    /// The outermost value; `None` if the file has only comments.
    pub(crate) fn root(&self) -> Option<YamlNode<'_>> {
        let last = self.values.len().checked_sub(1)?;
        Some(YamlNode {
            values: &self.values,
            node: last,
        })
    }
}

/// A list or an object under construction.
struct OpenCollection<'t> {
    node: NodeData<'t>,
    anchor: usize,
    /// The key of the next value of an object.
    key: Option<Rc<str>>,
    /// True if that key is `<<`: the object takes the entries of the value.
    is_merge_key: bool,
    /// The values to merge, in file order.
    merges: Vec<u32>,
}

/// Builds the tree from parser events.
struct TreeBuilder<'t, 's> {
    yaml: Yaml<'t>,
    counter: ElementCounter<'s>,
    text: &'t str,
    open: Vec<OpenCollection<'t>>,
    /// Value per anchor; the parser numbers anchors.
    anchors: HashMap<usize, u32>,
    /// Remaining budget of aliased values.
    aliased_left: u64,
}

impl<'t> TreeBuilder<'t, '_> {
    fn push_event(&mut self, event: Event<'t>, line: u32) -> Result<(), Problem> {
        let new_node = |content| NodeData {
            line,
            size: 1,
            content,
            is_merged: false,
        };
        match event {
            Event::Scalar(text, style, anchor, _) => self.scalar(text, style, anchor, line),
            Event::SequenceStart(anchor, _) => {
                self.enter(new_node(Content::List(Vec::new())), anchor)
            }
            Event::MappingStart(anchor, _) => {
                self.enter(new_node(Content::Map(Vec::new())), anchor)
            }
            Event::SequenceEnd | Event::MappingEnd => {
                self.counter.leave();
                match self.open.pop() {
                    Some(mut open) => {
                        merge(&mut self.yaml.values, &mut open.node, &open.merges)
                            .map_err(|line| syntax(line, NO_OBJECT))?;
                        self.close(open.node, open.anchor)
                    }
                    None => Ok(()),
                }
            }
            Event::Alias(anchor) => {
                let Some(&value) = self.anchors.get(&anchor) else {
                    return Err(syntax(line, "an alias refers to a value that contains it"));
                };
                let size = self.yaml.values[value as usize].size;
                self.charge_alias(size)?;
                self.attach(value, line)
            }
            _ => Ok(()),
        }
    }

    fn charge_alias(&mut self, size: u64) -> Result<(), Problem> {
        let limit = BASE_ALIASED + self.text.len() as u64;
        let left = self.aliased_left.checked_sub(size);
        self.aliased_left = left.ok_or(Problem::LimitReached {
            what: "values of all aliases",
            limit,
            actual: limit - self.aliased_left + size,
        })?;
        Ok(())
    }

    fn scalar(
        &mut self,
        text: Cow<'t, str>,
        style: ScalarStyle,
        anchor: usize,
        line: u32,
    ) -> Result<(), Problem> {
        if let Some(open) = self.open.last_mut()
            && matches!(open.node.content, Content::Map(_))
            && open.key.is_none()
        {
            self.counter.count()?;
            open.is_merge_key = style == ScalarStyle::Plain && text == MERGE_KEY;
            open.key = Some(Rc::from(&*text));
            return Ok(());
        }
        let is_plain = style == ScalarStyle::Plain;
        let content = Content::Scalar { text, is_plain };
        self.counter.count()?;
        let node = NodeData {
            line,
            size: 1,
            content,
            is_merged: false,
        };
        self.close(node, anchor)
    }

    fn enter(&mut self, node: NodeData<'t>, anchor: usize) -> Result<(), Problem> {
        self.counter.count()?;
        // Replaces the position: the parser counts characters, the counter would need bytes.
        self.counter.enter(0).map_err(|problem| match problem {
            Problem::TooDeep { limit, .. } => Problem::TooDeep {
                limit,
                line: node.line.into(),
                column: 1,
            },
            other => other,
        })?;
        self.open.push(OpenCollection {
            node,
            anchor,
            key: None,
            is_merge_key: false,
            merges: Vec::new(),
        });
        Ok(())
    }

    /// Stores a complete value.
    fn close(&mut self, node: NodeData<'t>, anchor: usize) -> Result<(), Problem> {
        if let Content::Map(entries) = &node.content {
            let mut seen = HashSet::with_capacity(entries.len());
            for (key, value) in entries {
                if !seen.insert(key) {
                    let line = self.yaml.values[*value as usize].line;
                    self.yaml.duplicate_keys.push((key.to_string(), line));
                }
            }
        }
        let line = node.line;
        let value = self.yaml.values.len() as u32;
        self.yaml.values.push(node);
        if anchor > 0 {
            self.anchors.insert(anchor, value);
        }
        self.attach(value, line)
    }

    /// Appends a value to the enclosing list or object.
    fn attach(&mut self, value: u32, line: u32) -> Result<(), Problem> {
        let size = self.yaml.values[value as usize].size;
        let Some(open) = self.open.last_mut() else {
            return Ok(());
        };
        open.node.size = open.node.size.saturating_add(size);
        match (&mut open.node.content, open.key.take()) {
            (Content::Map(_), Some(_)) if open.is_merge_key => open.merges.push(value),
            (Content::Map(entries), Some(key)) => entries.push((key, value)),
            (Content::List(items), _) => items.push(value),
            _ => {
                return Err(syntax(
                    line,
                    "a key must be a text, not a list or an object",
                ));
            }
        }
        Ok(())
    }
}

fn syntax(line: u32, message: &str) -> Problem {
    Problem::Syntax {
        line: line.into(),
        column: 1,
        message: message.into(),
    }
}

/// Converts a parser error.
fn problem(error: &ScanError, text: &str) -> Problem {
    let place = error.marker();
    let (last_line, last_column) = line_column(text.trim_end(), usize::MAX);
    let (line, column) = (place.line() as u64, place.col() as u64 + 1);
    if (line, column) >= (last_line, last_column) {
        return Problem::Truncated {
            at: text.len() as u64,
            detail: printable(error.info()),
        };
    }
    Problem::Syntax {
        line,
        column,
        message: printable(error.info()),
    }
}
