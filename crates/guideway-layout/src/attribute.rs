//! [`Attributes`]: the further columns of a table, each with a name and one type.

use crate::{Cells, TextColumn};

/// Further columns of a table, in the order of the file.
#[derive(Clone, Debug, Default)]
pub struct Attributes {
    columns: Vec<Attribute>,
}

impl Attributes {
    /// Adds a column, or replaces the one of the same name.
    pub fn insert(&mut self, column: Attribute) {
        match self.columns.iter_mut().find(|c| c.name == column.name) {
            Some(old) => *old = column,
            None => self.columns.push(column),
        }
    }

    /// Sets the value of a row; appends empty rows before it as needed. A value of another type
    /// widens the column: whole numbers to numbers, any other mix to text.
    pub fn set(&mut self, row: usize, name: &str, value: Value<'_>) {
        let index = self
            .columns
            .iter()
            .position(|c| c.name == name)
            .unwrap_or_else(|| {
                self.columns
                    .push(Attribute::new(name, Values::empty_for(value)));
                self.columns.len() - 1
            });
        let values = &mut self.columns[index].values;
        values.widen_for(value);
        values.set(row, value);
    }

    /// Copies the values of row `from` to row `to`.
    pub fn copy_row(&mut self, from: usize, to: usize) {
        for Attribute { values, .. } in &mut self.columns {
            match values.get(from) {
                None => {}
                Some(Value::Bool(value)) => values.set(to, Value::Bool(value)),
                Some(Value::Int(value)) => values.set(to, Value::Int(value)),
                Some(Value::Float(value)) => values.set(to, Value::Float(value)),
                Some(Value::Text(text)) => {
                    let text = text.to_owned();
                    values.set(to, Value::Text(&text));
                }
            }
        }
    }

    /// Appends the values of another table, whose row 0 becomes row `first_row`.
    pub(crate) fn extend(&mut self, first_row: usize, other: &Self) {
        for column in other.iter() {
            for row in 0..column.values.len() {
                if let Some(value) = column.values.get(row) {
                    self.set(first_row + row, &column.name, value);
                }
            }
        }
    }

    /// The column with this name.
    pub fn get(&self, name: &str) -> Option<&Attribute> {
        self.columns.iter().find(|c| c.name == name)
    }

    /// All columns, in the order of the file.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = &Attribute> {
        self.columns.iter()
    }

    /// Heap bytes in use.
    pub fn heap_bytes(&self) -> usize {
        self.columns.iter().map(|c| c.values.heap_bytes()).sum()
    }
}

/// One typed column. A row may lack a value; rows past the end lack one.
#[derive(Clone, Debug, PartialEq)]
pub struct Attribute {
    /// Name in the file.
    pub name: String,
    /// One value per row.
    pub values: Values,
    /// Type in the file if it is narrower than the one in memory, such as `Int16`.
    pub source_type: Option<String>,
}

impl Attribute {
    /// A column with the same type in the file and in memory.
    pub fn new(name: impl Into<String>, values: Values) -> Self {
        Self {
            name: name.into(),
            values,
            source_type: None,
        }
    }
}

/// The values of a column, in one type.
#[derive(Clone, Debug, PartialEq)]
pub enum Values {
    /// Yes or no.
    Bool(Cells<bool>),
    /// Whole numbers.
    Int(Cells<i64>),
    /// Numbers.
    Float(Cells<f64>),
    /// Text; `present[row]` distinguishes an empty text from a missing one.
    Text {
        /// The text of each row.
        text: TextColumn,
        /// Whether the row has a value.
        present: Vec<bool>,
    },
}

impl Values {
    fn empty_for(value: Value<'_>) -> Self {
        match value {
            Value::Bool(_) => Self::Bool(Cells::default()),
            Value::Int(_) => Self::Int(Cells::default()),
            Value::Float(_) => Self::Float(Cells::default()),
            Value::Text(_) => Self::Text {
                text: TextColumn::default(),
                present: Vec::new(),
            },
        }
    }

    /// Number of rows.
    pub fn len(&self) -> usize {
        match self {
            Self::Bool(v) => v.len(),
            Self::Int(v) => v.len(),
            Self::Float(v) => v.len(),
            Self::Text { present, .. } => present.len(),
        }
    }

