//! Formats counts, lengths and names for people: in legends, scale bars and reports.

use crate::is_hidden;

/// A count with thousands separators: `1,020,350`.
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

/// A count of things, whose plural ends in s: `1 step`, `1,020 steps`.
pub fn counted(n: u64, thing: &str) -> String {
    let end = if n == 1 { "" } else { "s" };
    format!("{} {thing}{end}", count(n))
}

/// A name from a file on one line: replaces characters that steer a terminal or reverse text, and
/// ends in `…` after `max_chars` characters.
pub fn single_line(text: &str, max_chars: usize) -> String {
    let printable = |c: char| if is_hidden(c) { '\u{fffd}' } else { c };
    let mut line: String = text.chars().take(max_chars).map(printable).collect();
    if text.chars().nth(max_chars).is_some() {
        line.push('…');
    }
    line
}

/// A length with a unit that suits its size, to a thousandth: `12.5 m`, `80 mm`, `15 km`.
pub fn length(length_m: f64) -> String {
    // `Display` prints no trailing zeros.
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
        assert_eq!(single_line("a\u{202e}b", 80), "a\u{fffd}b");
        assert_eq!(single_line("abcdef", 3), "abc…");
    }

    #[test]
    fn selects_the_unit_of_a_length() {
        assert_eq!(
            [0.08, 12.5, 15_000.0].map(length),
            ["80 mm", "12.5 m", "15 km"]
        );
    }
}
