//! [`Attributes`]: the further columns of a table, each with a name and one type.

use crate::{Cells, Quantity, TextCells};

/// Further columns of a table, in the order of the file.
///
/// A column may be shorter than its table: rows past its end have no value.
#[derive(Clone, Debug, Default, PartialEq)]
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
        let values = &mut self.column_mut(name, value).values;
        values.widen_for(value);
        values.set(row, value);
    }

    /// Sets a number of a physical quantity, in its SI unit.
    pub fn set_quantity(&mut self, row: usize, name: &str, value: f64, quantity: Quantity) {
        let value = Value::Float(value);
        let column = self.column_mut(name, value);
        column.quantity = Some(quantity);
        column.values.widen_for(value);
        column.values.set(row, value);
    }

    /// Removes the value of a row.
    pub fn clear(&mut self, row: usize, name: &str) {
        let column = self.columns.iter_mut().find(|c| c.name == name);
        if let Some(column) = column.filter(|c| row < c.values.len()) {
            column.values.clear(row);
        }
    }

    /// Removes a column and returns it.
    pub fn remove(&mut self, name: &str) -> Option<Attribute> {
        let index = self.columns.iter().position(|c| c.name == name)?;
        Some(self.columns.remove(index))
    }

    /// Copies the values of row `from` to row `to`.
    pub fn copy_row(&mut self, from: usize, to: usize) {
        for Attribute { values, .. } in &mut self.columns {
            values.copy_row(from, to);
        }
    }

    /// Appends the values of another table, whose row 0 becomes row `first_row`.
    pub fn extend(&mut self, first_row: usize, other: &Self) {
        for column in other.iter() {
            for row in 0..column.values.len() {
                if let Some(value) = column.values.get(row) {
                    self.set(first_row + row, &column.name, value);
                }
            }
            if let Some(own) = self.columns.iter_mut().find(|c| c.name == column.name) {
                own.quantity = own.quantity.or(column.quantity);
            }
        }
    }

    /// The given rows, in this order.
    #[must_use]
    pub fn select(&self, rows: &[usize]) -> Self {
        let select = |column: &Attribute| Attribute {
            values: column.values.select(rows),
            ..column.clone()
        };
        Self {
            columns: self.columns.iter().map(select).collect(),
        }
    }

    /// The column with this name.
    pub fn get(&self, name: &str) -> Option<&Attribute> {
        self.columns.iter().find(|c| c.name == name)
    }

    /// The value of a row, if it has one.
    pub fn value(&self, row: usize, name: &str) -> Option<Value<'_>> {
        self.get(name)?.values.get(row)
    }

    /// All columns, in the order of the file.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = &Attribute> {
        self.columns.iter()
    }

    /// Returns `true` if there are no columns.
    pub fn is_empty(&self) -> bool {
        self.columns.is_empty()
    }

    /// Heap bytes in use.
    pub fn heap_bytes(&self) -> usize {
        self.columns.iter().map(|c| c.values.heap_bytes()).sum()
    }

    /// The column with this name; a new one has the type of `value`.
    fn column_mut(&mut self, name: &str, value: Value<'_>) -> &mut Attribute {
        let known = self.columns.iter().position(|c| c.name == name);
        let index = known.unwrap_or_else(|| {
            let column = Attribute::new(name, Values::empty_for(value));
            self.columns.push(column);
            self.columns.len() - 1
        });
        &mut self.columns[index]
    }
}

/// One typed column. A row may lack a value; rows past the end lack one.
#[derive(Clone, Debug, PartialEq)]
pub struct Attribute {
    /// Name, which is unique in its table.
    pub name: String,
    /// One value per row.
    pub values: Values,
    /// Quantity that the numbers measure, in its SI unit; `None` if the unit is unknown.
    pub quantity: Option<Quantity>,
    /// Type in the file if it is narrower than the one in memory, such as `Int16`.
    pub source_type: Option<String>,
}

impl Attribute {
    /// A column without a known unit, with the same type in the file and in memory.
    pub fn new(name: impl Into<String>, values: Values) -> Self {
        Self {
            name: name.into(),
            values,
            quantity: None,
            source_type: None,
        }
    }

    /// Name for people, with the unit: `maxSpeed (m/s)`.
    pub fn label(&self) -> String {
        match self.quantity {
            Some(quantity) => format!("{} ({})", self.name, quantity.unit()),
            None => self.name.clone(),
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
    /// Text.
    Text(TextCells),
    /// JSON texts: lists and objects that have no type of their own.
    Json(TextCells),
}

impl Values {
    fn empty_for(value: Value<'_>) -> Self {
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

    fn widen_for(&mut self, value: Value<'_>) {
        *self = match (&*self, value) {
            (Self::Bool(_), Value::Bool(_))
            | (Self::Int(_), Value::Int(_))
            | (Self::Float(_), Value::Float(_) | Value::Int(_))
            | (Self::Json(_), Value::Json(_))
            | (Self::Text(_), _) => return,
            (Self::Int(v), Value::Float(_)) => {
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

    fn set(&mut self, row: usize, value: Value<'_>) {
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

    fn clear(&mut self, row: usize) {
        match self {
            Self::Bool(v) => v.clear(row),
            Self::Int(v) => v.clear(row),
            Self::Float(v) => v.clear(row),
            Self::Text(v) | Self::Json(v) => v.set(row, None),
        }
    }

    fn copy_row(&mut self, from: usize, to: usize) {
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

    fn heap_bytes(&self) -> usize {
        match self {
            Self::Bool(v) => v.heap_bytes(),
            Self::Int(v) => v.heap_bytes(),
            Self::Float(v) => v.heap_bytes(),
            Self::Text(v) | Self::Json(v) => v.heap_bytes(),
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
    /// JSON: a list or an object.
    Json(&'a str),
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
