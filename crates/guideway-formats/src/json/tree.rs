//! [`Tree`]: an ordered JSON value to write.

use std::borrow::Cow;
use std::io;

use serde_json::ser::{CompactFormatter, Formatter};

use super::scan::{items_at, members, push_compact, unescaped};

/// A JSON value whose members keep their order.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Tree<'a> {
    /// A JSON text without white space between its tokens.
    Raw(Cow<'a, str>),
    Text(Cow<'a, str>),
    Number(f64),
    Bool(bool),
    Object(Members<'a>),
    Array(Vec<Tree<'a>>),
}

/// Members of an object, in order.
pub(crate) type Members<'a> = Vec<(Cow<'a, str>, Tree<'a>)>;

impl<'a> Tree<'a> {
    /// A JSON text; `None` for a number that JSON cannot hold.
    pub(crate) fn number(value: f64) -> Option<Self> {
        value.is_finite().then_some(Self::Number(value))
    }

    /// Parses a valid text one level deep: the parts of an object or array are raw.
    pub(crate) fn opened(text: &'a str) -> Self {
        let raw = |part: &'a str| {
            let has_space = part.bytes().any(|b| b.is_ascii_whitespace());
            if !has_space {
                return Tree::Raw(Cow::Borrowed(part));
            }
            let mut compact = String::with_capacity(part.len());
            push_compact(part, &mut compact);
            Tree::Raw(compact.into())
        };
        match text.as_bytes().first() {
            Some(b'{') => {
                let all = members(text, 0).into_iter();
                let member = |m: super::scan::MemberRange| {
                    (unescaped(&text[m.key]).into(), raw(&text[m.value]))
                };
                Tree::Object(all.map(member).collect())
            }
            Some(b'[') => {
                let all = items_at(text, 0).into_iter();
                Tree::Array(all.map(|item| raw(&text[item])).collect())
            }
            _ => raw(text),
        }
    }

    /// Adds the members of an object in a valid text that this object lacks; objects and arrays of
    /// the same key are merged.
    pub(crate) fn merge(&mut self, text: &'a str) {
        let Self::Object(own) = self else {
            return;
        };
        for member in members(text, 0) {
            let key = unescaped(&text[member.key]);
            let value = &text[member.value];
            match own.iter_mut().find(|(name, _)| *name == key) {
                None => own.push((key.into(), Self::Raw(value.into()))),
                Some((_, object @ Self::Object(_))) => object.merge(value),
                Some((_, Self::Array(items))) => {
                    let more = items_at(value, 0).into_iter();
                    items.extend(more.map(|item| Self::Raw(value[item].into())));
                }
                Some(_) => {}
            }
        }
    }

    /// Appends the items of an array in a valid text to an array member of this object.
    pub(crate) fn merge_item(&mut self, key: &str, array: &'a str) {
        let Self::Object(own) = self else {
            return;
        };
        if let Some((_, Self::Array(items))) = own.iter_mut().find(|(name, _)| name == key) {
            let more = items_at(array, 0).into_iter();
            items.extend(more.map(|item| Self::Raw(array[item].into())));
        }
    }

    /// Appends the value as text without white space.
    pub(crate) fn write(&self, out: &mut Vec<u8>) {
        match self {
            Self::Raw(text) => out.extend_from_slice(text.as_bytes()),
            Self::Text(text) => push_string(text, out),
            Self::Number(value) => push_number(*value, out),
            Self::Bool(value) => out.extend_from_slice(if *value { b"true" } else { b"false" }),
            Self::Object(members) => {
                out.push(b'{');
                for (i, (key, value)) in members.iter().enumerate() {
                    if i > 0 {
                        out.push(b',');
                    }
                    push_string(key, out);
                    out.push(b':');
                    value.write(out);
                }
                out.push(b'}');
            }
            Self::Array(items) => {
                out.push(b'[');
                for (i, item) in items.iter().enumerate() {
                    if i > 0 {
                        out.push(b',');
                    }
                    item.write(out);
                }
                out.push(b']');
            }
        }
    }

    /// The value as text without white space.
    pub(crate) fn to_text(&self) -> String {
        let mut out = Vec::new();
        self.write(&mut out);
        String::from_utf8(out).unwrap_or_default()
    }
}

/// Appends a finite number in the fewest digits that identify it.
pub(crate) fn push_number(value: f64, out: &mut Vec<u8>) {
    written(CompactFormatter.write_f64(out, value));
}

fn push_string(text: &str, out: &mut Vec<u8>) {
    let plain = |b: u8| b >= b' ' && b != b'"' && b != b'\\';
    if text.bytes().all(plain) {
        out.push(b'"');
        out.extend_from_slice(text.as_bytes());
        out.push(b'"');
    } else {
        written(serde_json::to_writer(out, text).map_err(io::Error::from));
    }
}

/// A buffer in memory takes any text.
fn written(result: io::Result<()>) {
    debug_assert!(result.is_ok());
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn merge_adds_members_and_keeps_own_values() {
        let inner = vec![("x".into(), Tree::Number(1.5))];
        let list = Tree::Array(vec![Tree::Bool(true)]);
        let mut tree = Tree::Object(vec![
            ("a".into(), Tree::Text("say \"no\"".into())),
            ("at".into(), Tree::Object(inner)),
            ("list".into(), list),
        ]);
        tree.merge(r#"{"a":1,"at":{"x":2,"z":3},"new":{"b":[1]},"list":[2]}"#);
        assert_eq!(
            tree.to_text(),
            r#"{"a":"say \"no\"","at":{"x":1.5,"z":3},"list":[true,2],"new":{"b":[1]}}"#
        );
    }

    #[test]
    fn opened_text_has_compact_parts() {
        let tree = Tree::opened("{\"a\": [1,\n 2.50], \"b\": \"c d\"}");
        assert_eq!(tree.to_text(), r#"{"a":[1,2.50],"b":"c d"}"#);
        assert_eq!(Tree::opened("[ {} ]").to_text(), "[{}]");
    }
}
