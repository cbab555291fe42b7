//! GeoJSON properties: flattens the properties of a feature, of any depth, into named scalar
//! values.

use std::borrow::Cow;

use guideway_layout::Value;
use serde::de::{MapAccess, SeqAccess};

use crate::json::{Field, FromJson, Key};

/// Largest number of properties per feature.
const MAX_PROPERTIES: usize = 256;
/// Largest name of a property in bytes. A name contains the names of all enclosing objects, so a
/// small file could else expand to long texts without end.
const MAX_NAME_BYTES: usize = 128;

/// The value of a property.
#[derive(Debug)]
pub(crate) enum Property<'a> {
    Bool(bool),
    Integer(i64),
    Number(f64),
    /// A string, or the joined values of an array.
    Text(Cow<'a, str>),
    /// Number of objects of an array.
    Count(i64),
    Group(Properties<'a>),
}

impl Property<'_> {
    /// Returns the value for a column.
    pub(super) fn value(&self) -> Option<Value<'_>> {
        Some(match self {
            Self::Bool(value) => Value::Bool(*value),
            Self::Integer(value) | Self::Count(value) => Value::Int(*value),
            Self::Number(value) => Value::Float(*value),
            Self::Text(value) => Value::Text(value),
            Self::Group(_) => return None,
        })
    }
}

/// Properties of a feature by name; a nested one is `outer.inner`. The last value of a repeated
/// name is used.
#[derive(Debug, Default)]
pub(crate) struct Properties<'a> {
    all: Vec<(String, Property<'a>)>,
    /// Number of properties beyond the limits.
    pub(super) ignored: u64,
}

impl<'a> Properties<'a> {
    /// Iterates over the properties in file order. No value is a group.
    pub(super) fn iter(&self) -> impl Iterator<Item = (&str, &Property<'a>)> {
        self.all.iter().map(|(name, value)| (name.as_str(), value))
    }

    /// Returns the value of a name.
    pub(super) fn get(&self, name: &str) -> Option<&Property<'a>> {
        self.iter()
            .find(|(n, _)| *n == name)
            .map(|(_, value)| value)
    }

    fn push(&mut self, name: String, value: Property<'a>) {
        if let Property::Group(inner) = value {
            self.ignored += inner.ignored;
            for (field, value) in inner.all {
                self.push(format!("{name}.{field}"), value);
            }
        } else if let Some((_, old)) = self.all.iter_mut().find(|(n, _)| *n == name) {
            *old = value;
        } else if self.all.len() < MAX_PROPERTIES && name.len() <= MAX_NAME_BYTES {
            self.all.push((name, value));
        } else {
            self.ignored += 1;
        }
    }
}

impl<'a> FromJson<'a> for Properties<'a> {
    fn from_object<A: MapAccess<'a>>(mut object: A) -> Result<Field<Self>, A::Error> {
        let mut all = Self::default();
        let short = |name: &str| (name.len() <= MAX_NAME_BYTES).then(|| name.to_owned());
        while let Some(name) = object.next_key_seed(Key(short))? {
            match (name, object.next_value()?) {
                (Some(name), Field::Value(value)) => all.push(name, value),
                (None, Field::Value(_)) => all.ignored += 1,
                _ => {}
            }
        }
        Ok(Field::Value(all))
    }
}

impl<'a> FromJson<'a> for Property<'a> {
    fn from_bool(value: bool) -> Field<Self> {
        Field::Value(Self::Bool(value))
    }

    fn from_integer(number: i128) -> Field<Self> {
        Field::Value(match i64::try_from(number) {
            Ok(integer) => Self::Integer(integer),
            Err(_) => Self::Number(number as f64),
        })
    }

    fn from_number(number: f64) -> Field<Self> {
        Field::Value(Self::Number(number))
    }

    fn from_string(text: Cow<'a, str>) -> Field<Self> {
        Field::Value(Self::Text(text))
    }

    fn from_array<A: SeqAccess<'a>>(mut list: A) -> Result<Field<Self>, A::Error> {
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
