//! [`Values`]: a column of values of one type, and [`Value`], one of them.

use crate::{Cells, TextCells};

/// The values of a column, in one type.
#[derive(Clone, Debug, PartialEq)]
pub enum Values {
    /// Yes or no.
    Bool(Cells<bool>),
    /// Whole numbers.
    Int(Cells<i64>),
    /// Numbers.
    Float(Cells<f64>),
    /// Text.
    Text(TextCells),
    /// JSON texts: lists and objects that have no type of their own.
    Json(TextCells),
}

impl Values {
    pub(crate) fn empty_for(value: Value<'_>) -> Self {
        match value {
            Value::Bool(_) => Self::Bool(Cells::default()),
            Value::Int(_) => Self::Int(Cells::default()),
            Value::Float(_) => Self::Float(Cells::default()),
            Value::Text(_) => Self::Text(TextCells::default()),
            Value::Json(_) => Self::Json(TextCells::default()),
        }
    }

    /// Number of rows.
    pub fn len(&self) -> usize {
        match self {
            Self::Bool(v) => v.len(),
            Self::Int(v) => v.len(),
            Self::Float(v) => v.len(),
            Self::Text(v) | Self::Json(v) => v.len(),
        }
    }

    /// Returns `true` if there are no rows.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The value of a row, if it has one.
    pub fn get(&self, row: usize) -> Option<Value<'_>> {
        match self {
            Self::Bool(v) => v.get(row).map(Value::Bool),
            Self::Int(v) => v.get(row).map(Value::Int),
            Self::Float(v) => v.get(row).map(Value::Float),
            Self::Text(v) => v.get(row).map(Value::Text),
            Self::Json(v) => v.get(row).map(Value::Json),
        }
    }

    /// The given rows, in this order.
    #[must_use]
    pub fn select(&self, rows: &[usize]) -> Self {
        match self {
            Self::Bool(v) => Self::Bool(v.select(rows)),
            Self::Int(v) => Self::Int(v.select(rows)),
            Self::Float(v) => Self::Float(v.select(rows)),
            Self::Text(v) => Self::Text(v.select(rows)),
            Self::Json(v) => Self::Json(v.select(rows)),
        }
    }

    /// The cells of all rows.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = Option<Value<'_>>> {
        (0..self.len()).map(|row| self.get(row))
    }

    /// Returns `true` if the column can store a value without a change of its type.
    pub fn holds(&self, value: Value<'_>) -> bool {
        match (self, value) {
            (Self::Bool(_), Value::Bool(_))
            | (Self::Int(_), Value::Int(_))
            | (Self::Float(_), Value::Float(_))
            | (Self::Json(_), Value::Json(_))
            | (Self::Text(_), _) => true,
            (Self::Float(_), Value::Int(whole)) => is_exact(whole),
            _ => false,
        }
    }

    pub(crate) fn widen_for(&mut self, value: Value<'_>) {
        if self.holds(value) {
            return;
        }
        *self = match (&*self, value) {
            (Self::Int(v), Value::Float(_)) if v.iter().flatten().all(is_exact) => {
                Self::Float(v.iter().map(|v| v.map(|v| v as f64)).collect())
            }
            (narrow, _) => {
                let text = |row| narrow.get(row).map(|value| value.to_string());
                let mut wide = TextCells::default();
                (0..narrow.len()).for_each(|row| wide.push(text(row).as_deref()));
                Self::Text(wide)
            }
        };
    }

    pub(crate) fn set(&mut self, row: usize, value: Value<'_>) {
        match (self, value) {
            (Self::Text(v), Value::Text(x)) | (Self::Json(v), Value::Json(x)) => {
                v.set(row, Some(x));
            }
            (Self::Text(v), _) => v.set(row, Some(&value.to_string())),
            (Self::Bool(v), Value::Bool(x)) => v.set(row, x),
            (Self::Int(v), Value::Int(x)) => v.set(row, x),
            (Self::Float(v), Value::Float(x)) => v.set(row, x),
            (Self::Float(v), Value::Int(x)) => v.set(row, x as f64),
            _ => unreachable!("`widen_for` has widened the column for this value"),
        }
    }

    pub(crate) fn clear(&mut self, row: usize) {
        match self {
            Self::Bool(v) => v.clear(row),
            Self::Int(v) => v.clear(row),
            Self::Float(v) => v.clear(row),
            Self::Text(v) | Self::Json(v) => v.set(row, None),
        }
    }

    /// Appends rows without a value until the column has `rows` rows.
    fn pad_to(&mut self, rows: usize) {
        match self {
            Self::Bool(v) => v.pad_to(rows),
            Self::Int(v) => v.pad_to(rows),
            Self::Float(v) => v.pad_to(rows),
            Self::Text(v) | Self::Json(v) => v.pad_to(rows),
        }
    }

    pub(crate) fn copy_row(&mut self, from: usize, to: usize) {
        match self {
            Self::Bool(v) => v.get(from).into_iter().for_each(|x| v.set(to, x)),
            Self::Int(v) => v.get(from).into_iter().for_each(|x| v.set(to, x)),
            Self::Float(v) => v.get(from).into_iter().for_each(|x| v.set(to, x)),
            Self::Text(v) | Self::Json(v) => {
                if let Some(text) = v.get(from).map(str::to_owned) {
                    v.set(to, Some(&text));
                }
            }
        }
    }

    /// Heap bytes in use.
    pub fn heap_bytes(&self) -> usize {
        match self {
            Self::Bool(v) => v.heap_bytes(),
            Self::Int(v) => v.heap_bytes(),
            Self::Float(v) => v.heap_bytes(),
            Self::Text(v) | Self::Json(v) => v.heap_bytes(),
        }
    }
}

