//! Formats numbers of reports for people.

use guideway::layout::Value;

pub(crate) use guideway::compose::text_format::{count, counted, single_line};

/// A duration to three digits.
pub fn time(ms: f64) -> String {
    if ms < 9.995 {
        format!("{ms:.2} ms")
    } else if ms < 999.5 {
        format!("{ms:.0} ms")
    } else {
        format!("{:.2} s", ms / 1e3)
    }
}

/// A number of bytes with its unit.
pub(crate) fn bytes(n: u64) -> String {
    const UNITS: [&str; 4] = ["kB", "MB", "GB", "TB"];
    if n < 1000 {
        return format!("{n} bytes");
    }
    let mut value = n as f64 / 1e3;
    let mut unit = 0;
    while value >= 999.5 && unit + 1 < UNITS.len() {
        value /= 1e3;
        unit += 1;
    }
    let digits = if value < 9.95 { 1 } else { 0 };
    format!("{value:.digits$} {}", UNITS[unit])
}

/// A number without the digits of single precision: 0.3, not 0.30000001192092896.
pub(crate) fn number(value: f64) -> String {
    Value::Float(value).to_string()
}

/// A length in meters, to the millimeter, with its thousands separated.
pub(crate) fn meters(value: f64) -> String {
    if !value.is_finite() || value.abs() >= 1e15 {
        return format!("{value} m");
    }
    let rounded = format!("{:.3}", value.abs());
    let (whole, fraction) = rounded.split_once('.').unwrap_or((&rounded, "0"));
    let whole = whole.parse().map_or_else(|_| whole.to_owned(), count);
    let sign = if value < 0.0 { "-" } else { "" };
    let fraction = fraction.trim_end_matches('0');
    let point = if fraction.is_empty() { "" } else { "." };
    format!("{sign}{whole}{point}{fraction} m")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formats_counts_times_bytes_and_lengths() {
        assert_eq!(counted(1, "path"), "1 path");
        assert_eq!(counted(0, "path"), "0 paths");
        assert_eq!(time(0.1234), "0.12 ms");
        assert_eq!(time(9.999), "10 ms");
        assert_eq!(time(1234.5), "1.23 s");
        assert_eq!(bytes(12), "12 bytes");
        assert_eq!(bytes(1_250), "1.2 kB");
        assert_eq!(bytes(999_900), "1.0 MB");
        assert_eq!(meters(-1234.5), "-1,234.5 m");
        assert_eq!(meters(12.0), "12 m");
        assert_eq!(meters(0.9996), "1 m");
        assert_eq!(number(f64::from(0.3_f32)), "0.3");
        assert_eq!(number(0.1), "0.1");
        assert_eq!(number(f64::NAN), "NaN");
    }
}
