//! Parses untrusted YAML to a tree with the line of every value.
//!
//! The tree shares aliased values instead of copying them. The number of values that all aliases
//! refer to is bounded, because nested aliases let a few lines represent billions of values.

use std::borrow::Cow;
use std::collections::{HashMap, HashSet};

use guideway_layout::{TextPosition, Value};
use saphyr_parser::{Event, Parser, ScalarStyle, ScanError};

use crate::source::Source;
use crate::text::{ElementCounter, line_column, printable};
use crate::{Problem, ReadError};

/// Values that the aliases of any file may refer to, in addition to one per byte.
const BASE_ALIASED: u64 = 1 << 16;

/// A parsed file: all values, children before parents.
pub(crate) struct Yaml<'t> {
    values: Vec<NodeData<'t>>,
    /// Duplicate keys of objects with their lines; the last value of a key is used.
    pub(crate) duplicate_keys: Vec<(String, u32)>,
    /// First line of a second document, which is not read.
    pub(crate) next_document: Option<u32>,
}

/// A stored value.
struct NodeData<'t> {
    line: u32,
    /// Number of values in it, including itself and the values of its aliases.
    size: u64,
    content: Content<'t>,
}

enum Content<'t> {
    Scalar { text: Cow<'t, str>, is_plain: bool },
    List(Vec<u32>),
    Map(Vec<(Cow<'t, str>, u32)>),
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
    key: Option<Cow<'t, str>>,
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
                    Some(open) => self.close(open.node, open.anchor),
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
            open.key = Some(text);
            return Ok(());
        }
        let is_plain = style == ScalarStyle::Plain;
        let content = Content::Scalar { text, is_plain };
        let size = 1;
        self.counter.count()?;
        self.close(
            NodeData {
                line,
                size,
                content,
            },
            anchor,
        )
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
        let key = None;
        self.open.push(OpenCollection { node, anchor, key });
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

/// A reference to a value of a file.
#[derive(Clone, Copy)]
pub(crate) struct YamlNode<'y> {
    values: &'y [NodeData<'y>],
    node: usize,
}

impl<'y> YamlNode<'y> {
    fn content(self) -> &'y Content<'y> {
        &self.values[self.node].content
    }

    fn at(self, node: u32) -> Self {
        Self {
            node: node as usize,
            ..self
        }
    }

    /// The first line of the value, from 1.
    pub(crate) fn line(self) -> u32 {
        self.values[self.node].line
    }

    /// The place of the value in its file, to the line.
    pub(crate) fn position(self) -> TextPosition {
        TextPosition::line(self.line())
    }

    pub(crate) fn is_object(self) -> bool {
        matches!(self.content(), Content::Map(_))
    }

    /// The kind of the value, for messages.
    pub(crate) fn kind(self) -> &'static str {
        match self.content() {
            Content::Scalar { .. } if self.value().is_none() => "nothing",
            Content::Scalar { .. } => "a single value",
            Content::List(_) => "a list",
            Content::Map(_) => "an object",
        }
    }

    /// The items of a list; empty for any other value.
    pub(crate) fn items(self) -> impl ExactSizeIterator<Item = YamlNode<'y>> + Clone {
        let items: &[u32] = match self.content() {
            Content::List(items) => items,
            _ => &[],
        };
        items.iter().map(move |&item| self.at(item))
    }

    pub(crate) fn is_list(self) -> bool {
        matches!(self.content(), Content::List(_))
    }

    pub(crate) fn is_map(self) -> bool {
        matches!(self.content(), Content::Map(_))
    }

    /// The keys and values of an object; empty for any other value.
    pub(crate) fn entries(self) -> impl DoubleEndedIterator<Item = (&'y str, YamlNode<'y>)> {
        let entries: &[(Cow<'y, str>, u32)] = match self.content() {
            Content::Map(entries) => entries,
            _ => &[],
        };
        let item = move |entry: &'y (Cow<'y, str>, u32)| (&*entry.0, self.at(entry.1));
        entries.iter().map(item)
    }

    /// The value of a key of an object.
    pub(crate) fn get(self, key: &str) -> Option<YamlNode<'y>> {
        let mut entries = self.entries().rev();
        entries.find(|(k, _)| *k == key).map(|(_, value)| value)
    }

    /// An item of a list by its index.
    pub(crate) fn item(self, index: usize) -> Option<YamlNode<'y>> {
        self.items().nth(index)
    }

    /// The text of a scalar of any type.
    pub(crate) fn text(self) -> Option<&'y str> {
        match self.content() {
            Content::Scalar { text, .. } => Some(text),
            _ => None,
        }
    }

    /// A scalar, typed by the core schema of YAML 1.2; `None` for null, lists and objects.
    pub(crate) fn value(self) -> Option<Value<'y>> {
        let Content::Scalar { text, is_plain } = self.content() else {
            return None;
        };
        let text: &str = text;
        if !is_plain {
            return Some(Value::Text(text));
        }
        if let Ok(whole) = text.parse() {
            return Some(Value::Int(whole));
        }
        match text {
            "" | "~" | "null" | "Null" | "NULL" => None,
            "true" | "True" | "TRUE" => Some(Value::Bool(true)),
            "false" | "False" | "FALSE" => Some(Value::Bool(false)),
            ".nan" | ".NaN" | ".NAN" => Some(Value::Float(f64::NAN)),
            _ => match text.trim_start_matches(['+', '-']) {
                ".inf" | ".Inf" | ".INF" => Some(Value::Float(f64::INFINITY)),
                // Too long for `Int`; a float would round it.
                digits if is_whole(digits) => Some(Value::Text(text)),
                // Excludes spellings that only Rust accepts, such as `nan`.
                digits if digits.starts_with(|c: char| c.is_ascii_digit() || c == '.') => {
                    let number = text.parse().map(Value::Float);
                    Some(number.unwrap_or(Value::Text(text)))
                }
                _ => Some(Value::Text(text)),
            },
        }
    }

    /// A scalar as a number.
    pub(crate) fn number(self) -> Option<f64> {
        match self.value()? {
            Value::Int(whole) => Some(whole as f64),
            Value::Float(number) => Some(number),
            Value::Text(digits) if is_whole(digits) && self.is_plain() => digits.parse().ok(),
            _ => None,
        }
    }

    fn is_plain(self) -> bool {
        matches!(self.content(), Content::Scalar { is_plain: true, .. })
    }
}

fn is_whole(digits: &str) -> bool {
    !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_digit())
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
