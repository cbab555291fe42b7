//! Casts of columns: numbers of any type, and dictionaries of numbers, to numbers of one type.

use arrow_array::cast::AsArray;
use arrow_array::types::{
    Decimal32Type, Decimal64Type, Decimal128Type, Decimal256Type, DecimalType, Float16Type,
    Float32Type, Float64Type, Int8Type, Int16Type, Int32Type, Int64Type, UInt8Type, UInt16Type,
    UInt32Type, UInt64Type,
};
use arrow_array::{
    AnyDictionaryArray, Array, ArrayRef, ArrowPrimitiveType, BooleanArray, Float64Array,
    PrimitiveArray,
};
use arrow_buffer::NullBuffer;
use arrow_schema::DataType;
use num_traits::{Float, NumCast, Zero};

use super::catch_decode_panic::catch_decode_panic;
use super::problems::damaged;
use crate::Problem;

/// Casts a column of numbers, or a dictionary of them; numbers that do not fit are null.
pub(super) fn numbers<T>(column: &ArrayRef) -> Result<PrimitiveArray<T>, Problem>
where
    T: ArrowPrimitiveType<Native: NumCast>,
{
    guarded(column, cast_numbers, "numbers")
}

/// Casts a column of truth values, or a dictionary of them.
pub(super) fn truth_values(column: &ArrayRef) -> Result<BooleanArray, Problem> {
    guarded(column, cast_truth_values, "truth values")
}

/// Returns the number of values that a cast set to null.
pub(super) fn count_lost(column: &ArrayRef, cast: &dyn Array) -> usize {
    let nulls = cast.logical_null_count();
    nulls.saturating_sub(column.logical_null_count())
}

fn guarded<T>(
    column: &ArrayRef,
    cast: fn(&dyn Array) -> Option<T>,
    expected: &str,
) -> Result<T, Problem> {
    catch_decode_panic("column", || {
        let other = || format!("expected {expected}, found {}", column.data_type());
        cast(column).ok_or_else(|| damaged("column", other()))
    })
}

fn cast_numbers<T>(column: &dyn Array) -> Option<PrimitiveArray<T>>
where
    T: ArrowPrimitiveType<Native: NumCast>,
{
    if let Some(same) = column.as_primitive_opt::<T>() {
        return Some(same.clone());
    }
    Some(match column.data_type() {
        DataType::Int8 => converted(column.as_primitive::<Int8Type>()),
        DataType::Int16 => converted(column.as_primitive::<Int16Type>()),
        DataType::Int32 => converted(column.as_primitive::<Int32Type>()),
        DataType::Int64 => converted(column.as_primitive::<Int64Type>()),
        DataType::UInt8 => converted(column.as_primitive::<UInt8Type>()),
        DataType::UInt16 => converted(column.as_primitive::<UInt16Type>()),
        DataType::UInt32 => converted(column.as_primitive::<UInt32Type>()),
        DataType::UInt64 => converted(column.as_primitive::<UInt64Type>()),
        DataType::Float16 => of_floats(column.as_primitive::<Float16Type>()),
        DataType::Float32 => of_floats(column.as_primitive::<Float32Type>()),
        DataType::Float64 => of_floats(column.as_primitive::<Float64Type>()),
        DataType::Decimal32(..) => converted(&of_decimals::<Decimal32Type>(column)),
        DataType::Decimal64(..) => converted(&of_decimals::<Decimal64Type>(column)),
        DataType::Decimal128(..) => converted(&of_decimals::<Decimal128Type>(column)),
        DataType::Decimal256(..) => converted(&of_decimals::<Decimal256Type>(column)),
        DataType::Dictionary(..) => {
            let dictionary = column.as_any_dictionary();
            let values = cast_numbers::<T>(dictionary.values())?;
            let rows = value_rows(dictionary);
            let present = |row: &Option<usize>| row.is_some_and(|row| values.is_valid(row));
            let nulls: NullBuffer = rows.iter().map(present).collect();
            let value = |row: Option<usize>| row.map_or_else(T::default_value, |r| values.value(r));
            PrimitiveArray::new(rows.into_iter().map(value).collect(), Some(nulls))
        }
        _ => return None,
    })
}

