use std::ops::Range;

use arrow_array::cast::AsArray;
use arrow_array::{Array, ArrayRef, LargeStringArray, StringArray, StringViewArray};
use arrow_schema::DataType;

use super::guard::{damaged, guarded};
use crate::Problem;

/// A column of text, however it is stored.
pub(super) enum Texts<'a> {
    Small(&'a StringArray),
    Large(&'a LargeStringArray),
    View(&'a StringViewArray),
    Dictionary {
        keys: Vec<usize>,
        column: &'a dyn Array,
        values: Box<Self>,
    },
    /// Made from values of another type.
    Made(StringArray),
}

/// Texts of some rows, none of them missing, as one text.
pub(super) struct SideBySide<'a> {
    pub(super) text: &'a str,
    /// Where each row begins, and where the last ends, all in something longer.
    offsets: &'a [i32],
}

impl SideBySide<'_> {
    /// Where each row ends.
    pub(super) fn ends(&self) -> impl Iterator<Item = usize> {
        let ends = self.offsets.iter().skip(1);
        ends.map(|end| (end - self.offsets[0]) as usize)
    }

    /// The length of each row.
    pub(super) fn lengths(&self) -> impl Iterator<Item = usize> {
        let neighbors = self.offsets.array_windows();
        neighbors.map(|[start, end]| (end - start) as usize)
    }
}

impl<'a> Texts<'a> {
    /// The column as text, if it is that.
    fn of(column: &'a ArrayRef) -> Option<Self> {
        Some(match column.data_type() {
            DataType::Utf8 => Self::Small(column.as_string()),
            DataType::LargeUtf8 => Self::Large(column.as_string()),
            DataType::Utf8View => Self::View(column.as_string_view()),
            DataType::Dictionary(_, _) => {
                let dictionary = column.as_any_dictionary_opt()?;
                if dictionary.values().is_empty() {
                    // Every key is null then, and none may be looked at.
                    return Some(Self::Made(StringArray::new_null(column.len())));
                }
                Self::Dictionary {
                    keys: dictionary.normalized_keys(),
                    column,
                    values: Box::new(Self::of(dictionary.values())?),
                }
            }
            _ => return None,
        })
    }

    /// A column whose type says that it is text.
    pub(super) fn of_text(column: &'a ArrayRef) -> Result<Self, Problem> {
        Self::of(column).ok_or_else(|| damaged("dictionary", "its values are not text"))
    }

    /// The column as text; whole numbers are written out.
    pub(super) fn of_id(column: &'a ArrayRef) -> Result<Self, Problem> {
        if let Some(texts) = Self::of(column) {
            return Ok(texts);
        }
        let made = guarded("column id", || {
            arrow_cast::cast(column, &DataType::Utf8)
                .map_err(|e| damaged("column id", e.to_string()))
        })?;
        Ok(Self::Made(made.as_string::<i32>().clone()))
    }

    /// Some rows at once, if they are stored so and all have a text.
    pub(super) fn side_by_side(&self, rows: Range<usize>) -> Option<SideBySide<'_>> {
        let array = match self {
            Self::Small(array) => array,
            Self::Made(array) => array,
            _ => return None,
        };
        let offsets = &array.value_offsets()[rows.start..=rows.end];
        let bytes = offsets[0] as usize..offsets[rows.len()] as usize;
        let text = str::from_utf8(&array.value_data()[bytes]).ok()?;
        (array.null_count() == 0).then_some(SideBySide { text, offsets })
    }

    /// The text of a row, if it has one.
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
            Self::Made(a) => a.is_valid(row).then(|| a.value(row)),
        }
    }
}
