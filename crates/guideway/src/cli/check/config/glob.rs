//! Patterns of file names: `?` stands for one character, `*` for any within a name, and `**` as a
//! whole part for any folders.

/// Returns `true` if a pattern fits a path whose parts `/` separates. A pattern without `/` fits
/// the name of a file in any folder.
///
/// Cost: at most the product of both lengths.
pub(super) fn fits(pattern: &str, path: &str) -> bool {
    let parts: Vec<&str> = path.split('/').collect();
    match pattern.contains('/') {
        false => part_fits(pattern, parts[parts.len() - 1]),
        true => {
            let patterns: Vec<&str> = pattern.trim_start_matches('/').split('/').collect();
            matches(
                &patterns,
                &parts,
                |pattern| *pattern == "**",
                |a, b| part_fits(a, b),
            )
        }
    }
}

/// Returns `true` if a name fits a pattern without folders.
fn part_fits(pattern: &str, name: &str) -> bool {
    let [pattern, name]: [Vec<char>; 2] = [pattern, name].map(|text| text.chars().collect());
    matches(&pattern, &name, |c| *c == '*', |a, b| *a == '?' || a == b)
}

/// Matches items with patterns, where a pattern that `is_any` fits any number of items.
fn matches<P, T>(
    patterns: &[P],
    items: &[T],
    is_any: impl Fn(&P) -> bool,
    fits: impl Fn(&P, &T) -> bool,
) -> bool {
    // reach[i]: the patterns so far fit the first i items.
    let mut reach = vec![false; items.len() + 1];
    reach[0] = true;
    for pattern in patterns {
        if is_any(pattern) {
            for i in 0..items.len() {
                reach[i + 1] |= reach[i];
            }
        } else {
            for i in (0..items.len()).rev() {
                reach[i + 1] = reach[i] && fits(pattern, &items[i]);
            }
            reach[0] = false;
        }
    }
    reach[items.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn patterns_fit_names_and_folders() {
        for (pattern, path, expected) in [
            ("*.dxf", "plans/old/hall.dxf", true),
            ("*.dxf", "hall.dxf.json", false),
            ("plans/*.dxf", "plans/hall.dxf", true),
            ("plans/*.dxf", "plans/old/hall.dxf", false),
            ("plans/**", "plans/old/hall.dxf", true),
            ("plans/**/hall.*", "plans/hall.dxf", true),
            ("**/old/*", "plans/old/hall.dxf", true),
            ("/hall?.json", "hall3.json", true),
            ("hall?.json", "hall.json", false),
            ("./a", "a", false),
        ] {
            assert_eq!(fits(pattern, path), expected, "{pattern} {path}");
        }
    }
}
