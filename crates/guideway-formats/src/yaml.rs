//! YAML that need not be honest, as a tree with the line of every value.
//!
//! An alias stands for the value that it names and is not copied. What all aliases stand for is bounded, or
//! a few lines could be as much as a million.

use std::borrow::Cow;
use std::collections::{HashMap, HashSet};

use guideway_layout::Value;
use saphyr_parser::{Event, Parser, ScalarStyle, ScanError};

use crate::source::Source;
use crate::text::{ElementCounter, line_column, printable};
use crate::{Problem, ReadError};

/// So many values may all aliases of a file stand for, beside as many as it has bytes.
const LEAST_ALIASED: u64 = 1 << 16;

/// A parsed file: every value, each after those within it.
pub(crate) struct Yaml<'t> {
    values: Vec<Node<'t>>,
    /// Keys that an object has twice, with their lines; the last one counts.
    pub(crate) repeated: Vec<(String, u32)>,
    /// The line that a second document begins on. It is not read.
    pub(crate) next_document: Option<u32>,
}

struct Node<'t> {
    line: u32,
    /// How many values it is, with those within it and those that its aliases stand for.
    size: u64,
    content: Content<'t>,
}

enum Content<'t> {
    Scalar { text: Cow<'t, str>, is_plain: bool },
    List(Vec<u32>),
    Map(Vec<(Cow<'t, str>, u32)>),
}

impl<'t> Yaml<'t> {
    pub(crate) fn parse(source: &Source<'_>, text: &'t str) -> Result<Self, ReadError> {
        let mut reader = Reader {
            yaml: Self {
                values: Vec::new(),
                repeated: Vec::new(),
                next_document: None,
            },
            counter: ElementCounter::new(text, &source.options.limits),
            text,
            open: Vec::new(),
            anchors: HashMap::new(),
            aliased_left: LEAST_ALIASED + text.len() as u64,
        };
        for (count, event) in Parser::new_from_str(text).enumerate() {
            if count.is_multiple_of(1 << 16) {
                source.check_cancelled()?;
            }
            let (event, span) = event.map_err(|error| source.fail(problem(&error, text)))?;
            let line = u32::try_from(span.start.line()).unwrap_or(u32::MAX);
            if matches!(event, Event::DocumentStart(_)) && !reader.yaml.values.is_empty() {
                reader.yaml.next_document = Some(line);
                break;
            }
            reader.take(event, line).map_err(|p| source.fail(p))?;
        }
        Ok(reader.yaml)
    }

    /// The outermost value; none in a file of nothing but comments.
    pub(crate) fn root(&self) -> Option<Item<'_>> {
        let last = self.values.len().checked_sub(1)?;
        Some(Item {
            values: &self.values,
            node: last,
        })
    }
}

/// A list or an object that has not ended.
struct Open<'t> {
    node: Node<'t>,
    anchor: usize,
    /// The key whose value comes next; a list has none.
    key: Option<Cow<'t, str>>,
}

struct Reader<'t, 's> {
    yaml: Yaml<'t>,
    counter: ElementCounter<'s>,
    text: &'t str,
    open: Vec<Open<'t>>,
    /// Which value an anchor names, by the number that the parser gives it.
    anchors: HashMap<usize, u32>,
    aliased_left: u64,
}