    /// Whether there are no rows.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The value of a row, if it has one.
    pub fn get(&self, row: usize) -> Option<Value<'_>> {
        match self {
            Self::Bool(v) => v.get(row).map(Value::Bool),
            Self::Int(v) => v.get(row).map(Value::Int),
            Self::Float(v) => v.get(row).map(Value::Float),
            Self::Text { text, present } => {
                let is_present = present.get(row).copied().unwrap_or(false);
                is_present.then(|| Value::Text(text.get(row)))
            }
        }
    }

    fn widen_for(&mut self, value: Value<'_>) {
        *self = match (&*self, value) {
            (Self::Bool(_), Value::Bool(_))
            | (Self::Int(_), Value::Int(_))
            | (Self::Float(_), Value::Float(_) | Value::Int(_))
            | (Self::Text { .. }, _) => return,
            (Self::Int(v), Value::Float(_)) => {
                Self::Float(v.iter().map(|v| v.map(|v| v as f64)).collect())
            }
            (narrow, _) => {
                let mut wide = Self::empty_for(Value::Text(""));
                for row in 0..narrow.len() {
                    match narrow.get(row) {
                        Some(value) => wide.set(row, Value::Text(&value.to_string())),
                        None => wide.pad_to(row + 1),
                    }
                }
                wide
            }
        };
    }

    fn set(&mut self, row: usize, value: Value<'_>) {
        if let Self::Text { text, present } = self {
            Self::set_text(text, present, row, &value.to_string());
            return;
        }
        match (self, value) {
            (Self::Bool(v), Value::Bool(x)) => v.set(row, x),
            (Self::Int(v), Value::Int(x)) => v.set(row, x),
            (Self::Float(v), Value::Float(x)) => v.set(row, x),
            (Self::Float(v), Value::Int(x)) => v.set(row, x as f64),
            _ => unreachable!("`widen_for` has widened the column for this value"),
        }
    }

    fn set_text(text: &mut TextColumn, present: &mut Vec<bool>, row: usize, value: &str) {
        if row < present.len() {
            // The buffer is flat, so replacing a text rebuilds it; setting a row twice is rare.
            let rows: Vec<String> = text.iter().map(str::to_owned).collect();
            let replaced = rows
                .iter()
                .enumerate()
                .map(|(i, old)| if i == row { value } else { old });
            *text = replaced.collect();
        } else {
            while text.len() < row {
                text.push("");
                present.push(false);
            }
            text.push(value);
            present.push(true);
        }
        present[row] = true;
    }

    fn pad_to(&mut self, rows: usize) {
        match self {
            Self::Bool(v) => v.pad_to(rows),
            Self::Int(v) => v.pad_to(rows),
            Self::Float(v) => v.pad_to(rows),
            Self::Text { text, present } => {
                while present.len() < rows {
                    text.push("");
                    present.push(false);
                }
            }
        }
    }

    fn heap_bytes(&self) -> usize {
        match self {
            Self::Bool(v) => v.heap_bytes(),
            Self::Int(v) => v.heap_bytes(),
            Self::Float(v) => v.heap_bytes(),
            Self::Text { text, present } => text.heap_bytes() + present.capacity(),
        }
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
}

impl std::fmt::Display for Value<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Bool(v) => v.fmt(f),
            Self::Int(v) => v.fmt(f),
            // Files often store `f32`: 0.3 must not print as 0.30000001192092896.
            Self::Float(v) if f64::from(*v as f32) == *v => (*v as f32).fmt(f),
            Self::Float(v) => v.fmt(f),
            Self::Text(v) => f.write_str(v),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn copies_the_values_of_a_row() {
        let mut attributes = Attributes::default();
        let values = [
            ("is_wide", Value::Bool(true)),
            ("lanes", Value::Int(2)),
            ("speed", Value::Float(0.5)),
            ("zone", Value::Text("Hall A")),
        ];
        for (name, value) in values {
            attributes.set(1, name, value);
        }
        attributes.copy_row(1, 4);
        attributes.copy_row(0, 5);
        for (name, value) in values {
            let column = &attributes.get(name).unwrap().values;
            assert_eq!(column.get(4), Some(value));
            assert_eq!((column.get(3), column.get(5)), (None, None));
        }
    }

    #[test]
    fn column_widens_to_the_type_of_its_values() {
        let mut attributes = Attributes::default();
        attributes.set(1, "speed", Value::Int(2));
        attributes.set(2, "speed", Value::Float(0.5));
        let speed = |a: &Attributes, row| {
            a.get("speed")
                .unwrap()
                .values
                .get(row)
                .map(|v| v.to_string())
        };
        assert_eq!(speed(&attributes, 0), None);
        assert_eq!(
            attributes.get("speed").unwrap().values.get(1),
            Some(Value::Float(2.0))
        );
        attributes.set(4, "speed", Value::Text("fast"));
        assert_eq!(speed(&attributes, 2).as_deref(), Some("0.5"));
        assert_eq!(speed(&attributes, 3), None);
        attributes.set(2, "speed", Value::Text("slow"));
        assert_eq!(speed(&attributes, 2).as_deref(), Some("slow"));
        assert_eq!(speed(&attributes, 4).as_deref(), Some("fast"));
    }
}
