//! Attributes: the fields of a JSON object that the layout stores as columns.

use std::borrow::Cow;
use std::marker::PhantomData;

use serde::de::{IgnoredAny, MapAccess, SeqAccess};

use super::field::{Field, FromJson, JsonType, Key};

/// A record whose object has attributes.
pub(crate) trait HasAttributes {
    /// Names of the attributes. A fixed list keeps a file from creating columns without end.
    /// `group.field` is a field of a nested object; no two groups share the name of a field.
    const NAMES: &'static [&'static str];
}

/// Target of a key of an object with attributes.
#[derive(Clone, Copy)]
pub(crate) enum AttributeKey {
    /// The column of this name.
    Column(&'static str),
    /// A nested object, whose fields are columns.
    Group,
}

impl AttributeKey {
    /// Returns the target of a key, or `None` if it is no attribute.
    pub(crate) fn of<R: HasAttributes>(key: &str) -> Option<Self> {
        R::NAMES
            .iter()
            .find_map(|&name| match name.split_once('.') {
                Some((group, _)) => (group == key).then_some(Self::Group),
                None => (name == key).then_some(Self::Column(name)),
            })
    }
}

/// The attributes of a record, by their names in the format.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Attributes<'a>(Vec<(&'static str, Field<Scalar<'a>>)>);

impl<'a> Attributes<'a> {
    /// Reads the value of a key. Returns the name of an attribute that it overwrites.
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

    /// Iterates over the attributes in file order.
    pub(crate) fn iter(&self) -> impl Iterator<Item = (&'static str, &Field<Scalar<'a>>)> {
        self.0.iter().map(|(name, value)| (*name, value))
    }
}

/// The attributes of a nested object.
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

/// Value of an attribute.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Scalar<'a> {
    Bool(bool),
    Number(f64),
    Text(Cow<'a, str>),
    /// Number of objects of an array.
    Count(i64),
}

impl<'a> FromJson<'a> for Scalar<'a> {
    fn from_bool(value: bool) -> Field<Self> {
        Field::Value(Self::Bool(value))
    }

    fn from_number(value: f64) -> Field<Self> {
        Field::Value(Self::Number(value))
    }

    fn from_string(value: Cow<'a, str>) -> Field<Self> {
        Field::Value(Self::Text(value))
    }

    /// Joins an array of scalars to one text; counts an array of objects, such as actions.
    fn from_array<A: SeqAccess<'a>>(mut list: A) -> Result<Field<Self>, A::Error> {
        let (mut text, mut objects) = (String::new(), 0);
        while let Some(item) = list.next_element::<Field<Self>>()? {
            let part = match item {
                Field::Value(Self::Bool(value)) => value.to_string().into(),
                Field::Value(Self::Number(value)) => value.to_string().into(),
                Field::Value(Self::Text(value)) => value,
                Field::Wrong(JsonType::Object) => {
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