impl<'t> Reader<'t, '_> {
    fn take(&mut self, event: Event<'t>, line: u32) -> Result<(), Problem> {
        let begins = |content| Node {
            line,
            size: 1,
            content,
        };
        match event {
            Event::Scalar(text, style, anchor, _) => self.scalar(text, style, anchor, line),
            Event::SequenceStart(anchor, _) => {
                self.enter(begins(Content::List(Vec::new())), anchor)
            }
            Event::MappingStart(anchor, _) => self.enter(begins(Content::Map(Vec::new())), anchor),
            Event::SequenceEnd | Event::MappingEnd => {
                self.counter.leave();
                match self.open.pop() {
                    Some(open) => self.close(open.node, open.anchor),
                    None => Ok(()),
                }
            }
            Event::Alias(anchor) => {
                let Some(&value) = self.anchors.get(&anchor) else {
                    return Err(syntax(
                        line,
                        "an alias stands for a value that it is within",
                    ));
                };
                let size = self.yaml.values[value as usize].size;
                self.aliased_left = match self.aliased_left.checked_sub(size) {
                    Some(left) => left,
                    None => {
                        return Err(Problem::LimitReached {
                            what: "values that aliases stand for",
                            limit: LEAST_ALIASED + self.text.len() as u64,
                            actual: LEAST_ALIASED + self.text.len() as u64 - self.aliased_left
                                + size,
                        });
                    }
                };
                self.put(value, line)
            }
            _ => Ok(()),
        }
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
            Node {
                line,
                size,
                content,
            },
            anchor,
        )
    }

    fn enter(&mut self, node: Node<'t>, anchor: usize) -> Result<(), Problem> {
        self.counter.count()?;
        // The parser knows the line, and counts characters where the counter counts bytes.
        self.counter.enter(0).map_err(|problem| match problem {
            Problem::TooDeep { limit, .. } => Problem::TooDeep {
                limit,
                line: node.line.into(),
                column: 1,
            },
            other => other,
        })?;
        let key = None;
        self.open.push(Open { node, anchor, key });
        Ok(())
    }

    /// A value is whole.
    fn close(&mut self, node: Node<'t>, anchor: usize) -> Result<(), Problem> {
        if let Content::Map(entries) = &node.content {
            let mut seen = HashSet::with_capacity(entries.len());
            for (key, value) in entries {
                if !seen.insert(key) {
                    let line = self.yaml.values[*value as usize].line;
                    self.yaml.repeated.push((key.to_string(), line));
                }
            }
        }
        let line = node.line;
        let value = self.yaml.values.len() as u32;
        self.yaml.values.push(node);
        if anchor > 0 {
            self.anchors.insert(anchor, value);
        }
        self.put(value, line)
    }

    /// Puts a value into the list or object around it.
    fn put(&mut self, value: u32, line: u32) -> Result<(), Problem> {
        let size = self.yaml.values[value as usize].size;
        let Some(open) = self.open.last_mut() else {
            return Ok(());
        };
        open.node.size = open.node.size.saturating_add(size);
        match (&mut open.node.content, open.key.take()) {
            (Content::Map(entries), Some(key)) => entries.push((key, value)),
            (Content::List(items), _) => items.push(value),
            _ => return Err(syntax(line, "a key is a text, not a list or an object")),
        }
        Ok(())
    }
}

/// One value of a file.
#[derive(Clone, Copy)]
pub(crate) struct Item<'y> {
    values: &'y [Node<'y>],
    node: usize,
}

impl<'y> Item<'y> {
    fn content(self) -> &'y Content<'y> {
        &self.values[self.node].content
    }

    fn at(self, node: u32) -> Self {
        Self {
            node: node as usize,
            ..self
        }
    }

    /// The line that it begins on, from 1.
    pub(crate) fn line(self) -> u32 {
        self.values[self.node].line
    }

    /// What it is, for messages.
    pub(crate) fn kind(self) -> &'static str {
        match self.content() {
            Content::Scalar { .. } if self.value().is_none() => "nothing",
            Content::Scalar { .. } => "a single value",
            Content::List(_) => "a list",
            Content::Map(_) => "an object",
        }
    }

    /// The items of a list; of anything else, none.
    pub(crate) fn items(self) -> impl ExactSizeIterator<Item = Item<'y>> + Clone {
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

    /// The keys and values of an object; of anything else, none.
    pub(crate) fn entries(self) -> impl DoubleEndedIterator<Item = (&'y str, Item<'y>)> {
        let entries: &[(Cow<'y, str>, u32)] = match self.content() {
            Content::Map(entries) => entries,
            _ => &[],
        };
        let item = move |entry: &'y (Cow<'y, str>, u32)| (&*entry.0, self.at(entry.1));
        entries.iter().map(item)
    }

    /// The value of a key.
    pub(crate) fn get(self, key: &str) -> Option<Item<'y>> {
        let mut entries = self.entries().rev();
        entries.find(|(k, _)| *k == key).map(|(_, value)| value)
    }

    /// An item of a list.
    pub(crate) fn item(self, index: usize) -> Option<Item<'y>> {
        self.items().nth(index)
    }

    /// The text of a single value, whatever its type.
    pub(crate) fn text(self) -> Option<&'y str> {
        match self.content() {
            Content::Scalar { text, .. } => Some(text),
            _ => None,
        }
    }

    /// A single value with its type, by the core schema of YAML 1.2; none for null, lists and objects.
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
                // Not what Rust takes for a number besides, such as `nan`.
                digits if digits.starts_with(|c: char| c.is_ascii_digit() || c == '.') => {
                    let number = text.parse().map(Value::Float);
                    Some(number.unwrap_or(Value::Text(text)))
                }
                _ => Some(Value::Text(text)),
            },
        }
    }

    /// A number.
    pub(crate) fn number(self) -> Option<f64> {
        match self.value()? {
            Value::Int(whole) => Some(whole as f64),
            Value::Float(number) => Some(number),
            _ => None,
        }
    }
}

fn syntax(line: u32, message: &str) -> Problem {
    Problem::Syntax {
        line: line.into(),
        column: 1,
        message: message.into(),
    }
}

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
