//! Formats numbers for sentences and tables: from a value to text with its unit.

/// Three significant digits, without an exponent.
pub fn digits(value: f64) -> String {
    let size = value.abs();
    let places = if size >= 99.95 {
        0
    } else if size >= 9.995 {
        1
    } else if size >= 0.9995 || size == 0.0 {
        2
    } else {
        // One more digit per zero after the decimal point.
        (2 - size.log10().floor() as i32).clamp(3, 9) as usize
    };
    format!("{value:.places$}")
}

/// A time in milliseconds, as `16.7 ms` or `1.50 s`.
pub fn time(ms: f64) -> String {
    if ms >= 999.5 {
        format!("{} s", digits(ms / 1e3))
    } else {
        format!("{} ms", digits(ms))
    }
}

/// A whole number with thousands separators.
pub fn count(value: u64) -> String {
    let digits = value.to_string();
    let mut grouped = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            grouped.push(',');
        }
        grouped.push(digit);
    }
    grouped
}

/// A ratio: `1.8 times`.
pub fn times(ratio: f64) -> String {
    format!("{} times", digits(ratio))
}

/// Bytes in megabytes, the unit of the thesis.
pub fn megabytes(bytes: u64) -> f64 {
    bytes as f64 / 1e6
}

/// A share in percent: 0.123 gives `12.3 %`.
pub fn percent(share: f64) -> String {
    let digits = digits(share * 100.0);
    let short = match digits.split_once('.') {
        Some(_) => digits.trim_end_matches('0').trim_end_matches('.'),
        None => &digits,
    };
    format!("{short} %")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formats_three_significant_digits() {
        let cases = [
            (0.0, "0.00"),
            (0.01234, "0.0123"),
            (0.5, "0.500"),
            (1.0, "1.00"),
            (9.996, "10.0"),
            (99.96, "100"),
            (1234.5, "1234"),
            (-2.5, "-2.50"),
        ];
        for (value, expected) in cases {
            assert_eq!(digits(value), expected);
        }
        assert_eq!(time(1500.0), "1.50 s");
        assert_eq!(time(16.67), "16.7 ms");
        assert_eq!(count(1_020_350), "1,020,350");
        let shares = [0.0, 0.00123, 0.123, 0.5, 1.0, 2.0].map(percent);
        assert_eq!(
            shares,
            ["0 %", "0.123 %", "12.3 %", "50 %", "100 %", "200 %"]
        );
    }
}
