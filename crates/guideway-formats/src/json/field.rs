//! Fields: the value of an object's field, or the type of the value found instead, deserialized by
//! serde.

use std::borrow::Cow;
use std::fmt;
use std::marker::PhantomData;

use serde::Deserialize;
use serde::de::{DeserializeSeed, Deserializer, IgnoredAny, MapAccess, SeqAccess, Visitor};

/// Type of a JSON value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum JsonType {
    Bool,
    Number,
    String,
    Array,
    Object,
}

impl fmt::Display for JsonType {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Bool => "a boolean",
            Self::Number => "a number",
            Self::String => "a string",
            Self::Array => "an array",
            Self::Object => "an object",
        })
    }
}

/// Value of a field, as found.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) enum Field<T> {
    /// The key is missing or its value is null.
    #[default]
    Absent,
    /// A value of another type.
    Wrong(JsonType),
    /// A value converted from another type, such as 3 from `"3"`.
    Converted(T, JsonType),
    /// A value of the expected type.
    Value(T),
}

impl<T> Field<T> {
    /// Returns whether the field is missing or null.
    pub(crate) fn is_absent(&self) -> bool {
        matches!(self, Self::Absent)
    }

    /// Returns the value, converted or not.
    pub(crate) fn get(&self) -> Option<&T> {
        match self {
            Self::Value(value) | Self::Converted(value, _) => Some(value),
            Self::Absent | Self::Wrong(_) => None,
        }
    }

    /// Returns the type that was found if it is not the expected one.
    pub(crate) fn wrong_type(&self) -> Option<JsonType> {
        match self {
            Self::Wrong(kind) | Self::Converted(_, kind) => Some(*kind),
            Self::Absent | Self::Value(_) => None,
        }
    }
}

/// A type that a field can have, with its conversions from each JSON type. By default each type is
/// [`Field::Wrong`].
pub(crate) trait FromJson<'de>: Sized {
    /// Deserializes the value of a field, of any type.
    fn field<D: Deserializer<'de>>(deserializer: D) -> Result<Field<Self>, D::Error> {
        deserializer.deserialize_any(FieldVisitor(PhantomData))
    }

    fn from_bool(_: bool) -> Field<Self> {
        Field::Wrong(JsonType::Bool)
    }

    fn from_integer(number: i128) -> Field<Self> {
        Self::from_number(number as f64)
    }

    fn from_number(_: f64) -> Field<Self> {
        Field::Wrong(JsonType::Number)
    }

    fn from_string(_: Cow<'de, str>) -> Field<Self> {
        Field::Wrong(JsonType::String)
    }

    fn from_array<A: SeqAccess<'de>>(mut list: A) -> Result<Field<Self>, A::Error> {
        while list.next_element::<IgnoredAny>()?.is_some() {}
        Ok(Field::Wrong(JsonType::Array))
    }

    fn from_object<A: MapAccess<'de>>(mut object: A) -> Result<Field<Self>, A::Error> {
        while object.next_entry::<IgnoredAny, IgnoredAny>()?.is_some() {}
        Ok(Field::Wrong(JsonType::Object))
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
        Ok(T::from_integer(value.into()))
    }

    fn visit_u64<E>(self, value: u64) -> Result<Self::Value, E> {
        Ok(T::from_integer(value.into()))
    }

    fn visit_f64<E>(self, value: f64) -> Result<Self::Value, E> {
        Ok(T::from_number(value))
    }

    fn visit_borrowed_str<E>(self, value: &'de str) -> Result<Self::Value, E> {
        Ok(T::from_string(Cow::Borrowed(value)))
    }

    fn visit_str<E>(self, value: &str) -> Result<Self::Value, E> {
        Ok(T::from_string(Cow::Owned(value.to_owned())))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<Self::Value, A::Error> {
        T::from_array(list)
    }

    fn visit_map<A: MapAccess<'de>>(self, object: A) -> Result<Self::Value, A::Error> {
        T::from_object(object)
    }
}

impl<'de> FromJson<'de> for f64 {
    fn from_number(number: f64) -> Field<Self> {
        Field::Value(number)
    }

    fn from_string(text: Cow<'de, str>) -> Field<Self> {
        match text.trim().parse() {
            Ok(number) => Field::Converted(number, JsonType::String),
            Err(_) => Field::Wrong(JsonType::String),
        }
    }
}

impl<'de> FromJson<'de> for Cow<'de, str> {
    fn from_integer(number: i128) -> Field<Self> {
        Field::Converted(number.to_string().into(), JsonType::Number)
    }

    fn from_number(number: f64) -> Field<Self> {
        Field::Converted(number.to_string().into(), JsonType::Number)
    }

    fn from_string(text: Self) -> Field<Self> {
        Field::Value(text)
    }
}

impl<'de, T: FromJson<'de>> FromJson<'de> for Vec<Field<T>> {
    fn from_array<A: SeqAccess<'de>>(mut list: A) -> Result<Field<Self>, A::Error> {
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

/// Maps the key of an object by a function, without a copy of the string.
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
