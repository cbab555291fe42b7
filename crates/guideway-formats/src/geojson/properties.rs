//! The properties of a feature: names and values of any depth, as plain columns.

use std::borrow::Cow;

use guideway_layout::Value;
use serde::de::{MapAccess, SeqAccess};

use crate::json::{Field, FromJson, Key};

/// Most properties of one feature, and most bytes of the name of one. Names are made from the names of all
/// objects around a value, so a small file could else make long texts without end.
const MOST_PROPERTIES: usize = 256;
const MOST_NAME_BYTES: usize = 128;

/// The value of a property.
#[derive(Debug)]
pub(crate) enum Property<'a> {
    Truth(bool),
    Whole(i64),
    Number(f64),
    /// A text; or a list, its values joined.
    Text(Cow<'a, str>),
    /// How many objects a list has.
    Count(i64),
    Group(Properties<'a>),
}

impl Property<'_> {
    /// The value for a column.
    pub(super) fn value(&self) -> Option<Value<'_>> {
        Some(match self {
            Self::Truth(value) => Value::Bool(*value),
            Self::Whole(value) | Self::Count(value) => Value::Int(*value),
            Self::Number(value) => Value::Float(*value),
            Self::Text(value) => Value::Text(value),
            Self::Group(_) => return None,
        })
    }
}

/// The properties of a feature by name; what is within another is `outer.inner`. Of a name that comes twice,
/// the last value counts.
#[derive(Debug, Default)]
pub(crate) struct Properties<'a> {
    all: Vec<(String, Property<'a>)>,
    /// How many there are beyond what is kept.
    pub(super) left_out: u64,
}

impl<'a> Properties<'a> {
    /// All in the order of the file. No value is a group.
    pub(super) fn iter(&self) -> impl Iterator<Item = (&str, &Property<'a>)> {
        self.all.iter().map(|(name, value)| (name.as_str(), value))
    }

    /// The value of a name.
    pub(super) fn get(&self, name: &str) -> Option<&Property<'a>> {
        self.iter()
            .find(|(n, _)| *n == name)
            .map(|(_, value)| value)
    }

    fn push(&mut self, name: String, value: Property<'a>) {
        if let Property::Group(inner) = value {
            self.left_out += inner.left_out;
            for (field, value) in inner.all {
                self.push(format!("{name}.{field}"), value);
            }
        } else if let Some((_, old)) = self.all.iter_mut().find(|(n, _)| *n == name) {
            *old = value;
        } else if self.all.len() < MOST_PROPERTIES && name.len() <= MOST_NAME_BYTES {
            self.all.push((name, value));
        } else {
            self.left_out += 1;
        }
    }
}

impl<'a> FromJson<'a> for Properties<'a> {
    fn from_object<A: MapAccess<'a>>(mut object: A) -> Result<Field<Self>, A::Error> {
        let mut all = Self::default();
        let short = |name: &str| (name.len() <= MOST_NAME_BYTES).then(|| name.to_owned());
        while let Some(name) = object.next_key_seed(Key(short))? {
            match (name, object.next_value()?) {
                (Some(name), Field::Value(value)) => all.push(name, value),
                (None, Field::Value(_)) => all.left_out += 1,
                _ => {}
            }
        }
        Ok(Field::Value(all))
    }
}

impl<'a> FromJson<'a> for Property<'a> {
    fn from_bool(value: bool) -> Field<Self> {
        Field::Value(Self::Truth(value))
    }

    fn from_whole(number: i128) -> Field<Self> {
        Field::Value(match i64::try_from(number) {
            Ok(whole) => Self::Whole(whole),
            Err(_) => Self::Number(number as f64),
        })
    }

    fn from_number(number: f64) -> Field<Self> {
        Field::Value(Self::Number(number))
    }

    fn from_text(text: Cow<'a, str>) -> Field<Self> {
        Field::Value(Self::Text(text))
    }

    fn from_list<A: SeqAccess<'a>>(mut list: A) -> Result<Field<Self>, A::Error> {
        let (mut text, mut objects) = (String::new(), 0);
        while let Some(item) = list.next_element::<Field<Self>>()? {
            let item = item.get();
            match item.and_then(Self::value) {
                Some(value) => {
                    text.push_str(if text.is_empty() { "" } else { ", " });
                    text.push_str(&value.to_string());
                }
                None => objects += i64::from(item.is_some()),
            }
        }
        Ok(match (text.is_empty(), objects) {
            (false, _) => Field::Value(Self::Text(text.into())),
            (true, 0) => Field::Absent,
            (true, count) => Field::Value(Self::Count(count)),
        })
    }

    fn from_object<A: MapAccess<'a>>(object: A) -> Result<Field<Self>, A::Error> {
        Ok(match Properties::from_object(object)? {
            Field::Value(inner) => Field::Value(Self::Group(inner)),
            _ => Field::Absent,
        })
    }
}
