//! Near names: the known names that a person may have meant by an unknown one.

/// Names that a suggestion lists at most.
const MAX_NEAR: usize = 3;

/// The known names nearest to an unknown one, nearest first: at most three, each within a third of
/// its letters, or one that contains the other. Case does not count.
///
/// Cost: the product of the lengths of both names, per known name.
pub fn near_names<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Vec<&'a str> {
    let wanted: Vec<char> = name.to_lowercase().chars().collect();
    let mut near: Vec<(usize, &str)> = Vec::new();
    for candidate in known {
        let letters: Vec<char> = candidate.to_lowercase().chars().collect();
        let length = wanted.len().max(letters.len());
        if wanted.is_empty() || letters.is_empty() || length > 200 {
            continue;
        }
        let most = (length / 3).max(1);
        let contains = |long: &[char], short: &[char]| {
            short.len() >= 3 && long.windows(short.len()).any(|part| part == short)
        };
        let distance = if wanted.len().abs_diff(letters.len()) <= most {
            distance(&wanted, &letters)
        } else {
            length
        };
        let is_part = contains(&letters, &wanted) || contains(&wanted, &letters);
        if distance <= most || is_part {
            near.push((distance, candidate));
            near.sort_by_key(|(distance, _)| *distance);
            near.truncate(MAX_NEAR);
        }
    }
    near.into_iter().map(|(_, name)| name).collect()
}

/// The least number of letters to insert, remove or replace, or of neighbors to exchange (optimal
/// string alignment, Boytsov 2011).
fn distance(a: &[char], b: &[char]) -> usize {
    let mut earlier = Vec::new();
    let mut last: Vec<usize> = (0..=b.len()).collect();
    for (i, from) in a.iter().enumerate() {
        let mut row = vec![i + 1];
        for (j, to) in b.iter().enumerate() {
            let replaced = last[j] + usize::from(from != to);
            let mut least = replaced.min(last[j + 1] + 1).min(row[j] + 1);
            let is_exchanged = i > 0 && j > 0 && a[i - 1] == *to && *from == b[j - 1];
            if is_exchanged {
                least = least.min(earlier[j - 1] + 1);
            }
            row.push(least);
        }
        earlier = std::mem::replace(&mut last, row);
    }
    last[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_typing_mistakes_and_parts() {
        let known = ["kink", "node-gap", "dead-end", "PICK-07", "PICK-08", "x"];
        for (name, near) in [
            ("knik", &["kink"][..]),
            ("nodegap", &["node-gap"]),
            ("DEAD_END", &["dead-end"]),
            ("pick-07", &["PICK-07", "PICK-08"]),
            ("07", &[]),
            ("gap", &["node-gap"]),
            ("quite-another", &[]),
            ("", &[]),
        ] {
            assert_eq!(near_names(name, known), near, "{name}");
        }
        assert_eq!(distance(&['a', 'b', 'c'], &['b', 'c', 'd']), 2);
    }
}
