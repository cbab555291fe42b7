//! A window: a rectangle of tiles that is drawn at once.

use std::ops::Range;

/// Columns and rows of tiles.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Window {
    pub(crate) columns: Range<u32>,
    pub(crate) rows: Range<u32>,
}

impl Window {
    /// Number of tiles.
    pub(crate) fn tiles(&self) -> usize {
        self.columns.len() * self.rows.len()
    }

    /// Splits the window by rows, or by columns if it has one row. `None` if it is one tile.
    pub(crate) fn halves(&self) -> Option<[Self; 2]> {
        let cut = |range: &Range<u32>| range.start + range.len().div_ceil(2) as u32;
        if self.rows.len() > 1 {
            let middle = cut(&self.rows);
            let half = |rows| Self {
                columns: self.columns.clone(),
                rows,
            };
            Some([half(self.rows.start..middle), half(middle..self.rows.end)])
        } else if self.columns.len() > 1 {
            let middle = cut(&self.columns);
            let half = |columns| Self {
                columns,
                rows: self.rows.clone(),
            };
            Some([
                half(self.columns.start..middle),
                half(middle..self.columns.end),
            ])
        } else {
            None
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn halves_cover_each_tile_once() {
        let whole = Window {
            columns: 2..7,
            rows: 1..4,
        };
        let mut rest = vec![whole];
        let mut tiles = Vec::new();
        while let Some(window) = rest.pop() {
            match window.halves() {
                Some(halves) => rest.extend(halves),
                None => tiles.push((window.rows.start, window.columns.start)),
            }
        }
        tiles.sort_unstable();
        let all: Vec<_> = (1..4)
            .flat_map(|row| (2..7).map(move |c| (row, c)))
            .collect();
        assert_eq!(tiles, all);
    }
}