/// Returns `true` if double precision holds a whole number, and each one nearer to 0, to its last
/// digit. A serial number beyond would become another one.
fn is_exact(whole: i64) -> bool {
    whole.unsigned_abs() <= 1 << f64::MANTISSA_DIGITS
}

impl<'a> FromIterator<Option<Value<'a>>> for Values {
    /// The first value decides the type of the column; others widen it.
    fn from_iter<I: IntoIterator<Item = Option<Value<'a>>>>(rows: I) -> Self {
        let mut rows = rows.into_iter().enumerate().peekable();
        let mut empty = 0;
        while rows.next_if(|(_, value)| value.is_none()).is_some() {
            empty += 1;
        }
        let first = rows.peek().and_then(|(_, value)| *value);
        let mut values = Self::empty_for(first.unwrap_or(Value::Bool(false)));
        let mut len = empty;
        for (row, value) in rows {
            len = row + 1;
            if let Some(value) = value {
                values.widen_for(value);
                values.set(row, value);
            }
        }
        values.pad_to(len);
        values
    }
}

/// One value of an attribute.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Value<'a> {
    /// Yes or no.
    Bool(bool),
    /// A whole number.
    Int(i64),
    /// A number.
    Float(f64),
    /// Text.
    Text(&'a str),
    /// JSON: a list or an object.
    Json(&'a str),
}

impl Value<'_> {
    /// The whole or other number; `None` for values of other types.
    pub fn number(self) -> Option<f64> {
        match self {
            Self::Int(number) => Some(number as f64),
            Self::Float(number) => Some(number),
            Self::Bool(_) | Self::Text(_) | Self::Json(_) => None,
        }
    }
}

impl std::fmt::Display for Value<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Bool(v) => v.fmt(f),
            Self::Int(v) => v.fmt(f),
            // Files often store `f32`: 0.3 must not print as 0.30000001192092896.
            Self::Float(v) if f64::from(*v as f32) == *v => (*v as f32).fmt(f),
            Self::Float(v) => v.fmt(f),
            Self::Text(v) | Self::Json(v) => f.write_str(v),
        }
    }
}
