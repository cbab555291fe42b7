//! Text arrays: uniform access to a column of text in any Arrow encoding.

use std::ops::Range;

use arrow_array::builder::StringBuilder;
use arrow_array::cast::AsArray;
use arrow_array::{Array, ArrayRef, LargeStringArray, StringArray, StringViewArray};
use arrow_schema::DataType;

use super::cell_text::cell_writer;
use super::problems::damaged;
use crate::Problem;

/// A column of text in one of the encodings of Arrow.
pub(super) enum TextArray<'a> {
    Small(&'a StringArray),
    Large(&'a LargeStringArray),
    View(&'a StringViewArray),
    Dictionary {
        keys: Vec<usize>,
        column: &'a dyn Array,
        values: Box<Self>,
    },
    /// Converted from values of another type.
    Converted(StringArray),
}

/// Texts of consecutive rows, without nulls, as one string.
pub(super) struct ContiguousText<'a> {
    pub(super) text: &'a str,
    /// Start of each row and end of the last, relative to the buffer that contains `text`.
    offsets: &'a [i32],
}

impl ContiguousText<'_> {
    /// Iterates over the end of each row in `text`.
    pub(super) fn ends(&self) -> impl Iterator<Item = usize> {
        let ends = self.offsets.iter().skip(1);
        ends.map(|end| (end - self.offsets[0]) as usize)
    }

    /// Iterates over the length of each row.
    pub(super) fn lengths(&self) -> impl Iterator<Item = usize> {
        let neighbors = self.offsets.array_windows();
        neighbors.map(|[start, end]| (end - start) as usize)
    }
}

impl<'a> TextArray<'a> {
    /// Interprets a column as text, if it is text.
    fn from_text(column: &'a ArrayRef) -> Option<Self> {
        Some(match column.data_type() {
            DataType::Utf8 => Self::Small(column.as_string()),
            DataType::LargeUtf8 => Self::Large(column.as_string()),
            DataType::Utf8View => Self::View(column.as_string_view()),
            DataType::Dictionary(_, _) => {
                let dictionary = column.as_any_dictionary_opt()?;
                if dictionary.values().is_empty() {
                    // All keys are null, and their values are undefined.
                    return Some(Self::Converted(StringArray::new_null(column.len())));
                }
                Self::Dictionary {
                    keys: dictionary.normalized_keys(),
                    column,
                    values: Box::new(Self::from_text(dictionary.values())?),
                }
            }
            _ => return None,
        })
    }

    /// Interprets a column of a text type.
    ///
    /// # Errors
    /// When a dictionary has other values.
    pub(super) fn new(column: &'a ArrayRef) -> Result<Self, Problem> {
        Self::from_text(column).ok_or_else(|| damaged("dictionary", "its values are not text"))
    }

    /// Interprets a column of text or integers as text.
    pub(super) fn from_ids(column: &'a ArrayRef) -> Self {
        if let Some(texts) = Self::from_text(column) {
            return texts;
        }
        let mut texts = StringBuilder::new();
        let write = cell_writer(column);
        for row in 0..column.len() {
            let write = write.as_ref().filter(|_| column.is_valid(row));
            match write.map(|write| write(row, &mut texts)) {
                Some(Ok(())) => texts.append_value(""),
                _ => texts.append_null(),
            }
        }
        Self::Converted(texts.finish())
    }

    /// Returns consecutive rows as one string, if the encoding stores them so and none is null.
    pub(super) fn contiguous(&self, rows: Range<usize>) -> Option<ContiguousText<'_>> {
        let array = match self {
            Self::Small(array) => array,
            Self::Converted(array) => array,
            _ => return None,
        };
        let offsets = &array.value_offsets()[rows.start..=rows.end];
        let bytes = offsets[0] as usize..offsets[rows.len()] as usize;
        let text = str::from_utf8(&array.value_data()[bytes]).ok()?;
        (array.null_count() == 0).then_some(ContiguousText { text, offsets })
    }

    /// Returns the text of a row, or `None` for null.
    pub(super) fn get(&self, row: usize) -> Option<&str> {
        match self {
            Self::Small(a) => a.is_valid(row).then(|| a.value(row)),
            Self::Large(a) => a.is_valid(row).then(|| a.value(row)),
            Self::View(a) => a.is_valid(row).then(|| a.value(row)),
            Self::Dictionary {
                keys,
                column,
                values,
            } => {
                if column.is_null(row) {
                    return None;
                }
                values.get(keys[row])
            }
            Self::Converted(a) => a.is_valid(row).then(|| a.value(row)),
        }
    }
}
