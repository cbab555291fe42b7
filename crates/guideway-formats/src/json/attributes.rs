//! Attributes: the fields of a JSON object that the layout stores as columns, and the members that
//! the record does not know.

use std::borrow::Cow;
use std::marker::PhantomData;

use serde::de::{Error, MapAccess};
use serde_json::value::RawValue;

use super::field::{Field, FromJson, JsonType, Key};
use super::scan::push_compact;

/// A record whose object has attributes.
pub(crate) trait HasAttributes {
    /// Names of the attributes. A fixed list keeps a file from creating columns without end.
    /// `group.field` is a field of a nested object; no two groups share the name of a field.
    const NAMES: &'static [&'static str];
}

/// Target of a key of an object with attributes.
pub(crate) enum AttributeKey {
    /// The attribute of this index in the names.
    Column(usize),
    /// A nested object, whose fields are attributes.
    Group(&'static str),
    /// A member that the record does not know.
    Other(String),
}

impl AttributeKey {
    /// Returns the target of a key.
    pub(crate) fn of<R: HasAttributes>(key: &str) -> Option<Self> {
        let known = R::NAMES.iter().enumerate().find_map(|(i, &name)| {
            let rest = name.strip_prefix(key)?;
            match rest.as_bytes().first() {
                None => Some(Self::Column(i)),
                Some(b'.') => Some(Self::Group(&name[..key.len()])),
                Some(_) => None,
            }
        });
        Some(known.unwrap_or_else(|| Self::Other(key.to_owned())))
    }
}

/// The attributes of a record, in file order.
#[derive(Clone, Debug, Default)]
pub(crate) struct Attributes<'a> {
    known: Vec<AttributeField<'a>>,
    other: Vec<OtherMember<'a>>,
}

/// An attribute as found.
#[derive(Clone, Debug)]
pub(crate) struct AttributeField<'a> {
    /// Index in [`HasAttributes::NAMES`].
    pub(crate) index: usize,
    pub(crate) name: &'static str,
    /// The value as written.
    pub(crate) text: &'a str,
    pub(crate) value: Scalar<'a>,
}

/// A member that the record does not know.
#[derive(Clone, Debug)]
struct OtherMember<'a> {
    group: Option<&'static str>,
    key: String,
    text: &'a str,
}

impl<'a> Attributes<'a> {
    /// Reads the value of a key. Returns the name of an attribute that it overwrites.
    pub(crate) fn read<R: HasAttributes, A: MapAccess<'a>>(
        &mut self,
        key: AttributeKey,
        object: &mut A,
    ) -> Result<Option<&'static str>, A::Error> {
        let text = object.next_value::<&'a RawValue>()?.get();
        match key {
            AttributeKey::Column(index) => {
                let value = Scalar::parse(text).map_err(A::Error::custom)?;
                Ok(self.put(AttributeField {
                    index,
                    name: R::NAMES[index],
                    text,
                    value,
                }))
            }
            AttributeKey::Group(group) if text.starts_with('{') => {
                let fields = serde_json::from_str::<Field<Group<'a, R>>>(text);
                let Field::Value(fields) = fields.map_err(A::Error::custom)? else {
                    return Ok(None);
                };
                let other = fields.other.into_iter();
                self.other.extend(other.map(|member| OtherMember {
                    group: Some(group),
                    ..member
                }));
                let put = |field| self.put(field);
                Ok(fields.known.into_iter().filter_map(put).last())
            }
            AttributeKey::Group(_) if text == "null" => Ok(None),
            AttributeKey::Group(group) => {
                self.put_other(group.to_owned(), text);
                Ok(None)
            }
            AttributeKey::Other(key) => {
                self.put_other(key, text);
                Ok(None)
            }
        }
    }

    fn put_other(&mut self, key: String, text: &'a str) {
        let group = None;
        self.other.push(OtherMember { group, key, text });
    }

    fn put(&mut self, field: AttributeField<'a>) -> Option<&'static str> {
        let name = field.name;
        match self.known.iter_mut().find(|old| old.name == name) {
            Some(old) => {
                *old = field;
                Some(name)
            }
            None => {
                self.known.push(field);
                None
            }
        }
    }

    /// Iterates over the attributes in file order.
    pub(crate) fn iter(&self) -> impl Iterator<Item = &AttributeField<'a>> {
        self.known.iter()
    }

    /// Returns the value of an attribute, if it is a text.
    pub(crate) fn text(&self, name: &str) -> Option<&str> {
        let found = self.known.iter().find(|field| field.name == name)?;
        match &found.value {
            Scalar::Text(text) => Some(text),
            _ => None,
        }
    }

    /// Returns whether there are members that the record does not know.
    pub(crate) fn has_other(&self) -> bool {
        !self.other.is_empty()
    }

    /// Iterates over the keys that the record does not know.
    pub(crate) fn other_keys(&self) -> impl Iterator<Item = &str> {
        self.other.iter().map(|member| member.key.as_str())
    }

    /// Adds the members that the record does not know, as written, to an object.
    pub(crate) fn add_other(&self, object: &mut OtherMembers) {
        for member in &self.other {
            object.add(member.group, &member.key, member.text);
        }
    }
}

