//! The values of attributes.

use std::borrow::Cow;

use serde::de::SeqAccess;

use super::field::{Field, FromJson, Kind};

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
