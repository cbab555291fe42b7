//! [`YamlNode`]: a value of a parsed file, and its conversion to other types.

use std::borrow::Cow;
use std::rc::Rc;

use guideway_layout::{TextPosition, Value};

/// A stored value.
pub(super) struct NodeData<'t> {
    pub(super) line: u32,
    /// Number of values in it, including itself and the values of its aliases.
    pub(super) size: u64,
    pub(super) content: Content<'t>,
    /// True if an object merges it.
    pub(super) is_merged: bool,
}

/// The kind of a value.
pub(super) enum Content<'t> {
    Scalar {
        text: Cow<'t, str>,
        is_plain: bool,
    },
    List(Vec<u32>),
    /// The keys are shared with the objects that merge this one.
    Map(Vec<(Rc<str>, u32)>),
}

/// A reference to a value of a file.
#[derive(Clone, Copy)]
pub(crate) struct YamlNode<'y> {
    pub(super) values: &'y [NodeData<'y>],
    pub(super) node: usize,
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

    /// Returns `true` if an object merges the value (`<<`).
    pub(crate) fn is_merged(self) -> bool {
        self.values[self.node].is_merged
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
        let entries: &[(Rc<str>, u32)] = match self.content() {
            Content::Map(entries) => entries,
            _ => &[],
        };
        let item = move |entry: &'y (Rc<str>, u32)| (&*entry.0, self.at(entry.1));
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
