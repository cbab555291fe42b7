//! Lengths and bends of the selected paths.

use guideway_document::measure::{Bend, bends};
use guideway_document::{PathSet, text_format};
use guideway_layout::Layout;

use crate::canvas::shape_text;
use crate::language::{grouped, say};

/// Most paths whose lengths are added up: more would delay the click that selects them.
const MAX_MEASURED: u64 = 20_000;

/// Lengths and bends of paths.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct PathShape {
    /// Length and tightest bend of one path, or the sum of the lengths of several.
    pub(super) text: String,
    /// Length of the only path; else 0.
    pub(super) length_m: f64,
    /// Bends of the only path.
    pub(super) bends: Vec<Bend>,
}

impl PathShape {
    /// Measures paths.
    pub(super) fn new(layout: &Layout, rows: &PathSet) -> Self {
        let path = |row: u32| layout.paths.get(row as usize);
        if let (1, Some(row)) = (rows.len(), rows.min()) {
            let bends = bends(path(row));
            return Self {
                text: shape_text(path(row), &bends),
                length_m: path(row).length_m(),
                bends,
            };
        }
        let text = if rows.len() > MAX_MEASURED {
            let most = grouped(MAX_MEASURED);
            say!(
                "select at most {most} paths to see the sum of their lengths",
                most
            )
        } else {
            let sum_m: f64 = rows.iter().map(|row| path(row).length_m()).sum();
            say!(
                "{length} long in total",
                length = text_format::length(sum_m)
            )
        };
        Self {
            text,
            ..Self::default()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::services::lanes;

    #[test]
    fn lengths_of_several_paths_are_added_up() {
        let layout = lanes(3);
        let one = PathShape::new(&layout, &[1].into_iter().collect());
        assert_eq!(one.text, "10 m long, straight");
        assert!(!one.bends.is_empty());
        let all = PathShape::new(&layout, &(0..3).collect());
        assert_eq!((&*all.text, all.bends.len()), ("30 m long in total", 0));
    }
}
