//! What stands in the place of a field, and the records of an object's fields.

use std::borrow::Cow;
use std::fmt;
use std::marker::PhantomData;

use serde::Deserialize;
use serde::de::{DeserializeSeed, Deserializer, IgnoredAny, MapAccess, SeqAccess, Visitor};

/// A kind of JSON value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    Truth,
    Number,
    Text,
    List,
    Object,
}

impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Truth => "true or false",
            Self::Number => "a number",
            Self::Text => "a text",
            Self::List => "a list",
            Self::Object => "an object",
        })
    }
}

/// What was found in the place of a field.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) enum Field<T> {
    /// No such key, or null, which the format lets stand for it.
    #[default]
    Absent,
    /// A value of a type that cannot stand for the field's.
    Wrong(Kind),
    /// A value that stands for one of the field's type, such as `"3"` for 3.
    Converted(T, Kind),
    /// A value of the field's type.
    Value(T),
}

impl<T> Field<T> {
    /// Whether there is nothing.
    pub(crate) fn is_absent(&self) -> bool {
        matches!(self, Self::Absent)
    }

    /// The value, of whatever type it was written.
    pub(crate) fn get(&self) -> Option<&T> {
        match self {
            Self::Value(value) | Self::Converted(value, _) => Some(value),
            Self::Absent | Self::Wrong(_) => None,
        }
    }

    /// The kind of value in the place of the field if it is not the field's.
    pub(crate) fn wrong_kind(&self) -> Option<Kind> {
        match self {
            Self::Wrong(kind) | Self::Converted(_, kind) => Some(*kind),
            Self::Absent | Self::Value(_) => None,
        }
    }
}

/// A type that a field can have: what it makes of each kind of JSON value.
pub(crate) trait FromJson<'de>: Sized {
    /// Reads whatever stands in the place of a field.
    fn field<D: Deserializer<'de>>(deserializer: D) -> Result<Field<Self>, D::Error> {
        deserializer.deserialize_any(FieldVisitor(PhantomData))
    }

    fn from_bool(_: bool) -> Field<Self> {
        Field::Wrong(Kind::Truth)
    }

    fn from_whole(number: i128) -> Field<Self> {
        Self::from_number(number as f64)
    }

    fn from_number(_: f64) -> Field<Self> {
        Field::Wrong(Kind::Number)
    }

    fn from_text(_: Cow<'de, str>) -> Field<Self> {
        Field::Wrong(Kind::Text)
    }

    fn from_list<A: SeqAccess<'de>>(mut list: A) -> Result<Field<Self>, A::Error> {
        while list.next_element::<IgnoredAny>()?.is_some() {}
        Ok(Field::Wrong(Kind::List))
    }

    fn from_object<A: MapAccess<'de>>(mut object: A) -> Result<Field<Self>, A::Error> {
        while object.next_entry::<IgnoredAny, IgnoredAny>()?.is_some() {}
        Ok(Field::Wrong(Kind::Object))
    }
}

impl<'de, T: FromJson<'de>> Deserialize<'de> for Field<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        T::field(deserializer)
    }
}

struct FieldVisitor<T>(PhantomData<T>);

impl<'de, T: FromJson<'de>> Visitor<'de> for FieldVisitor<T> {
    type Value = Field<T>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a JSON value")
    }

    fn visit_unit<E>(self) -> Result<Self::Value, E> {
        Ok(Field::Absent)
    }

    fn visit_bool<E>(self, value: bool) -> Result<Self::Value, E> {
        Ok(T::from_bool(value))
    }

    fn visit_i64<E>(self, value: i64) -> Result<Self::Value, E> {
        Ok(T::from_whole(value.into()))
    }

    fn visit_u64<E>(self, value: u64) -> Result<Self::Value, E> {
        Ok(T::from_whole(value.into()))
    }

    fn visit_f64<E>(self, value: f64) -> Result<Self::Value, E> {
        Ok(T::from_number(value))
    }

    fn visit_borrowed_str<E>(self, value: &'de str) -> Result<Self::Value, E> {
        Ok(T::from_text(Cow::Borrowed(value)))
    }

    fn visit_str<E>(self, value: &str) -> Result<Self::Value, E> {
        Ok(T::from_text(Cow::Owned(value.to_owned())))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<Self::Value, A::Error> {
        T::from_list(list)
    }

    fn visit_map<A: MapAccess<'de>>(self, object: A) -> Result<Self::Value, A::Error> {
        T::from_object(object)
    }
}

impl<'de> FromJson<'de> for f64 {
    fn from_number(number: f64) -> Field<Self> {
        Field::Value(number)
    }

    fn from_text(text: Cow<'de, str>) -> Field<Self> {
        match text.trim().parse() {
            Ok(number) => Field::Converted(number, Kind::Text),
            Err(_) => Field::Wrong(Kind::Text),
        }
    }
}

impl<'de> FromJson<'de> for Cow<'de, str> {
    fn from_whole(number: i128) -> Field<Self> {
        Field::Converted(number.to_string().into(), Kind::Number)
    }

    fn from_number(number: f64) -> Field<Self> {
        Field::Converted(number.to_string().into(), Kind::Number)
    }

    fn from_text(text: Self) -> Field<Self> {
        Field::Value(text)
    }
}

impl<'de, T: FromJson<'de>> FromJson<'de> for Vec<Field<T>> {
    fn from_list<A: SeqAccess<'de>>(mut list: A) -> Result<Field<Self>, A::Error> {
        let mut all = Self::new();
        while let Some(item) = list.next_element()? {
            all.push(item);
        }
        Ok(Field::Value(all))
    }
}

impl<'de, T: FromJson<'de>> FromJson<'de> for Box<T> {
    fn from_object<A: MapAccess<'de>>(object: A) -> Result<Field<Self>, A::Error> {
        Ok(match T::from_object(object)? {
            Field::Value(value) => Field::Value(Self::new(value)),
            Field::Converted(value, kind) => Field::Converted(Self::new(value), kind),
            Field::Wrong(kind) => Field::Wrong(kind),
            Field::Absent => Field::Absent,
        })
    }
}

/// Reads the key of an object, without a copy of its text.
pub(crate) struct Key<F>(pub(crate) F);

impl<'de, K, F: FnOnce(&str) -> K> DeserializeSeed<'de> for Key<F> {
    type Value = K;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<K, D::Error> {
        deserializer.deserialize_str(self)
    }
}

impl<K, F: FnOnce(&str) -> K> Visitor<'_> for Key<F> {
    type Value = K;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a key")
    }

    fn visit_str<E>(self, key: &str) -> Result<K, E> {
        Ok((self.0)(key))
    }
}
