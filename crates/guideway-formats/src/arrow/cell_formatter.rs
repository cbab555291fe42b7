//! Cell formatter: shows values of a type that layouts do not have as text.

use std::fmt::{self, Display, Formatter};

use arrow_array::Array;

use super::catch_decode_panic::catch_decode_panic;
use super::cell_text::cell_writer;
use super::cell_times::CellWriter;

/// Formatter of the values of a column.
pub(super) struct CellFormatter<'a> {
    /// `None` if the type has no texts.
    writer: Option<CellWriter<'a>>,
}

/// A value, whose text fails if it has none.
pub(super) struct Cell<'f, 'a> {
    formatter: &'f CellFormatter<'a>,
    row: usize,
}

impl<'a> CellFormatter<'a> {
    pub(super) fn new(column: &'a dyn Array) -> Self {
        let writer = catch_decode_panic("attribute", || Ok(cell_writer(column)));
        Self {
            writer: writer.ok().flatten(),
        }
    }

    /// Returns the value of a row.
    pub(super) fn cell(&self, row: usize) -> Cell<'_, 'a> {
        Cell {
            formatter: self,
            row,
        }
    }
}

impl Display for Cell<'_, '_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let writer = self.formatter.writer.as_ref().ok_or(fmt::Error)?;
        catch_decode_panic("attribute", || Ok(writer(self.row, f))).unwrap_or(Err(fmt::Error))
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use arrow_array::builder::{
        Decimal128Builder, Int32Builder, MapBuilder, StringBuilder, StringRunBuilder, UnionBuilder,
    };
    use arrow_array::types::*;
    use arrow_array::{
        ArrayRef, ArrowPrimitiveType, BinaryArray, BinaryViewArray, BooleanArray, DictionaryArray,
        FixedSizeListArray, Float32Array, Float64Array, Int64Array, ListArray, NullArray,
        PrimitiveArray, StructArray, UInt64Array,
    };
    use arrow_buffer::{IntervalDayTime, IntervalMonthDayNano, OffsetBuffer};
    use arrow_cast::display::{ArrayFormatter, FormatOptions};
    use arrow_schema::{DataType, Field};

    use super::*;

    /// Compares the texts with those of the Arrow library.
    #[track_caller]
    fn assert_same_as_arrow(column: &dyn Array) {
        const OPTIONS: FormatOptions<'static> = FormatOptions::new().with_display_error(false);
        let library = ArrayFormatter::try_new(column, &OPTIONS).expect("a formatter");
        let own = CellFormatter::new(column);
        for row in 0..column.len() {
            let expected = library.value(row).try_to_string().expect("a text");
            assert_eq!(
                own.cell(row).to_string(),
                expected,
                "{}, row {row}",
                column.data_type()
            );
        }
    }

    fn item(values: &dyn Array) -> Arc<Field> {
        Arc::new(Field::new("item", values.data_type().clone(), true))
    }

    fn plain() -> Vec<ArrayRef> {
        let mut decimals = Decimal128Builder::new().with_data_type(DataType::Decimal128(20, 3));
        decimals.extend([Some(0), Some(-5), Some(1_234_567), None]);
        let mut numbers = MapBuilder::new(None, StringBuilder::new(), Int32Builder::new());
        for count in 0..4 {
            for n in 0..count {
                numbers.keys().append_value(format!("k{n}"));
                numbers.values().append_option((n != 1).then_some(n));
            }
            numbers.append(count != 3).expect("an entry");
        }
        let mut kinds = UnionBuilder::new_dense();
        kinds.append::<Int32Type>("a", 7).expect("a value");
        kinds.append::<Float64Type>("b", 0.5).expect("a value");
        kinds.append_null::<Int32Type>("a").expect("a value");
        kinds.append::<Int32Type>("a", -1).expect("a value");
        let mut runs = StringRunBuilder::<Int32Type>::new();
        runs.extend([Some("x"), Some("x"), None, Some("y")]);
        vec![
            Arc::new(NullArray::new(4)),
            Arc::new(BooleanArray::from(vec![
                Some(true),
                Some(false),
                None,
                None,
            ])),
            Arc::new(Int64Array::from(vec![
                Some(i64::MIN),
                Some(0),
                None,
                Some(i64::MAX),
            ])),
            Arc::new(UInt64Array::from(vec![
                Some(u64::MAX),
                Some(0),
                None,
                Some(1),
            ])),
            Arc::new(decimals.finish()),
            Arc::new(BinaryArray::from(vec![&b"\x00\xff"[..], b"", b"a", b"bc"])),
            Arc::new(BinaryViewArray::from(vec![&b"\x01"[..], b"", b"a", b"bc"])),
            Arc::new(DictionaryArray::<Int32Type>::from_iter([
                Some("a"),
                None,
                Some("b"),
                Some("a"),
            ])),
            Arc::new(numbers.finish()),
            Arc::new(kinds.build().expect("a union")),
            Arc::new(runs.finish()),
        ]
    }

    #[test]
    fn texts_are_those_of_the_arrow_library() {
        for values in plain() {
            assert_same_as_arrow(&values);
            let ends = OffsetBuffer::from_lengths([0, 3, 1]);
            let nulls = Some(vec![true, true, false].into());
            let lists = ListArray::new(item(&values), ends, Arc::clone(&values), nulls);
            assert_same_as_arrow(&lists);
            let views = [
                DataType::ListView(item(&values)),
                DataType::LargeList(item(&values)),
            ];
            for view in views {
                assert_same_as_arrow(&arrow_cast::cast(&lists, &view).expect("a cast"));
            }
            let pairs = FixedSizeListArray::new(item(&values), 2, Arc::clone(&values), None);
            assert_same_as_arrow(&pairs);
            let field = |name| Arc::new(Field::new(name, values.data_type().clone(), true));
            let both = [(field("a"), Arc::clone(&values)), (field("b"), values)];
            assert_same_as_arrow(&StructArray::from(both.to_vec()));
        }
    }

    #[test]
    fn floats_are_those_of_the_arrow_library() {
        let powers = (-330..310).flat_map(|e| [format!("1e{e}"), format!("-1.2345678901e{e}")]);
        let powers = powers.map(|text| text.parse::<f64>().expect("a number"));
        let odd = [
            0.0,
            -0.0,
            0.1,
            f64::NAN,
            f64::INFINITY,
            f64::NEG_INFINITY,
            5e-324,
            f64::MAX,
        ];
        let all: Vec<f64> = powers.chain(odd).collect();
        let narrow: Vec<f32> = all.iter().map(|&n| n as f32).collect();
        assert_same_as_arrow(&Float64Array::from(all));
        assert_same_as_arrow(&Float32Array::from(narrow));
    }

    const TIMES: [i64; 9] = [
        0,
        -1,
        1,
        86_399,
        1_714_557_600,
        1_714_557_600_123,
        1_714_557_600_123_456,
        -62_135_596_801,
        -1_714_557_600_123_456,
    ];

    fn assert_of<T: ArrowPrimitiveType>(numbers: &[T::Native]) {
        let rows = numbers.iter().copied().map(Some).chain([None]);
        assert_same_as_arrow(&rows.collect::<PrimitiveArray<T>>());
    }

    fn assert_stamps<T: ArrowPrimitiveType<Native = i64>>(numbers: &[i64]) {
        let rows = numbers.iter().copied().map(Some).chain([None]);
        let stamps: PrimitiveArray<T> = rows.collect();
        assert_same_as_arrow(&stamps);
        for zone in ["+00:00", "+02:00", "-05:30", "+0130"] {
            let data = stamps.to_data().into_builder();
            let DataType::Timestamp(unit, _) = T::DATA_TYPE else {
                panic!("no time stamp")
            };
            let zoned = data.data_type(DataType::Timestamp(unit, Some(zone.into())));
            assert_same_as_arrow(&PrimitiveArray::<T>::from(zoned.build().expect("an array")));
        }
    }

    #[test]
    fn times_are_those_of_the_arrow_library() {
        assert_stamps::<TimestampSecondType>(&TIMES[..6]);
        assert_stamps::<TimestampMillisecondType>(&TIMES);
        assert_stamps::<TimestampMicrosecondType>(&TIMES);
        assert_stamps::<TimestampNanosecondType>(&TIMES);
        assert_of::<Date32Type>(&[0, -1, 19_844, 9_999_999, -800_000]);
        assert_of::<Date64Type>(&TIMES);
        assert_of::<Time32SecondType>(&[0, 1, 86_399]);
        assert_of::<Time32MillisecondType>(&[0, 1, 86_399_999]);
        assert_of::<Time64MicrosecondType>(&[0, 1, 86_399_999_999]);
        assert_of::<Time64NanosecondType>(&[0, 1, 86_399_999_999_999]);
        assert_of::<DurationSecondType>(&[0, 90, -90, i64::MAX, i64::MIN]);
        assert_of::<DurationMillisecondType>(&[0, 90_500, -90_500, i64::MAX, i64::MIN]);
        assert_of::<DurationMicrosecondType>(&TIMES);
        assert_of::<DurationNanosecondType>(&TIMES);
    }

    #[test]
    fn intervals_are_those_of_the_arrow_library() {
        assert_of::<IntervalYearMonthType>(&[0, 1, 12, 25, -1, -13]);
        let milliseconds = [0, 1, 999, 1_000, 60_000, 3_723_004, -1, -61_001, -3_600_000];
        let day_times = milliseconds.map(|ms| [0, 3, -2].map(|d| IntervalDayTime::new(d, ms)));
        assert_of::<IntervalDayTimeType>(day_times.as_flattened());
        let nanoseconds = TIMES.map(|ns| [0, 3, -2].map(|n| IntervalMonthDayNano::new(n, -n, ns)));
        assert_of::<IntervalMonthDayNanoType>(nanoseconds.as_flattened());
    }

    #[test]
    fn a_time_beyond_the_calendar_is_a_number() {
        for (array, number) in [
            (
                &PrimitiveArray::<Date32Type>::from(vec![i32::MAX]) as &dyn Array,
                "2147483647",
            ),
            (&PrimitiveArray::<Time32SecondType>::from(vec![-1]), "-1"),
        ] {
            assert_eq!(CellFormatter::new(array).cell(0).to_string(), number);
        }
    }
}
