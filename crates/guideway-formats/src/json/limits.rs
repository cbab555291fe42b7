//! How deep a text is nested and how many elements it has, before it is parsed.

use guideway_layout::Limits;

use crate::Problem;
use crate::text::ElementCounter;

/// Holds a text to the limits. It need not be sound JSON.
pub(super) fn check(text: &str, limits: &Limits) -> Result<(), Problem> {
    let extent = extent(text.as_bytes());
    let is_within = extent.deepest <= limits.depth as i64 && extent.elements <= limits.elements;
    // Where more ends than began, what follows is deeper than it seems.
    if is_within && extent.least_deep >= 0 {
        return Ok(());
    }
    find_excess(text, limits)
}

/// What a text takes.
#[derive(Debug, Default)]
struct Extent {
    deepest: i64,
    least_deep: i64,
    elements: u64,
}

/// By how much a byte outside of a text changes the depth, and how many elements it begins.
const STEPS: [(i8, u8); 256] = {
    let mut steps = [(0, 0); 256];
    steps[b'{' as usize] = (1, 1);
    steps[b'[' as usize] = (1, 1);
    steps[b'}' as usize] = (-1, 0);
    steps[b']' as usize] = (-1, 0);
    steps[b',' as usize] = (0, 1);
    steps
};

/// Every byte of a large file comes by here, so there is no branch but for quotes.
fn extent(bytes: &[u8]) -> Extent {
    let (mut depth, mut extent) = (0, Extent::default());
    let mut rest = bytes.iter();
    while let Some(&byte) = rest.next() {
        if byte == b'"' {
            skip_text(&mut rest);
            continue;
        }
        let (deeper, elements) = STEPS[usize::from(byte)];
        depth += i64::from(deeper);
        extent.deepest = extent.deepest.max(depth);
        extent.least_deep = extent.least_deep.min(depth);
        extent.elements += u64::from(elements);
    }
    extent
}

/// Goes past the quote that ends a text.
fn skip_text(rest: &mut std::slice::Iter<'_, u8>) {
    while let Some(byte) = rest.next() {
        match byte {
            b'"' => return,
            b'\\' => drop(rest.next()),
            _ => {}
        }
    }
}

/// The place at which a text exceeds the limits.
fn find_excess(text: &str, limits: &Limits) -> Result<(), Problem> {
    let mut counter = ElementCounter::new(text, limits);
    let mut rest = text.as_bytes().iter();
    while let Some(&byte) = rest.next() {
        if byte == b'"' {
            skip_text(&mut rest);
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
    fn texts_do_not_count() {
        let text = r#"{"a[{,": ["\\", "\"[", {"b": [1, 2]}, "\\\"{"], "c": ","}"#;
        let extent = extent(text.as_bytes());
        assert_eq!((extent.deepest, extent.elements), (4, 9));
    }

    #[test]
    fn both_ways_agree_at_the_limit() {
        let text = r#"[[1, 2], {"]": [3, [4]]}]"#;
        for (depth, elements) in [(4, 8), (3, 8), (4, 7)] {
            let limits = Limits {
                depth,
                elements,
                ..Limits::default()
            };
            let is_within = (depth, elements) == (4, 8);
            assert_eq!(check(text, &limits).is_ok(), is_within);
            assert_eq!(find_excess(text, &limits).is_ok(), is_within);
        }
    }

    #[test]
    fn ends_that_nothing_began_hide_no_depth() {
        let limits = Limits {
            depth: 2,
            ..Limits::default()
        };
        assert!(check("]]][[", &limits).is_ok());
        assert!(check("]]][[[", &limits).is_err());
    }
}
