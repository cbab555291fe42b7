//! Lazy arrays: reads a long array part by part and parses it on all cores, so that memory holds
//! the text and records of two batches.

use std::cell::RefCell;
use std::ops::Range;

use guideway_layout::TextPosition;
use rayon::prelude::*;
use serde::{Deserialize, Deserializer};
use serde_json::value::RawValue;

use super::field::{Field, FromJson, JsonType};
use super::scan::{items_at, member};
use super::skeleton::LongArray;
use crate::input::Input;
use crate::{Problem, ReadError};

/// Parts per batch.
const BATCH_PARTS: usize = 64;

/// The text of an array, of valid syntax.
#[derive(Debug)]
pub(crate) struct LazyArray<'t> {
    pub(crate) text: &'t str,
}

impl<'t> FromJson<'t> for LazyArray<'t> {
    fn field<D: Deserializer<'t>>(deserializer: D) -> Result<Field<Self>, D::Error> {
        let text = <&'t RawValue>::deserialize(deserializer)?.get();
        Ok(match text.as_bytes().first() {
            Some(b'[') => Field::Value(Self { text }),
            Some(b'{') => Field::Wrong(JsonType::Object),
            Some(b'"') => Field::Wrong(JsonType::String),
            Some(b't' | b'f') => Field::Wrong(JsonType::Bool),
            Some(b'n') | None => Field::Absent,
            Some(_) => Field::Wrong(JsonType::Number),
        })
    }
}

/// A kind of record, whatever text it borrows from.
pub(crate) trait RecordKind {
    /// The record.
    type Record<'t>: FromJson<'t> + Send;
}

/// The reason why an array cannot be read.
pub(crate) enum ArrayFault {
    /// The input cannot be read.
    Input(Problem),
    /// The reader of its items fails.
    Reader(ReadError),
    /// The text between items is not valid.
    Separator,
    /// The item at a byte of the input is not valid.
    Item(serde_json::Error, usize),
}

impl From<ReadError> for ArrayFault {
    fn from(error: ReadError) -> Self {
        Self::Reader(error)
    }
}

/// The key of an array, and the places of its items.
type ArrayPlaces = (&'static str, Vec<Range<usize>>);

/// An item of an array.
pub(crate) struct LazyItem<'t, T> {
    /// First byte in the input.
    pub(crate) start: usize,
    /// Place of the first byte, as if its part were a text of its own.
    pub(crate) position: TextPosition,
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

/// A part of an array: items that follow each other.
pub(crate) struct Part<'t, T> {
    pub(crate) items: Vec<LazyItem<'t, T>>,
    /// Number of its bytes.
    pub(crate) bytes: usize,
    /// Place behind its last byte, as if it were a text of its own.
    pub(crate) end: TextPosition,
}

/// Memory for the texts of a batch.
type Buffers = Vec<Vec<u8>>;

impl LongArray {
    /// Calls `map` for the parts in order, some at a time. The other cores parse the next ones
    /// meanwhile.
    ///
    /// # Errors
    /// When an item is not valid, or `map` fails.
    pub(crate) fn for_each_batch<K: RecordKind>(
        &self,
        input: &Input<'_>,
        mut map: impl for<'t> FnMut(Vec<Part<'t, K::Record<'t>>>) -> Result<(), ReadError> + Send,
    ) -> Result<(), ArrayFault> {
        let [mut of_this, mut of_next] = [0, 1].map(|_| vec![Vec::new(); BATCH_PARTS]);
        let mut batches = Batches {
            input,
            borders: &self.borders,
        };
        let mut batch = batches.parse::<K>(&mut of_this)?;
        // Unrolled twice: each of two texts lives as long as the records that borrow from it.
        while !batch.is_empty() {
            let (mapped, next) = rayon::join(|| map(batch), || batches.parse::<K>(&mut of_next));
            mapped?;
            let after = next?;
            let (mapped, next) = rayon::join(|| map(after), || batches.parse::<K>(&mut of_this));
            mapped?;
            batch = next?;
        }
        Ok(())
    }
}

/// The batches of an array.
struct Batches<'a> {
    input: &'a Input<'a>,
    /// First bytes of the parts that are left, and the byte behind the last one.
    borders: &'a [usize],
}

