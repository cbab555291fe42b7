//! Lazy arrays: parses a long array item by item, so that memory holds one item beside the text.

use std::marker::PhantomData;

use serde::{Deserialize, Deserializer};
use serde_json::value::RawValue;

use super::field::{Field, FromJson, JsonType};
use super::parse::problem;
use crate::ReadError;
use crate::builder::Builder;

/// The text of an array. Its syntax is valid; numbers and escapes are checked as items are parsed.
#[derive(Debug)]
pub(crate) struct LazyArray<'t, T> {
    text: &'t str,
    item: PhantomData<T>,
}

impl<'t, T> FromJson<'t> for LazyArray<'t, T> {
    fn field<D: Deserializer<'t>>(deserializer: D) -> Result<Field<Self>, D::Error> {
        let text = <&'t RawValue>::deserialize(deserializer)?.get();
        Ok(match text.as_bytes().first() {
            Some(b'[') => Field::Value(Self {
                text,
                item: PhantomData,
            }),
            Some(b'{') => Field::Wrong(JsonType::Object),
            Some(b'"') => Field::Wrong(JsonType::String),
            Some(b't' | b'f') => Field::Wrong(JsonType::Bool),
            Some(b'n') | None => Field::Absent,
            Some(_) => Field::Wrong(JsonType::Number),
        })
    }
}

impl<'t, T: FromJson<'t>> Field<LazyArray<'t, T>> {
    /// Returns a cursor over the items; `file` is the whole text. A field that is not
    /// an array has none.
    pub(crate) fn items(&self, file: &'t str) -> LazyItems<'t, T> {
        LazyItems {
            file,
            rest: self.get().map_or("", |list| &list.text[1..]),
            index: 0,
            item: PhantomData,
        }
    }
}

/// Cursor over the items of an array.
pub(crate) struct LazyItems<'t, T> {
    file: &'t str,
    rest: &'t str,
    index: usize,
    item: PhantomData<T>,
}

impl<'t, T: FromJson<'t>> LazyItems<'t, T> {
    /// Parses the next item; returns it with its index.
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
