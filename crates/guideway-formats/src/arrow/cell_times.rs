//! Times of cells: writes dates, times, durations and intervals as text.

use std::fmt::{self, Debug, Display, Write};

use arrow_array::cast::AsArray;
use arrow_array::temporal_conversions::{
    as_datetime, as_datetime_with_timezone, as_duration, as_time, date32_to_datetime,
};
use arrow_array::timezone::Tz;
use arrow_array::types::{
    Date32Type, Date64Type, DurationMicrosecondType, DurationMillisecondType,
    DurationNanosecondType, DurationSecondType, IntervalDayTimeType, IntervalMonthDayNanoType,
    IntervalYearMonthType, Time32MillisecondType, Time32SecondType, Time64MicrosecondType,
    Time64NanosecondType, TimestampMicrosecondType, TimestampMillisecondType,
    TimestampNanosecondType, TimestampSecondType,
};
use arrow_array::{Array, ArrowPrimitiveType};
use arrow_schema::{DataType, IntervalUnit, TimeUnit};

/// Offset of times whose zone is not an offset: see `time_zones`.
const UTC: &str = "+00:00";

/// Writes the value of a row; fails for one that has no text. A null has an empty text.
pub(super) type CellWriter<'a> = Box<dyn Fn(usize, &mut dyn Write) -> fmt::Result + 'a>;

/// Text of a time beyond the calendar.
#[derive(Clone, Copy)]
pub(super) enum Beyond {
    /// Its number.
    Number,
    NoText,
}

/// Returns the writer of a column of times, `None` for other types.
pub(super) fn time_writer(array: &dyn Array, beyond: Beyond) -> Option<CellWriter<'_>> {
    use TimeUnit::{Microsecond, Millisecond, Nanosecond, Second};
    Some(match array.data_type() {
        DataType::Timestamp(unit, zone) => {
            let utc: Tz = UTC.parse().ok()?;
            let zone = zone.as_ref().map(|zone| zone.parse().unwrap_or(utc));
            match unit {
                Second => stamps::<TimestampSecondType>(array, zone, beyond),
                Millisecond => stamps::<TimestampMillisecondType>(array, zone, beyond),
                Microsecond => stamps::<TimestampMicrosecondType>(array, zone, beyond),
                Nanosecond => stamps::<TimestampNanosecondType>(array, zone, beyond),
            }
        }
        DataType::Date32 => calendar::<Date32Type, _>(array, beyond, |days| {
            date32_to_datetime(days).map(|time| time.date())
        }),
        DataType::Date64 => calendar::<Date64Type, _>(array, beyond, as_datetime::<Date64Type>),
        DataType::Time32(Second) => clock::<Time32SecondType>(array, beyond),
        DataType::Time32(Millisecond) => clock::<Time32MillisecondType>(array, beyond),
        DataType::Time64(Microsecond) => clock::<Time64MicrosecondType>(array, beyond),
        DataType::Time64(Nanosecond) => clock::<Time64NanosecondType>(array, beyond),
        DataType::Duration(Second) => durations::<DurationSecondType>(array),
        DataType::Duration(Millisecond) => durations::<DurationMillisecondType>(array),
        DataType::Duration(Microsecond) => durations::<DurationMicrosecondType>(array),
        DataType::Duration(Nanosecond) => durations::<DurationNanosecondType>(array),
        DataType::Interval(IntervalUnit::YearMonth) => {
            let months = array.as_primitive::<IntervalYearMonthType>();
            Box::new(|row, f| {
                let months = months.value(row);
                let (years, months) = (months.div_euclid(12), months.rem_euclid(12));
                write!(f, "{years} years {months} mons")
            })
        }
        DataType::Interval(IntervalUnit::DayTime) => {
            let intervals = array.as_primitive::<IntervalDayTimeType>();
            Box::new(|row, f| {
                let interval = intervals.value(row);
                let [day, milliseconds] = [interval.days, interval.milliseconds].map(i64::from);
                write_interval(f, &[(day, "days")], milliseconds, 3)
            })
        }
        DataType::Interval(IntervalUnit::MonthDayNano) => {
            let intervals = array.as_primitive::<IntervalMonthDayNanoType>();
            Box::new(|row, f| {
                let interval = intervals.value(row);
                let [month, day] = [interval.months, interval.days].map(i64::from);
                write_interval(
                    f,
                    &[(month, "mons"), (day, "days")],
                    interval.nanoseconds,
                    9,
                )
            })
        }
        _ => return None,
    })
}

/// Returns the writer of times that `convert` gives; it gives none beyond the calendar.
fn calendar<'a, T, D>(
    array: &'a dyn Array,
    beyond: Beyond,
    convert: impl Fn(T::Native) -> Option<D> + 'a,
) -> CellWriter<'a>
where
    T: ArrowPrimitiveType<Native: Display>,
    D: Debug,
{
    let values = array.as_primitive::<T>();
    Box::new(move |row, f| {
        let value = values.value(row);
        match (convert(value), beyond) {
            (Some(time), _) => write!(f, "{time:?}"),
            (None, Beyond::Number) => write!(f, "{value}"),
            (None, Beyond::NoText) => Err(fmt::Error),
        }
    })
}

fn clock<T>(array: &dyn Array, beyond: Beyond) -> CellWriter<'_>
where
    T: ArrowPrimitiveType<Native: Display + Into<i64>>,
{
    calendar::<T, _>(array, beyond, |value| as_time::<T>(value.into()))
}

fn stamps<T>(array: &dyn Array, zone: Option<Tz>, beyond: Beyond) -> CellWriter<'_>
where
    T: ArrowPrimitiveType<Native = i64>,
{
    let Some(zone) = zone else {
        return calendar::<T, _>(array, beyond, as_datetime::<T>);
    };
    calendar::<T, _>(array, beyond, move |value| {
        let time = as_datetime_with_timezone::<T>(value, zone)?.to_string();
        let mut parts = time.splitn(3, ' ');
        let [date, clock, offset] = [(); 3].map(|()| parts.next().unwrap_or_default());
        let offset = if offset == UTC { "Z" } else { offset };
        Some(Written(format!("{date}T{clock}{offset}")))
    })
}

/// A text that is its own debug form.
struct Written(String);

impl Debug for Written {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

fn durations<T: ArrowPrimitiveType<Native = i64>>(array: &dyn Array) -> CellWriter<'_> {
    let values = array.as_primitive::<T>();
    Box::new(|row, f| match as_duration::<T>(values.value(row)) {
        Some(duration) => write!(f, "{duration}"),
        None => f.write_str("<invalid>"),
    })
}

/// Writes the parts of an interval that are not 0; `time` has `digits` digits below the second.
fn write_interval(
    f: &mut dyn Write,
    whole: &[(i64, &str)],
    time: i64,
    digits: usize,
) -> fmt::Result {
    let per_second = 10_i64.pow(digits as u32);
    let minutes = time / per_second / 60;
    let clock = [(minutes / 60, "hours"), (minutes % 60, "mins")];
    let mut separator = "";
    for (count, unit) in whole.iter().chain(&clock).filter(|(count, _)| *count != 0) {
        write!(f, "{separator}{count} {unit}")?;
        separator = " ";
    }
    let (seconds, part) = (time / per_second % 60, time % per_second);
    if (seconds, part) != (0, 0) {
        let sign = if seconds < 0 || part < 0 { "-" } else { "" };
        let (seconds, part) = (seconds.abs(), part.abs());
        return write!(f, "{separator}{sign}{seconds}.{part:0digits$} secs");
    }
    match separator {
        "" => f.write_str("0 secs"),
        _ => Ok(()),
    }
}
