//! The natural order of texts: numbers in them count by their size, letters without their case.

use std::cmp::Ordering;

/// Compares two texts: `lane 2` comes before `Lane 10`.
pub(crate) fn natural_order(a: &str, b: &str) -> Ordering {
    let (mut left, mut right) = (a, b);
    loop {
        let (Some(x), Some(y)) = (left.chars().next(), right.chars().next()) else {
            let rest = left.len().cmp(&right.len());
            return rest.then_with(|| a.cmp(b));
        };
        let order = if x.is_ascii_digit() && y.is_ascii_digit() {
            let (number, other) = (digits(left), digits(right));
            (left, right) = (&left[number.len()..], &right[other.len()..]);
            let [number, other] = [number, other].map(|n| n.trim_start_matches('0'));
            number.len().cmp(&other.len()).then(number.cmp(other))
        } else {
            (left, right) = (&left[x.len_utf8()..], &right[y.len_utf8()..]);
            x.to_lowercase().cmp(y.to_lowercase())
        };
        if order.is_ne() {
            return order;
        }
    }
}

/// The digits at the start of a text.
fn digits(text: &str) -> &str {
    let end = text.find(|c: char| !c.is_ascii_digit());
    &text[..end.unwrap_or(text.len())]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_count_by_their_size() {
        let mut names = [
            "b1",
            "a10",
            "A2",
            "a02x",
            "a",
            "a2",
            "é",
            "a99999999999999999999",
        ];
        names.sort_by(|a, b| natural_order(a, b));
        assert_eq!(
            names,
            [
                "a",
                "A2",
                "a2",
                "a02x",
                "a10",
                "a99999999999999999999",
                "b1",
                "é"
            ]
        );
    }
}
