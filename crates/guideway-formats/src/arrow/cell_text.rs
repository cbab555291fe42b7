//! Texts of cells: writes values of any Arrow type as text, and values within values.

use std::fmt::{self, Display, Write};
use std::ops::{Range, RangeInclusive};

use arrow_array::cast::AsArray;
use arrow_array::types::{
    Decimal32Type, Decimal64Type, Decimal128Type, Decimal256Type, DecimalType, Float16Type,
    Float32Type, Float64Type, Int8Type, Int16Type, Int32Type, Int64Type, RunEndIndexType,
    UInt8Type, UInt16Type, UInt32Type, UInt64Type,
};
use arrow_array::{Array, ArrowPrimitiveType, OffsetSizeTrait};
use arrow_schema::{DataType, UnionMode};

use super::cast::value_rows;
use super::cell_times::{Beyond, CellWriter, time_writer};

/// Returns the writer of a column. Times beyond the calendar are written as numbers if they are
/// not within other values.
///
/// `None` for a type that is not known.
pub(super) fn cell_writer(column: &dyn Array) -> Option<CellWriter<'_>> {
    writer(column, Beyond::Number)
}

fn writer(array: &dyn Array, beyond: Beyond) -> Option<CellWriter<'_>> {
    let of_value = value_writer(array, beyond)?;
    Some(Box::new(move |row, f| match array.is_null(row) {
        true => Ok(()),
        false => of_value(row, f),
    }))
}

fn value_writer(array: &dyn Array, beyond: Beyond) -> Option<CellWriter<'_>> {
    Some(match array.data_type() {
        DataType::Null => Box::new(|_, _| Ok(())),
        DataType::Boolean => {
            let values = array.as_boolean();
            Box::new(|row, f| write!(f, "{}", values.value(row)))
        }
        DataType::Int8 => displayed::<Int8Type>(array),
        DataType::Int16 => displayed::<Int16Type>(array),
        DataType::Int32 => displayed::<Int32Type>(array),
        DataType::Int64 => displayed::<Int64Type>(array),
        DataType::UInt8 => displayed::<UInt8Type>(array),
        DataType::UInt16 => displayed::<UInt16Type>(array),
        DataType::UInt32 => displayed::<UInt32Type>(array),
        DataType::UInt64 => displayed::<UInt64Type>(array),
        DataType::Float16 => displayed::<Float16Type>(array),
        DataType::Float32 => {
            let values = array.as_primitive::<Float32Type>();
            Box::new(|row, f| write_float(f, &format!("{:e}", values.value(row)), -5..=13))
        }
        DataType::Float64 => {
            let values = array.as_primitive::<Float64Type>();
            Box::new(|row, f| write_float(f, &format!("{:e}", values.value(row)), -4..=16))
        }
        DataType::Decimal32(..) => decimals::<Decimal32Type>(array),
        DataType::Decimal64(..) => decimals::<Decimal64Type>(array),
        DataType::Decimal128(..) => decimals::<Decimal128Type>(array),
        DataType::Decimal256(..) => decimals::<Decimal256Type>(array),
        DataType::Utf8 => {
            let texts = array.as_string::<i32>();
            Box::new(|row, f| f.write_str(texts.value(row)))
        }
        DataType::LargeUtf8 => {
            let texts = array.as_string::<i64>();
            Box::new(|row, f| f.write_str(texts.value(row)))
        }
        DataType::Utf8View => {
            let texts = array.as_string_view();
            Box::new(|row, f| f.write_str(texts.value(row)))
        }
        DataType::Binary => {
            let bytes = array.as_binary::<i32>();
            Box::new(|row, f| write_hex(f, bytes.value(row)))
        }
        DataType::LargeBinary => {
            let bytes = array.as_binary::<i64>();
            Box::new(|row, f| write_hex(f, bytes.value(row)))
        }
        DataType::BinaryView => {
            let bytes = array.as_binary_view();
            Box::new(|row, f| write_hex(f, bytes.value(row)))
        }
        DataType::FixedSizeBinary(_) => {
            let bytes = array.as_fixed_size_binary();
            Box::new(|row, f| write_hex(f, bytes.value(row)))
        }
        DataType::Dictionary(..) => {
            let dictionary = array.as_any_dictionary();
            let values = writer(dictionary.values(), beyond)?;
            let rows = value_rows(dictionary);
            Box::new(move |row, f| rows[row].map_or(Ok(()), |at| values(at, f)))
        }
        DataType::RunEndEncoded(ends, _) => match ends.data_type() {
            DataType::Int16 => runs::<Int16Type>(array, beyond)?,
            DataType::Int32 => runs::<Int32Type>(array, beyond)?,
            DataType::Int64 => runs::<Int64Type>(array, beyond)?,
            _ => return None,
        },
        DataType::List(_) => lists::<i32>(array)?,
        DataType::LargeList(_) => lists::<i64>(array)?,
        DataType::ListView(_) => views::<i32>(array)?,
        DataType::LargeListView(_) => views::<i64>(array)?,
        DataType::FixedSizeList(_, _) => {
            let lists = array.as_fixed_size_list();
            let count = lists.value_length() as usize;
            items(lists.values(), move |row| row * count..(row + 1) * count)?
        }
        DataType::Struct(fields) => {
            let columns = array.as_struct().columns().iter();
            let columns = columns.map(|column| writer(column, Beyond::NoText));
            let columns = columns.collect::<Option<Vec<_>>>()?;
            Box::new(move |row, f| {
                let named = fields.iter().zip(&columns);
                list(f, ['{', '}'], named, |(field, column), f| {
                    write!(f, "{}: ", field.name())?;
                    column(row, f)
                })
            })
        }
        DataType::Map(_, _) => {
            let maps = array.as_map();
            let keys = writer(maps.keys(), Beyond::NoText)?;
            let values = writer(maps.values(), Beyond::NoText)?;
            let ends = maps.value_offsets();
            Box::new(move |row, f| {
                let entries = ends[row] as usize..ends[row + 1] as usize;
                list(f, ['{', '}'], entries, |at, f| {
                    keys(at, f)?;
                    f.write_str(": ")?;
                    values(at, f)
                })
            })
        }
        DataType::Union(fields, mode) => {
            let union = array.as_union();
            let kinds = fields.iter().map(|(id, field)| {
                Some((id, field.name(), writer(union.child(id), Beyond::NoText)?))
            });
            let kinds = kinds.collect::<Option<Vec<_>>>()?;
            Box::new(move |row, f| {
                let id = union.type_id(row);
                let at = match mode {
                    UnionMode::Dense => union.value_offset(row),
                    UnionMode::Sparse => row,
                };
                let (_, name, values) = kinds.iter().find(|kind| kind.0 == id).ok_or(fmt::Error)?;
                write!(f, "{{{name}=")?;
                values(at, f)?;
                f.write_char('}')
            })
        }
        _ => return time_writer(array, beyond),
    })
}