/// Converts floats, as [`converted`] does. A float with a fraction fits no whole number: pandas
/// makes floats of whole numbers with gaps, so whole ones do.
fn of_floats<S, T>(column: &PrimitiveArray<S>) -> PrimitiveArray<T>
where
    S: ArrowPrimitiveType<Native: Float>,
    T: ArrowPrimitiveType<Native: NumCast>,
{
    let is_whole = T::DATA_TYPE.is_integer();
    column.unary_opt(
        |number| match is_whole && number.fract() != S::Native::zero() {
            true => None,
            false => NumCast::from(number),
        },
    )
}

/// Converts numbers; those that do not fit are null.
pub(super) fn converted<S, T>(column: &PrimitiveArray<S>) -> PrimitiveArray<T>
where
    S: ArrowPrimitiveType<Native: NumCast>,
    T: ArrowPrimitiveType<Native: NumCast>,
{
    column.unary_opt(NumCast::from)
}

/// Rounds decimals to the nearest numbers.
fn of_decimals<T: DecimalType>(column: &dyn Array) -> Float64Array {
    let decimals = column.as_primitive::<T>();
    let number = |row| decimals.value_as_string(row).parse().ok();
    let rows = 0..decimals.len();
    rows.map(|row| number(row).filter(|_| decimals.is_valid(row)))
        .collect()
}

fn cast_truth_values(column: &dyn Array) -> Option<BooleanArray> {
    if let Some(same) = column.as_boolean_opt() {
        return Some(same.clone());
    }
    let dictionary = column.as_any_dictionary_opt()?;
    let values = cast_truth_values(dictionary.values())?;
    let value = |row: usize| values.is_valid(row).then(|| values.value(row));
    let rows = value_rows(dictionary).into_iter();
    Some(rows.map(|row| row.and_then(value)).collect())
}