/// An object of members that a record does not know, under construction.
#[derive(Default)]
pub(crate) struct OtherMembers {
    top: String,
    /// Members of nested objects, by their keys.
    groups: Vec<(&'static str, String)>,
    /// Items of arrays, by their keys.
    lists: Vec<(&'static str, String)>,
}

impl OtherMembers {
    /// Adds a member with its value as written, to the object or to a nested one.
    pub(crate) fn add(&mut self, group: Option<&'static str>, key: &str, value: &str) {
        let to = match group {
            None => &mut self.top,
            Some(group) => text_of(&mut self.groups, group),
        };
        if !to.is_empty() {
            to.push(',');
        }
        push_quoted(key, to);
        to.push(':');
        push_compact(value, to);
    }

    /// Adds an item, as written, to an array.
    pub(crate) fn add_item(&mut self, key: &'static str, item: &str) {
        let to = text_of(&mut self.lists, key);
        if !to.is_empty() {
            to.push(',');
        }
        push_compact(item, to);
    }

    /// The object as text; `None` if it has no members.
    pub(crate) fn into_text(mut self) -> Option<String> {
        for (key, items) in std::mem::take(&mut self.lists) {
            self.add(None, key, &format!("[{items}]"));
        }
        for (group, members) in std::mem::take(&mut self.groups) {
            self.add(None, group, &format!("{{{members}}}"));
        }
        (!self.top.is_empty()).then(|| format!("{{{}}}", self.top))
    }
}

/// Returns the text of a key, which is added if it is new.
fn text_of<'m>(all: &'m mut Vec<(&'static str, String)>, key: &'static str) -> &'m mut String {
    let known = all.iter().position(|(name, _)| *name == key);
    let index = known.unwrap_or_else(|| {
        all.push((key, String::new()));
        all.len() - 1
    });
    &mut all[index].1
}

fn push_quoted(text: &str, out: &mut String) {
    out.push_str(&serde_json::Value::from(text).to_string());
}

/// The attributes of a nested object.
struct Group<'a, R> {
    known: Vec<AttributeField<'a>>,
    other: Vec<OtherMember<'a>>,
    record: PhantomData<R>,
}

impl<'a, R: HasAttributes> FromJson<'a> for Group<'a, R> {
    fn from_object<A: MapAccess<'a>>(mut object: A) -> Result<Field<Self>, A::Error> {
        let index = |key: &str| {
            let is = |name: &&str| {
                name.strip_suffix(key)
                    .is_some_and(|rest| rest.ends_with('.'))
            };
            R::NAMES.iter().position(is).ok_or_else(|| key.to_owned())
        };
        let (mut known, mut other) = (Vec::<AttributeField<'a>>::new(), Vec::new());
        while let Some(key) = object.next_key_seed(Key(index))? {
            let text = object.next_value::<&'a RawValue>()?.get();
            match key {
                Ok(index) => {
                    let value = Scalar::parse(text).map_err(A::Error::custom)?;
                    known.retain(|field| field.index != index);
                    known.push(AttributeField {
                        index,
                        name: R::NAMES[index],
                        text,
                        value,
                    });
                }
                Err(key) => other.push(OtherMember {
                    group: None,
                    key,
                    text,
                }),
            }
        }
        Ok(Field::Value(Self {
            known,
            other,
            record: PhantomData,
        }))
    }
}

/// Value of an attribute.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Scalar<'a> {
    Null,
    Bool(bool),
    Integer(i64),
    Number(f64),
    Text(Cow<'a, str>),
    /// An array or object, as written.
    Json(&'a str),
}

impl<'a> Scalar<'a> {
    /// Parses a value of valid syntax.
    fn parse(text: &'a str) -> serde_json::Result<Self> {
        Ok(match text.as_bytes().first() {
            None | Some(b'n') => Self::Null,
            Some(b't') => Self::Bool(true),
            Some(b'f') => Self::Bool(false),
            Some(b'"') if text.contains('\\') => Self::Text(serde_json::from_str(text)?),
            Some(b'"') => Self::Text(Cow::Borrowed(&text[1..text.len() - 1])),
            Some(b'[' | b'{') => Self::Json(text),
            Some(_) => match text.parse() {
                Ok(integer) => Self::Integer(integer),
                Err(_) => Self::Number(serde_json::from_str(text)?),
            },
        })
    }

    /// Returns the type of the value, for messages.
    pub(crate) fn json_type(&self) -> JsonType {
        match self {
            Self::Bool(_) => JsonType::Bool,
            Self::Integer(_) | Self::Number(_) => JsonType::Number,
            Self::Null | Self::Text(_) => JsonType::String,
            Self::Json(text) if text.starts_with('[') => JsonType::Array,
            Self::Json(_) => JsonType::Object,
        }
    }
}
