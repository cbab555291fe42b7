//! [`Attributes`]: the further columns of a table, each with a name and one type.

use crate::{Quantity, Value, Values};

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

    /// Returns `true` if [`Self::set_rows`] with these arguments changes no other row, and neither
    /// the type nor the quantity of the column.
    pub fn fits(&self, name: &str, quantity: Option<Quantity>, values: &Values) -> bool {
        self.get(name).is_some_and(|column| {
            let has_quantity = quantity.is_none() || quantity == column.quantity;
            let holds = |value| column.values.holds(value);
            has_quantity && values.iter().flatten().all(holds)
        })
    }

    /// Sets the values of some rows of a column, which is created or widened as needed. `values`
    /// has one row per row, or one for all of them; a row without a value removes the old one.
    pub fn set_rows(
        &mut self,
        name: &str,
        quantity: Option<Quantity>,
        rows: impl IntoIterator<Item = usize>,
        values: &Values,
    ) {
        if self.get(name).is_none() {
            self.columns.push(Attribute::new(name, values.select(&[])));
        }
        let Some(column) = self.columns.iter_mut().find(|c| c.name == name) else {
            return;
        };
        column.quantity = quantity.or(column.quantity);
        values
            .iter()
            .flatten()
            .for_each(|value| column.values.widen_for(value));
        let is_one_for_all = values.len() == 1;
        for (at, row) in rows.into_iter().enumerate() {
            match values.get(if is_one_for_all { 0 } else { at }) {
                Some(value) => column.values.set(row, value),
                None if row < column.values.len() => column.values.clear(row),
                None => {}
            }
        }
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
    fn sets_rows_to_one_value_or_one_each() {
        let of = |values: &[Option<f64>]| -> Values {
            let values = values.iter().map(|v| v.map(Value::Float));
            values.collect()
        };
        let mut attributes = Attributes::default();
        let speed = Some(Quantity::Speed);
        let set = |a: &mut Attributes, rows: &[usize], values: &Values| {
            a.set_rows("speed", speed, rows.iter().copied(), values);
        };
        assert!(!attributes.fits("speed", speed, &of(&[])));
        set(&mut attributes, &[3, 1], &of(&[Some(2.0)]));
        assert!(attributes.fits("speed", None, &of(&[None, Some(1.0)])));
        assert!(!attributes.fits("speed", Some(Quantity::Length), &of(&[])));
        let text: Values = [Some(Value::Text("fast"))].into_iter().collect();
        assert!(!attributes.fits("speed", None, &text));
        set(&mut attributes, &[0, 3, 9], &of(&[Some(0.5), None, None]));
        let column = attributes.get("speed").unwrap();
        assert_eq!(column.quantity, speed);
        let cells: Vec<_> = column.values.iter().collect();
        let number = |value| Some(Value::Float(value));
        assert_eq!(cells, [number(0.5), number(2.0), None, None]);
    }

    #[test]
    fn whole_numbers_beyond_double_precision_keep_their_digits() {
        let serial = Value::Int((1 << 53) + 1);
        for (first, second) in [(serial, Value::Float(0.5)), (Value::Float(0.5), serial)] {
            let mut attributes = Attributes::default();
            attributes.set(0, "serial", first);
            attributes.set(1, "serial", second);
            let values = &attributes.get("serial").unwrap().values;
            let mut texts: Vec<_> = values.iter().flatten().map(|v| v.to_string()).collect();
            texts.sort();
            assert_eq!(texts, ["0.5", "9007199254740993"]);
        }
        let mut attributes = Attributes::default();
        attributes.set(0, "serial", Value::Int(1 << 53));
        attributes.set(1, "serial", Value::Float(0.5));
        let values = &attributes.get("serial").unwrap().values;
        assert_eq!(values.get(0), Some(Value::Float(9_007_199_254_740_992.0)));
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
