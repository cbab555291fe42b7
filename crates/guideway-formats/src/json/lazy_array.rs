//! Lazy arrays: parses a long array in batches on all cores, so that memory holds two batches
//! beside the text.

use std::cell::RefCell;
use std::marker::PhantomData;
use std::ops::Range;

use rayon::prelude::*;
use serde::{Deserialize, Deserializer};
use serde_json::value::RawValue;

use super::field::{Field, FromJson, JsonType};
use super::parse::problem;
use super::scan::{items_at, member, value_end};
use crate::ReadError;
use crate::source::Source;

/// Items per task of a thread.
const TASK_ITEMS: usize = 64;

/// Tasks per batch.
const BATCH_TASKS: usize = 64;

/// Bytes from which on a batch ends: its records take a few times their text.
const BATCH_BYTES: usize = 4 << 20;

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
        let range = self.get().map(|list| {
            let start = list.text.as_ptr() as usize - file.as_ptr() as usize;
            // Without the brackets.
            start + 1..start + list.text.len() - 1
        });
        let range = range.unwrap_or_default();
        LazyItems {
            file,
            at: range.start,
            end: range.end,
            index: 0,
            item: PhantomData,
        }
    }
}

/// Cursor over the items of an array.
pub(crate) struct LazyItems<'t, T> {
    file: &'t str,
    at: usize,
    end: usize,
    index: usize,
    item: PhantomData<T>,
}

/// The key of an array, and the places of its items.
type ArrayPlaces = (&'static str, Vec<Range<usize>>);

/// An item of an array.
pub(crate) struct LazyItem<'t, T> {
    pub(crate) index: usize,
    /// First byte in the file.
    pub(crate) start: usize,
    pub(crate) text: &'t str,
    pub(crate) record: Field<T>,
    /// The places of the items of its arrays, by key, once one was asked for.
    arrays: RefCell<Vec<ArrayPlaces>>,
}

impl<'t, T> LazyItem<'t, T> {
    /// Returns an item of an array of the object, as written. The array is searched once.
    pub(crate) fn array_item(&self, key: &'static str, index: usize) -> &'t str {
        let mut arrays = self.arrays.borrow_mut();
        let known = arrays.iter().position(|(name, _)| *name == key);
        let known = known.unwrap_or_else(|| {
            let array = member(self.text, 0, key);
            let items = array.map(|array| items_at(self.text, array.start));
            arrays.push((key, items.unwrap_or_default()));
            arrays.len() - 1
        });
        let item = arrays[known].1.get(index);
        item.map_or("null", |item| &self.text[item.clone()])
    }
}

/// Items of an array that follow each other.
pub(crate) struct Batch<'t, T> {
    pub(crate) items: Vec<LazyItem<'t, T>>,
    /// Bytes of the text from the batch before to the end of this one.
    pub(crate) bytes: usize,
}

impl<'t, T: FromJson<'t> + Send> LazyItems<'t, T> {
    /// Calls `map` for the batches in order. The other cores parse the next batch meanwhile.
    ///
    /// # Errors
    /// When an item is not valid, or `map` fails.
    pub(crate) fn for_each_batch(
        mut self,
        source: Source<'_>,
        mut map: impl FnMut(Batch<'t, T>) -> Result<(), ReadError> + Send,
    ) -> Result<(), ReadError> {
        let mut next = self.parse(&source)?;
        while let Some(batch) = next {
            let (mapped, parsed) = rayon::join(|| map(batch), || self.parse(&source));
            mapped?;
            next = parsed?;
        }
        Ok(())
    }

    /// Parses the next items, on all cores; `None` at the end of the array.
    fn parse(&mut self, source: &Source<'_>) -> Result<Option<Batch<'t, T>>, ReadError> {
        let first = self.index;
        let ranges = self.take_ranges();
        self.index += ranges.len();
        let end = ranges.last().map_or(self.at, |range| range.end);
        let bytes = end - std::mem::replace(&mut self.at, end);
        let parse = |(i, range): (usize, &Range<usize>)| {
            let text = &self.file[range.clone()];
            let record = serde_json::from_str(text);
            record.map(|record| LazyItem {
                index: first + i,
                start: range.start,
                text,
                record,
                arrays: RefCell::default(),
            })
        };
        let chunks = ranges.par_chunks(TASK_ITEMS).enumerate();
        let parsed: Vec<Vec<_>> = chunks
            .map(|(chunk, ranges)| {
                let from = chunk * TASK_ITEMS;
                let items = ranges.iter().enumerate();
                items.map(|(i, range)| parse((from + i, range))).collect()
            })
            .collect();
        let mut items = Vec::with_capacity(ranges.len());
        for (item, range) in parsed.into_iter().flatten().zip(&ranges) {
            items.push(item.map_err(|error| {
                let problem = problem(&error, self.file, range.start);
                source.fail(problem)
            })?);
        }
        Ok((!items.is_empty()).then_some(Batch { items, bytes }))
    }

    /// Returns the ranges of the next items in the file.
    fn take_ranges(&self) -> Vec<Range<usize>> {
        let mut ranges = Vec::new();
        let mut at = self.at;
        while ranges.len() < TASK_ITEMS * BATCH_TASKS && at - self.at < BATCH_BYTES {
            let between = |b: &&u8| b" \t\r\n,".contains(b);
            at += self.file.as_bytes()[at..self.end]
                .iter()
                .take_while(between)
                .count();
            if at >= self.end {
                break;
            }
            let end = value_end(self.file, at).min(self.end);
            ranges.push(at..end);
            at = end;
        }
        ranges
    }
}