fn displayed<T: ArrowPrimitiveType<Native: Display>>(array: &dyn Array) -> CellWriter<'_> {
    let values = array.as_primitive::<T>();
    Box::new(|row, f| write!(f, "{}", values.value(row)))
}

fn decimals<T: DecimalType>(array: &dyn Array) -> CellWriter<'_> {
    let values = array.as_primitive::<T>();
    Box::new(|row, f| f.write_str(&values.value_as_string(row)))
}

fn runs<T: RunEndIndexType>(array: &dyn Array, beyond: Beyond) -> Option<CellWriter<'_>> {
    let runs = array.as_run::<T>();
    let values = writer(runs.values(), beyond)?;
    Some(Box::new(move |row, f| {
        values(runs.get_physical_index(row), f)
    }))
}

fn lists<O: OffsetSizeTrait>(array: &dyn Array) -> Option<CellWriter<'_>> {
    let lists = array.as_list::<O>();
    let ends = lists.value_offsets();
    items(lists.values(), |row| {
        ends[row].as_usize()..ends[row + 1].as_usize()
    })
}

fn views<O: OffsetSizeTrait>(array: &dyn Array) -> Option<CellWriter<'_>> {
    let views = array.as_list_view::<O>();
    items(views.values(), |row| {
        let start = views.value_offset(row).as_usize();
        start..start + views.value_size(row).as_usize()
    })
}

/// Returns the writer of lists, whose items have a range per row.
fn items<'a>(
    values: &'a dyn Array,
    range: impl Fn(usize) -> Range<usize> + 'a,
) -> Option<CellWriter<'a>> {
    let item = writer(values, Beyond::NoText)?;
    Some(Box::new(move |row, f| {
        list(f, ['[', ']'], range(row), &item)
    }))
}

fn list<T>(
    f: &mut dyn Write,
    [start, end]: [char; 2],
    items: impl IntoIterator<Item = T>,
    item: impl Fn(T, &mut dyn Write) -> fmt::Result,
) -> fmt::Result {
    f.write_char(start)?;
    for (at, value) in items.into_iter().enumerate() {
        if at > 0 {
            f.write_str(", ")?;
        }
        item(value, f)?;
    }
    f.write_char(end)
}

fn write_hex(f: &mut dyn Write, bytes: &[u8]) -> fmt::Result {
    bytes.iter().try_for_each(|byte| write!(f, "{byte:02x}"))
}

/// Writes a number, given as its shortest digits in scientific notation, without an exponent if it
/// has a number of digits before the point, negative for zeros behind it, within `plain`.
fn write_float(f: &mut dyn Write, scientific: &str, plain: RangeInclusive<i32>) -> fmt::Result {
    let parts = scientific.split_once('e');
    let Some((mantissa, Ok(exponent))) = parts.map(|(m, e)| (m, e.parse::<i32>())) else {
        return f.write_str(scientific);
    };
    let (sign, mantissa) = match mantissa.strip_prefix('-') {
        Some(mantissa) => ("-", mantissa),
        None => ("", mantissa),
    };
    let digits = mantissa.replace('.', "");
    let before_point = exponent + 1;
    if !plain.contains(&before_point) {
        return f.write_str(scientific);
    }
    match usize::try_from(before_point) {
        Ok(before) if before >= digits.len() => {
            write!(f, "{sign}{digits:0<before$}.0")
        }
        Ok(before @ 1..) => {
            write!(f, "{sign}{}.{}", &digits[..before], &digits[before..])
        }
        _ => {
            let width = digits.len() + before_point.unsigned_abs() as usize;
            write!(f, "{sign}0.{digits:0>width$}")
        }
    }
}
