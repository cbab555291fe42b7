//! Limit check: counts elements and nesting depth of a JSON text before it is parsed.

use guideway_layout::Limits;

use crate::Problem;
use crate::text::ElementCounter;

/// Checks a text against the limits. It need not be valid JSON.
///
/// # Errors
/// When there are more elements or levels than the limits.
pub(super) fn check(text: &str, limits: &Limits) -> Result<(), Problem> {
    let nesting = count_nesting(text.as_bytes());
    let is_within = nesting.max_depth <= limits.depth as i64 && nesting.elements <= limits.elements;
    // Surplus closing brackets make the depth that follows look smaller.
    if is_within && nesting.min_depth >= 0 {
        return Ok(());
    }
    find_violation(text, limits)
}

/// Nesting and size of a text.
#[derive(Debug, Default)]
struct Nesting {
    max_depth: i64,
    min_depth: i64,
    elements: u64,
}

/// Per byte outside of strings: the change of the depth, and the number of elements that begin.
pub(super) const STEPS: [(i8, u8); 256] = {
    let mut steps = [(0, 0); 256];
    steps[b'{' as usize] = (1, 1);
    steps[b'[' as usize] = (1, 1);
    steps[b'}' as usize] = (-1, 0);
    steps[b']' as usize] = (-1, 0);
    steps[b',' as usize] = (0, 1);
    steps
};

/// Counts without branches except for quotes, because it visits every byte of a large file.
fn count_nesting(bytes: &[u8]) -> Nesting {
    let (mut depth, mut nesting) = (0, Nesting::default());
    let mut rest = bytes.iter();
    while let Some(&byte) = rest.next() {
        if byte == b'"' {
            skip_string(&mut rest);
            continue;
        }
        let (deeper, elements) = STEPS[usize::from(byte)];
        depth += i64::from(deeper);
        nesting.max_depth = nesting.max_depth.max(depth);
        nesting.min_depth = nesting.min_depth.min(depth);
        nesting.elements += u64::from(elements);
    }
    nesting
}

/// Skips to the byte after the quote that ends a string.
fn skip_string(rest: &mut std::slice::Iter<'_, u8>) {
    while let Some(byte) = rest.next() {
        match byte {
            b'"' => return,
            b'\\' => drop(rest.next()),
            _ => {}
        }
    }
}

/// Finds the place at which a text exceeds the limits.
fn find_violation(text: &str, limits: &Limits) -> Result<(), Problem> {
    let mut counter = ElementCounter::new(text, limits);
    let mut rest = text.as_bytes().iter();
    while let Some(&byte) = rest.next() {
        if byte == b'"' {
            skip_string(&mut rest);
            continue;
        }
        let (deeper, elements) = STEPS[usize::from(byte)];
        if elements > 0 {
            counter.count()?;
        }
        match deeper {
            1 => counter.enter(text.len() - rest.len() - 1)?,
            -1 => counter.leave(),
            _ => {}
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn brackets_in_strings_do_not_count() {
        let text = r#"{"a[{,": ["\\", "\"[", {"b": [1, 2]}, "\\\"{"], "c": ","}"#;
        let nesting = count_nesting(text.as_bytes());
        assert_eq!((nesting.max_depth, nesting.elements), (4, 9));
    }

    #[test]
    fn count_and_search_agree_at_the_limit() {
        let text = r#"[[1, 2], {"]": [3, [4]]}]"#;
        for (depth, elements) in [(4, 8), (3, 8), (4, 7)] {
            let limits = Limits {
                depth,
                elements,
                ..Limits::default()
            };
            let is_within = (depth, elements) == (4, 8);
            assert_eq!(check(text, &limits).is_ok(), is_within);
            assert_eq!(find_violation(text, &limits).is_ok(), is_within);
        }
    }

    #[test]
    fn surplus_closing_brackets_do_not_hide_depth() {
        let limits = Limits {
            depth: 2,
            ..Limits::default()
        };
        assert!(check("]]][[", &limits).is_ok());
        assert!(check("]]][[[", &limits).is_err());
    }
}
