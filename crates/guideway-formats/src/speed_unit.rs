//! Speeds of road maps: converts a number with a unit to meters per second.

/// Meters per second in one mile per hour, by definition of the mile.
const MILE_PER_HOUR: f64 = 0.447_04;

/// Kilometers per hour in one meter per second.
const KILOMETERS_PER_HOUR: f64 = 3.6;

/// Converts a speed to meters per second; `None` for a negative speed or an unknown unit.
pub(crate) fn to_si(speed: f64, unit: &str) -> Option<f64> {
    if !speed.is_finite() || speed < 0.0 {
        return None;
    }
    match unit.trim().to_ascii_lowercase().as_str() {
        "m/s" | "mps" => Some(speed),
        "km/h" | "kmh" | "kph" => Some(speed / KILOMETERS_PER_HOUR),
        "mph" => Some(speed * MILE_PER_HOUR),
        _ => None,
    }
}

/// Parses a speed such as `50`, `50 km/h` or `30mph`. A number alone is in `default_unit`.
pub(crate) fn parse(text: &str, default_unit: &str) -> Option<f64> {
    let text = text.trim();
    let is_of_number = |c: char| c.is_ascii_digit() || matches!(c, '.' | '-' | '+');
    let end = text.find(|c| !is_of_number(c)).unwrap_or(text.len());
    let (number, unit) = text.split_at(end);
    let unit = if unit.trim().is_empty() {
        default_unit
    } else {
        unit
    };
    to_si(number.parse().ok()?, unit)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parses_numbers_with_units() {
        for (text, expected) in [
            ("36", Some(10.0)),
            ("36 km/h", Some(10.0)),
            ("10mph", Some(4.4704)),
            ("2.5 m/s", Some(2.5)),
            ("-3", None),
            ("fast", None),
            ("5 knots", None),
        ] {
            assert_eq!(parse(text, "km/h"), expected, "{text}");
        }
    }
}