impl<'a> Batches<'a> {
    /// Parses the parts of the next batch, on all cores.
    fn parse<'t, K: RecordKind>(
        &mut self,
        buffers: &'t mut Buffers,
    ) -> Result<Vec<Part<'t, K::Record<'t>>>, ArrayFault>
    where
        'a: 't,
    {
        let count = self.borders.len().saturating_sub(1).min(BATCH_PARTS);
        let (input, borders) = (self.input, &self.borders[..=count]);
        self.borders = &self.borders[count..];
        let is_end = self.borders.len() == 1;
        let parts = borders.par_windows(2).zip(buffers).enumerate();
        let parts = parts.map(|(i, (range, buffer))| {
            let part = input.part(range[0]..range[1], buffer);
            let part = part.map_err(ArrayFault::Input)?;
            parse_part::<K>(part, range[0], is_end && i + 1 == count)
        });
        parts.collect()
    }
}

/// Parses the items of a part, whose first byte is `start` in the input.
fn parse_part<'t, K: RecordKind>(
    part: &'t [u8],
    start: usize,
    is_last: bool,
) -> Result<Part<'t, K::Record<'t>>, ArrayFault> {
    let text = std::str::from_utf8(part).map_err(|_| ArrayFault::Separator)?;
    let mut items = Vec::new();
    let (mut position, mut counted) = (TextPosition::FIRST, 0);
    let mut at = skip_blanks(part, 0);
    while at < part.len() {
        let mut values = serde_json::Deserializer::from_str(&text[at..]).into_iter();
        let record = values.next().ok_or(ArrayFault::Separator)?;
        let record = record.map_err(|error| ArrayFault::Item(error, start + at))?;
        let end = at + values.byte_offset();
        position = position.after(&part[counted..at]);
        counted = at;
        items.push(LazyItem {
            start: start + at,
            position,
            text: &text[at..end],
            record,
            arrays: RefCell::default(),
        });
        at = skip_blanks(part, end);
        let has_comma = part.get(at) == Some(&b',');
        if has_comma {
            at = skip_blanks(part, at + 1);
        }
        // A comma is between items and at the end of a part that others follow.
        if has_comma == (is_last && at == part.len()) {
            return Err(ArrayFault::Separator);
        }
    }
    Ok(Part {
        items,
        bytes: part.len(),
        end: position.after(&part[counted..]),
    })
}

/// Returns the first byte from `at` on that is no white space.
fn skip_blanks(text: &[u8], at: usize) -> usize {
    let rest = text.get(at..).unwrap_or_default();
    let blanks = rest.iter().take_while(|byte| b" \t\r\n".contains(byte));
    at + blanks.count()
}

#[cfg(test)]
mod tests {
    use super::*;

    enum Number {}

    impl RecordKind for Number {
        type Record<'t> = f64;
    }

    fn numbers(text: &str, is_last: bool) -> Option<Vec<f64>> {
        let part = parse_part::<Number>(text.as_bytes(), 0, is_last).ok()?;
        let items = part.items.iter();
        items.map(|item| item.record.get().copied()).collect()
    }

    #[test]
    fn items_are_between_commas() {
        for (text, is_last, expected) in [
            ("1, 2 ,3", true, Some(vec![1.0, 2.0, 3.0])),
            (" 1,\n2 ,", false, Some(vec![1.0, 2.0])),
            (" \n", true, Some(Vec::new())),
            ("1, 2,", true, None),
            ("1, 2", false, None),
            ("1 2", true, None),
            ("1,, 2", true, None),
            (",1", true, None),
            ("1, 2]", true, None),
            ("1, nonsense", true, None),
        ] {
            assert_eq!(numbers(text, is_last), expected, "{text}");
        }
        assert!(parse_part::<Number>(b"1, \xFF", 0, true).is_err());
    }

    #[test]
    fn items_know_their_lines() {
        let part = parse_part::<Number>(b" 1,\n  2,3,\n", 5, false);
        let Ok(part) = part else { panic!("valid") };
        let places = part.items.iter().map(|item| {
            let TextPosition { line, column } = item.position;
            (item.start, line, column)
        });
        assert!(places.eq([(6, 1, 2), (11, 2, 3), (13, 2, 5)]));
        assert_eq!((part.end.line, part.end.column), (3, 1));
    }
}
