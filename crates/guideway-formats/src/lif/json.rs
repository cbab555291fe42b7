//! Reading JSON that need not be what the format says: every field tells what was found in its place.
//!
//! A wrong type must not end the read, and the file must not become a tree of values that is many times
//! its size. So the fields that are needed are read straight into records, and the rest is skipped.

use std::borrow::Cow;
use std::fmt;
use std::marker::PhantomData;

use serde::Deserialize;
use serde::de::{DeserializeSeed, Deserializer, IgnoredAny, MapAccess, SeqAccess, Visitor};

use crate::source::Source;
use crate::text::{Tally, position, printable};
use crate::{Problem, ReadError};

/// A kind of JSON value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
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
pub(super) enum Field<T> {
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
    pub(super) fn is_absent(&self) -> bool {
        matches!(self, Self::Absent)
    }

    /// The value, of whatever type it was written.
    pub(super) fn get(&self) -> Option<&T> {
        match self {
            Self::Value(value) | Self::Converted(value, _) => Some(value),
            Self::Absent | Self::Wrong(_) => None,
        }
    }

    /// The kind of value in the place of the field if it is not the field's.
    pub(super) fn wrong_kind(&self) -> Option<Kind> {
        match self {
            Self::Wrong(kind) | Self::Converted(_, kind) => Some(*kind),
            Self::Absent | Self::Value(_) => None,
        }
    }
}

/// A type that a field can have: what it makes of each kind of JSON value.
pub(super) trait FromJson<'de>: Sized {
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
        deserializer.deserialize_any(FieldVisitor(PhantomData))
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
pub(super) struct Key<F>(pub(super) F);

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

/// A record of the fields of an object that are needed. `repeated` is the last key that came twice.
macro_rules! record {
    ($(#[doc = $doc:literal])* $name:ident $(<$life:lifetime>)? {
        $($field:ident: $type:ty = $key:literal,)*
    }) => {
        $(#[doc = $doc])*
        #[derive(Debug, Default)]
        pub(super) struct $name $(<$life>)? {
            $(pub(super) $field: Field<$type>,)*
            pub(super) repeated: Option<&'static str>,
        }

        record!(@impl $name $(<$life>)? { $($field = $key,)* });
    };
    (@impl $name:ident { $($body:tt)* }) => {
        impl<'de> FromJson<'de> for $name { record!(@read $($body)*); }
    };
    (@impl $name:ident <$life:lifetime> { $($body:tt)* }) => {
        impl<$life> FromJson<$life> for $name<$life> { record!(@read_life $life $($body)*); }
    };
    (@read $($body:tt)*) => { record!(@read_life 'de $($body)*); };
    (@read_life $life:lifetime $($field:ident = $key:literal,)*) => {
        fn from_object<A: MapAccess<$life>>(mut object: A) -> Result<Field<Self>, A::Error> {
            #[allow(non_camel_case_types, reason = "a variant for each field, under its name")]
            enum Name { $($field,)* Other }
            let name = |key: &str| match key {
                $($key => Name::$field,)*
                _ => Name::Other,
            };
            let mut record = Self::default();
            $(let mut $field = false;)*
            while let Some(key) = object.next_key_seed(Key(name))? {
                match key {
                    $(Name::$field => {
                        record.$field = object.next_value()?;
                        if std::mem::replace(&mut $field, true) {
                            record.repeated = Some($key);
                        }
                    })*
                    Name::Other => {
                        object.next_value::<IgnoredAny>()?;
                    }
                }
            }
            Ok(Field::Value(record))
        }
    };
}
pub(super) use record;

/// Parses a whole text as one value.
pub(super) fn parse<'t, T: FromJson<'t>>(
    source: &Source<'_>,
    text: &'t str,
) -> Result<Field<T>, ReadError> {
    check_limits(source, text).map_err(|p| source.fail(p))?;
    source.check_cancelled()?;
    let mut parser = serde_json::Deserializer::from_str(text);
    let value = Field::deserialize(&mut parser);
    value
        .and_then(|value| parser.end().map(|()| value))
        .map_err(|error| source.fail(problem(&error, text)))
}

fn check_limits(source: &Source<'_>, text: &str) -> Result<(), Problem> {
    let mut tally = Tally::new(text, &source.options.limits);
    let (mut in_text, mut escaped) = (false, false);
    for (at, byte) in text.bytes().enumerate() {
        match byte {
            _ if escaped => escaped = false,
            b'\\' if in_text => escaped = true,
            b'"' => in_text = !in_text,
            _ if in_text => {}
            b'{' | b'[' => {
                tally.count()?;
                tally.enter(at)?;
            }
            b',' => tally.count()?,
            b'}' | b']' => tally.leave(),
            _ => {}
        }
    }
    Ok(())
}

fn problem(error: &serde_json::Error, text: &str) -> Problem {
    let (line, column) = (error.line() as u64, error.column() as u64);
    if error.is_eof() {
        let (line, column) = position(text, text.len());
        return Problem::Truncated {
            at: text.len() as u64,
            detail: format!("the JSON goes on after line {line}, column {column}"),
        };
    }
    let message = error.to_string();
    if message.starts_with("recursion limit exceeded") {
        return Problem::TooDeep {
            limit: 128,
            line,
            column,
        };
    }
    let message = message.split(" at line ").next().unwrap_or(&message);
    Problem::Syntax {
        line,
        column,
        message: printable(&friendly(
            message,
            word_at(text, error.line(), error.column()),
        )),
    }
}

/// What stands at a place, as far as it is one word.
fn word_at(text: &str, line: usize, column: usize) -> &str {
    let line = text.lines().nth(line.saturating_sub(1)).unwrap_or("");
    let from = line.get(column.saturating_sub(1)..).unwrap_or("");
    let end = from.find(|c: char| !c.is_ascii_alphanumeric() && c != '-');
    &from[..end.unwrap_or(from.len())]
}

fn friendly(message: &str, word: &str) -> String {
    match (message, word) {
        ("expected value", "NaN" | "Infinity" | "nan" | "inf") => {
            format!("{word} stands where JSON wants a number; JSON has no such number")
        }
        ("invalid number", _) if word.contains("nfinity") => {
            "-Infinity stands where JSON wants a number; JSON has no such number".into()
        }
        ("number out of range", _) => "the number is too large for any computer to hold".into(),
        ("key must be a string", _) => {
            "a key in quotes was expected; perhaps there is a comma too many".into()
        }
        ("trailing comma", _) => "there is a comma after the last value".into(),
        ("trailing characters", _) => "there is more text after the end of the layout".into(),
        ("expected value", "") => "a value was expected here".into(),
        ("expected value", word) => format!("a value was expected here, not `{word}`"),
        (other, _) => other.into(),
    }
}
