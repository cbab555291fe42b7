//! Cell formatter: writes values of a type that layouts do not have as text.

use std::cell::OnceCell;
use std::fmt::{self, Display, Formatter};

use arrow_array::cast::AsArray;
use arrow_array::types::Int64Type;
use arrow_array::{Array, ArrayRef, Int64Array};
use arrow_cast::display::{ArrayFormatter, FormatOptions};
use arrow_schema::DataType;

use super::cast::cast;
use super::catch_decode_panic::catch_decode_panic;

/// Formatter of the values of a column.
pub(super) struct CellFormatter<'a> {
    column: &'a ArrayRef,
    /// `None` if the library cannot format the type.
    library: Option<ArrayFormatter<'a>>,
    /// The stored numbers, where the library cannot format a value.
    numbers: OnceCell<Option<Int64Array>>,
}

/// A value, whose text fails if it has none.
pub(super) struct Cell<'f, 'a> {
    formatter: &'f CellFormatter<'a>,
    row: usize,
}

impl<'a> CellFormatter<'a> {
    pub(super) fn new(column: &'a ArrayRef) -> Self {
        const OPTIONS: FormatOptions<'static> = FormatOptions::new().with_display_error(false);
        let make = || Ok(ArrayFormatter::try_new(column, &OPTIONS).ok());
        Self {
            column,
            library: catch_decode_panic("attribute", make).ok().flatten(),
            numbers: OnceCell::new(),
        }
    }

    /// Returns the value of a row.
    pub(super) fn cell(&self, row: usize) -> Cell<'_, 'a> {
        Cell {
            formatter: self,
            row,
        }
    }

    /// Returns the stored number of a row, such as that of a time beyond the calendar.
    fn number(&self, row: usize) -> Option<i64> {
        let numbers = self.numbers.get_or_init(|| {
            let numbers = cast(self.column, &DataType::Int64).ok()?;
            Some(numbers.as_primitive::<Int64Type>().clone())
        });
        let numbers = numbers.as_ref()?;
        numbers.is_valid(row).then(|| numbers.value(row))
    }
}

impl Display for Cell<'_, '_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Cell { formatter, row } = self;
        let library = formatter.library.as_ref();
        let mut format = || Ok(library.map(|library| write!(f, "{}", library.value(*row))));
        match catch_decode_panic("attribute", &mut format) {
            Ok(Some(Ok(()))) => Ok(()),
            // The library writes nothing of a number that it cannot format.
            _ => match formatter.number(*row) {
                Some(number) => write!(f, "{number}"),
                None => Err(fmt::Error),
            },
        }
    }
}
