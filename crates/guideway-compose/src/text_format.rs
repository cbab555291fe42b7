//! Formats counts, lengths and names for people: in legends, scale bars and reports.

/// A count with its thousands separated: `1,020,350`.
pub fn count(n: u64) -> String {
    let digits = n.to_string();
    let mut grouped = String::with_capacity(digits.len() + digits.len() / 3);
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            grouped.push(',');
        }
        grouped.push(digit);
    }
    grouped
}

/// A name from a file on one line: control characters are replaced, and names of more than
/// `max_chars` characters end in `…`.
pub fn single_line(text: &str, max_chars: usize) -> String {
    let safe = |c: char| if c.is_control() { '\u{fffd}' } else { c };
    let mut shown: String = text.chars().take(max_chars).map(safe).collect();
    if text.chars().nth(max_chars).is_some() {
        shown.push('…');
    }
    shown
}

/// A length with its unit: `12 km`, `5 m`, `200 mm`.
pub fn length(length_m: f64) -> String {
    // To a thousandth of the unit, without trailing zeros.
    let rounded = |value: f64| (value * 1e3).round() / 1e3;
    match length_m {
        m if m >= 10_000.0 => format!("{} km", rounded(m / 1000.0)),
        m if m >= 1.0 => format!("{} m", rounded(m)),
        m => format!("{} mm", rounded(m * 1000.0)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn groups_thousands() {
        assert_eq!(count(999), "999");
        assert_eq!(count(1_020_350), "1,020,350");
    }

    #[test]
    fn replaces_control_characters_and_truncates() {
        assert_eq!(single_line("a\u{1b}[31mb\n", 80), "a\u{fffd}[31mb\u{fffd}");
        assert_eq!(single_line("abcdef", 3), "abc…");
    }

    #[test]
    fn selects_unit_of_length() {
        assert_eq!(length(20_000.0), "20 km");
        assert_eq!(length(5.0), "5 m");
        assert_eq!(length(0.05), "50 mm");
    }
}
