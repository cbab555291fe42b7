//! Lists that are read item by item: of a long file no more than one item is held beside its text.

use std::marker::PhantomData;

use serde::{Deserialize, Deserializer};
use serde_json::value::RawValue;

use super::field::{Field, FromJson, Kind};
use super::problem;
use crate::ReadError;
use crate::builder::Builder;

/// The text of a list, known to be sound JSON but for what its numbers and texts mean.
#[derive(Debug)]
pub(crate) struct Later<'t, T> {
    text: &'t str,
    item: PhantomData<T>,
}

impl<'t, T> FromJson<'t> for Later<'t, T> {
    fn field<D: Deserializer<'t>>(deserializer: D) -> Result<Field<Self>, D::Error> {
        let text = <&'t RawValue>::deserialize(deserializer)?.get();
        Ok(match text.as_bytes().first() {
            Some(b'[') => Field::Value(Self {
                text,
                item: PhantomData,
            }),
            Some(b'{') => Field::Wrong(Kind::Object),
            Some(b'"') => Field::Wrong(Kind::Text),
            Some(b't' | b'f') => Field::Wrong(Kind::Truth),
            Some(b'n') | None => Field::Absent,
            Some(_) => Field::Wrong(Kind::Number),
        })
    }
}

impl<'t, T: FromJson<'t>> Field<Later<'t, T>> {
    /// The items of a list in a file of this text; none if it is not a list.
    pub(crate) fn items(&self, file: &'t str) -> Items<'t, T> {
        Items {
            file,
            rest: self.get().map_or("", |list| &list.text[1..]),
            index: 0,
            item: PhantomData,
        }
    }
}

/// The items of a list that were not read yet.
pub(crate) struct Items<'t, T> {
    file: &'t str,
    rest: &'t str,
    index: usize,
    item: PhantomData<T>,
}

impl<'t, T: FromJson<'t>> Items<'t, T> {
    /// Reads the next item; returns it with its number, from 0.
    pub(crate) fn next(
        &mut self,
        builder: &mut Builder<'_>,
    ) -> Result<Option<(usize, Field<T>)>, ReadError> {
        let text = self.rest.trim_start_matches([' ', '\t', '\r', '\n', ',']);
        if matches!(text, "" | "]") {
            return Ok(None);
        }
        let mut items = serde_json::Deserializer::from_str(text).into_iter();
        let Some(item) = items.next() else {
            return Ok(None);
        };
        let item = item.map_err(|error| {
            let at = text.as_ptr() as usize - self.file.as_ptr() as usize;
            builder.source.fail(problem(&error, self.file, at))
        })?;
        let rest = &text[items.byte_offset()..];
        builder.advance(self.rest.len() - rest.len())?;
        self.rest = rest;
        self.index += 1;
        Ok(Some((self.index - 1, item)))
    }
}
