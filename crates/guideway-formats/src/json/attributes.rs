//! The fields of an object that become columns.

use std::borrow::Cow;
use std::marker::PhantomData;

use serde::de::{IgnoredAny, MapAccess, SeqAccess};

use super::field::{Field, FromJson, Key, Kind};

/// A record with attributes.
pub(crate) trait HasAttributes {
    /// The names of all that become columns; others would let a file make columns without end.
    /// `group.field` is a field of an object within, and no two groups share the name of a field.
    const NAMES: &'static [&'static str];
}

/// Where a value of a record with attributes belongs.
#[derive(Clone, Copy)]
pub(crate) enum AttributeKey {
    Column(&'static str),
    Group,
}

impl AttributeKey {
    pub(crate) fn of<R: HasAttributes>(key: &str) -> Option<Self> {
        R::NAMES
            .iter()
            .find_map(|&name| match name.split_once('.') {
                Some((group, _)) => (group == key).then_some(Self::Group),
                None => (name == key).then_some(Self::Column(name)),
            })
    }
}

/// The attributes of a record, under the format's own names.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Attributes<'a>(Vec<(&'static str, Field<Scalar<'a>>)>);

impl<'a> Attributes<'a> {
    /// Reads the value of a key. Gives the name of an attribute that was there before.
    pub(crate) fn read<R: HasAttributes, A: MapAccess<'a>>(
        &mut self,
        key: AttributeKey,
        object: &mut A,
    ) -> Result<Option<&'static str>, A::Error> {
        match key {
            AttributeKey::Column(name) => Ok(self.put(name, object.next_value()?)),
            AttributeKey::Group => {
                let Field::Value(Group::<R>(fields, _)) = object.next_value()? else {
                    return Ok(None);
                };
                let put = |(name, value)| self.put(name, value);
                Ok(fields.into_iter().filter_map(put).last())
            }
        }
    }

    fn put(&mut self, name: &'static str, value: Field<Scalar<'a>>) -> Option<&'static str> {
        match self.0.iter_mut().find(|(n, _)| *n == name) {
            Some((_, old)) => {
                *old = value;
                Some(name)
            }
            None => {
                self.0.push((name, value));
                None
            }
        }
    }

    /// All attributes, in the order of the file.
    pub(crate) fn iter(&self) -> impl Iterator<Item = (&'static str, &Field<Scalar<'a>>)> {
        self.0.iter().map(|(name, value)| (*name, value))
    }
}

/// The fields of an object that become columns.
struct Group<'a, R>(Vec<(&'static str, Field<Scalar<'a>>)>, PhantomData<R>);

impl<'a, R: HasAttributes> FromJson<'a> for Group<'a, R> {
    fn from_object<A: MapAccess<'a>>(mut object: A) -> Result<Field<Self>, A::Error> {
        let named = |key: &str| {
            let whole = |a: &&&str| a.split_once('.').is_some_and(|(_, field)| field == key);
            R::NAMES.iter().find(whole).copied()
        };
        let mut fields: Vec<(&'static str, Field<Scalar<'a>>)> = Vec::new();
        while let Some(key) = object.next_key_seed(Key(named))? {
            match key {
                Some(name) if fields.iter().all(|(n, _)| *n != name) => {
                    fields.push((name, object.next_value()?));
                }
                _ => {
                    object.next_value::<IgnoredAny>()?;
                }
            }
        }
        Ok(Field::Value(Self(fields, PhantomData)))
    }
}

/// The value of an attribute.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Scalar<'a> {
    Truth(bool),
    Number(f64),
    Text(Cow<'a, str>),
    /// How many objects a list has.
    Count(i64),
}

impl<'a> FromJson<'a> for Scalar<'a> {
    fn from_bool(value: bool) -> Field<Self> {
        Field::Value(Self::Truth(value))
    }

    fn from_number(value: f64) -> Field<Self> {
        Field::Value(Self::Number(value))
    }

    fn from_text(value: Cow<'a, str>) -> Field<Self> {
        Field::Value(Self::Text(value))
    }

    /// A list of names is one text; a list of objects, such as actions, is their number.
    fn from_list<A: SeqAccess<'a>>(mut list: A) -> Result<Field<Self>, A::Error> {
        let (mut text, mut objects) = (String::new(), 0);
        while let Some(item) = list.next_element::<Field<Self>>()? {
            let part = match item {
                Field::Value(Self::Truth(value)) => value.to_string().into(),
                Field::Value(Self::Number(value)) => value.to_string().into(),
                Field::Value(Self::Text(value)) => value,
                Field::Wrong(Kind::Object) => {
                    objects += 1;
                    continue;
                }
                _ => continue,
            };
            if !text.is_empty() {
                text.push_str(", ");
            }
            text.push_str(&part);
        }
        Ok(match (text.is_empty(), objects) {
            (false, _) => Field::Value(Self::Text(text.into())),
            (true, 0) => Field::Absent,
            (true, count) => Field::Value(Self::Count(count)),
        })
    }
}