/// Returns the row in the values of a dictionary that each of its keys names.
pub(super) fn value_rows(dictionary: &dyn AnyDictionaryArray) -> Vec<Option<usize>> {
    if dictionary.values().is_empty() {
        // All keys are null.
        return vec![None; dictionary.len()];
    }
    let rows = dictionary.normalized_keys().into_iter().enumerate();
    let keys = dictionary.keys();
    rows.map(|(at, row)| keys.is_valid(at).then_some(row))
        .collect()
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use arrow_array::builder::{Decimal128Builder, Decimal256Builder};
    use arrow_array::types::Int16Type;
    use arrow_array::{DictionaryArray, Float32Array, Int16Array, Int64Array, UInt64Array};
    use arrow_buffer::i256;

    use super::*;

    /// A dictionary whose keys are null, name a null, and name every value.
    fn dictionary_of(values: ArrayRef) -> ArrayRef {
        let last = values.len() as i16 - 1;
        let keys = Int16Array::from_iter([None, Some(last)].into_iter().chain((0..last).map(Some)));
        Arc::new(DictionaryArray::<Int16Type>::new(keys, values))
    }

    fn columns() -> Vec<ArrayRef> {
        let wide = || {
            let small = [-129, -128, -1, 0, 1, 127, 128, 255, 256, 65_535, 65_536];
            let large = [i64::MIN, i64::MAX, (1 << 53) + 1, 1 << 32, (1 << 31) - 1];
            let all = small.into_iter().chain(large).map(Some);
            Int64Array::from_iter(all.chain([None]))
        };
        let unsigned = [
            Some(0),
            Some(u64::MAX),
            Some((1 << 63) + 1),
            Some(255),
            None,
        ];
        let floats = [
            0.0,
            -0.0,
            0.1,
            1e300,
            -1e39,
            1e-320,
            f64::NAN,
            f64::INFINITY,
            65_520.0,
        ];
        let floats = Float64Array::from_iter(floats.map(Some).into_iter().chain([None]));
        let narrow: Float32Array = converted(&floats);
        let mut decimals = Decimal128Builder::new().with_data_type(DataType::Decimal128(38, 5));
        let mut wide_decimals =
            Decimal256Builder::new().with_data_type(DataType::Decimal256(76, -3));
        for digits in [
            0,
            1,
            -12_345,
            99_999_999_999_999_999_999_999_999_999_999_i128,
            i128::MIN,
        ] {
            decimals.append_value(digits);
            wide_decimals.append_value(i256::from_i128(digits));
        }
        decimals.append_null();
        wide_decimals.append_null();
        let columns: Vec<ArrayRef> = vec![
            Arc::new(converted::<_, Int8Type>(&wide())),
            Arc::new(converted::<_, Int16Type>(&wide())),
            Arc::new(converted::<_, Int32Type>(&wide())),
            Arc::new(wide()),
            Arc::new(converted::<_, UInt8Type>(&wide())),
            Arc::new(converted::<_, UInt16Type>(&wide())),
            Arc::new(converted::<_, UInt32Type>(&wide())),
            Arc::new(UInt64Array::from_iter(unsigned)),
            Arc::new(converted::<_, Float16Type>(&floats)),
            Arc::new(narrow),
            Arc::new(floats),
            Arc::new(decimals.finish()),
            Arc::new(wide_decimals.finish()),
        ];
        let dictionaries: Vec<ArrayRef> = columns.iter().cloned().map(dictionary_of).collect();
        columns.into_iter().chain(dictionaries).collect()
    }

    #[track_caller]
    fn assert_same_as_arrow<T>(column: &ArrayRef)
    where
        T: ArrowPrimitiveType<Native: NumCast>,
    {
        let expected = arrow_cast::cast(column, &T::DATA_TYPE).expect("a cast");
        let cast = numbers::<T>(column).expect("a cast");
        let text = format!("{} to {}", column.data_type(), T::DATA_TYPE);
        assert_eq!(format!("{cast:?}"), format!("{expected:?}"), "{text}");
        assert_eq!(
            count_lost(column, &cast),
            count_lost(column, &expected),
            "{text}"
        );
    }

    #[test]
    fn numbers_are_those_of_the_arrow_library() {
        for column in columns() {
            assert_same_as_arrow::<Float64Type>(&column);
            let decimal = matches!(
                column.data_type(),
                DataType::Decimal128(..) | DataType::Decimal256(..)
            );
            if decimal || matches!(column.data_type(), DataType::Dictionary(_, v) if v.is_decimal())
            {
                continue;
            }
            assert_same_as_arrow::<Float32Type>(&column);
            let values = match column.data_type() {
                DataType::Dictionary(_, values) => values,
                plain => plain,
            };
            // The library cuts fractions off.
            if values.is_floating() {
                continue;
            }
            assert_same_as_arrow::<Int64Type>(&column);
            assert_same_as_arrow::<Int32Type>(&column);
            assert_same_as_arrow::<Int8Type>(&column);
            assert_same_as_arrow::<UInt64Type>(&column);
            assert_same_as_arrow::<UInt32Type>(&column);
        }
    }

    #[test]
    fn whole_floats_are_whole_numbers_and_others_fit_none() {
        let floats: ArrayRef = Arc::new(Float64Array::from(vec![
            Some(2.0),
            None,
            Some(2.5),
            Some(-1.0),
            Some(f64::NAN),
        ]));
        let cast = numbers::<UInt32Type>(&floats).unwrap();
        let values: Vec<Option<u32>> = cast.iter().collect();
        assert_eq!(values, [Some(2), None, None, None, None]);
        assert_eq!(count_lost(&floats, &cast), 3);
    }

    #[test]
    fn dictionaries_of_truth_values_are_read() {
        let values = BooleanArray::from(vec![Some(true), Some(false), None]);
        let column = dictionary_of(Arc::new(values));
        let expected = arrow_cast::cast(&column, &DataType::Boolean).expect("a cast");
        let cast = truth_values(&column).expect("a cast");
        assert_eq!(&cast, expected.as_boolean());
        let empty = DictionaryArray::<Int16Type>::new(
            Int16Array::new_null(2),
            Arc::new(Int64Array::from(Vec::<i64>::new())),
        );
        let cast = numbers::<Int64Type>(&(Arc::new(empty) as ArrayRef)).expect("a cast");
        assert_eq!((cast.len(), cast.null_count()), (2, 2));
    }

    #[test]
    fn other_types_are_refused_by_name() {
        let texts: ArrayRef = Arc::new(arrow_array::StringArray::from(vec!["1"]));
        let problem = numbers::<Int64Type>(&texts).expect_err("a refusal");
        assert!(problem.to_string().contains("expected numbers, found Utf8"));
        assert!(truth_values(&texts).is_err());
    }
}
