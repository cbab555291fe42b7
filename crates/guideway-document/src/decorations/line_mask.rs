//! [`LineMask`]: how much of a box of the picture lines cover, by a coarse grid.

use guideway_layout::PathRef;
use guideway_scene::View;
use guideway_spline::{Bounds, uniform};

/// Side of a cell, in points.
const CELL_POINTS: f64 = 3.0;
/// Bits of a word.
const BITS: usize = u64::BITS as usize;
/// Most cells along a side of the picture.
const MAX_CELLS: f64 = 2_000.0;
/// Most samples of a curve segment.
const MAX_SAMPLES: f64 = 4_096.0;

/// The cells of a picture that lines cross, one bit per cell. A box takes a few words of each of
/// its rows.
pub(super) struct LineMask {
    cell_px: f64,
    columns: usize,
    rows: usize,
    words_per_row: usize,
    words: Vec<u64>,
}

impl LineMask {
    /// The mask of paths in a view.
    pub(super) fn new<'a>(
        paths: impl Iterator<Item = PathRef<'a>>,
        view: &View,
        px_per_point: f64,
    ) -> Self {
        let (width, height) = (
            f64::from(view.size().width()),
            f64::from(view.size().height()),
        );
        let cell_px = (CELL_POINTS * px_per_point).max(width.max(height) / MAX_CELLS);
        let cells = |side_px: f64| (side_px / cell_px).ceil() as usize;
        let (columns, rows) = (cells(width), cells(height));
        let words_per_row = columns.div_ceil(BITS);
        let mut mask = Self {
            cell_px,
            columns,
            rows,
            words_per_row,
            words: vec![0; words_per_row * rows],
        };
        for path in paths {
            mask.mark(path, view);
        }
        mask
    }

    fn mark(&mut self, path: PathRef<'_>, view: &View) {
        let visible = view.world_bounds();
        for segment in path.runs().flat_map(|run| run.segments()) {
            if !Bounds::of_segment(&segment).intersects(visible) {
                continue;
            }
            let sides = segment.array_windows().map(|[a, b]| a.distance(*b));
            let longest_px = sides.sum::<f64>() * view.px_per_m();
            let samples = (2.0 * longest_px / self.cell_px)
                .clamp(1.0, MAX_SAMPLES)
                .ceil();
            for sample in 0..=samples as u32 {
                let at = uniform::point(&segment, f64::from(sample) / samples);
                let at_cell = view.pixel_from_world(at) * (1.0 / self.cell_px);
                let is_inside = at_cell.x >= 0.0
                    && at_cell.y >= 0.0
                    && at_cell.x < self.columns as f64
                    && at_cell.y < self.rows as f64;
                if is_inside {
                    let (column, row) = (at_cell.x as usize, at_cell.y as usize);
                    let word = row * self.words_per_row + column / BITS;
                    self.words[word] |= 1 << (column % BITS);
                }
            }
        }
    }

    /// The part of a box that lines cross, from 0 to 1.
    pub(super) fn coverage(&self, of: Bounds<f64>) -> f64 {
        let cell = |px: f64, end: usize| (px / self.cell_px).clamp(0.0, end as f64);
        let (left, top) = (cell(of.min.x, self.columns), cell(of.min.y, self.rows));
        let (right, bottom) = (cell(of.max.x, self.columns), cell(of.max.y, self.rows));
        let [left, top] = [left, top].map(|cell| cell.floor() as usize);
        let [right, bottom] = [right, bottom].map(|cell| cell.ceil() as usize);
        let cells = (right - left) * (bottom - top);
        if cells == 0 {
            return 0.0;
        }
        let of_row = |row: usize| {
            let words = self.words[row * self.words_per_row..].iter().zip(0..);
            let words = words.take(right.div_ceil(BITS)).skip(left / BITS);
            let bits = words.map(|(word, at)| {
                let first = left.saturating_sub(at * BITS).min(BITS - 1);
                let unused = (BITS * (at + 1)).saturating_sub(right);
                // Bits from `first` on, without the unused ones at the end.
                (word & (u64::MAX << first) & (u64::MAX >> unused)).count_ones()
            });
            bits.sum::<u32>()
        };
        let covered: u32 = (top..bottom).map(of_row).sum();
        f64::from(covered) / cells as f64
    }
}

#[cfg(test)]
mod tests {
    use guideway_layout::{Layout, NewPath};
    use guideway_scene::FrameSize;
    use guideway_spline::{Point, Runs};

    use super::*;

    #[test]
    fn bits_are_counted_across_words() {
        let (columns, rows) = (200, 3);
        let mut mask = LineMask {
            cell_px: 1.0,
            columns,
            rows,
            words_per_row: columns.div_ceil(BITS),
            words: vec![0; columns.div_ceil(BITS) * rows],
        };
        // Every third cell of the middle row.
        for column in (0..columns).step_by(3) {
            mask.words[mask.words_per_row + column / BITS] |= 1 << (column % BITS);
        }
        for (left, right) in [
            (0, 200),
            (1, 64),
            (63, 65),
            (64, 128),
            (60, 130),
            (199, 200),
        ] {
            let bounds = Bounds {
                min: Point::new(f64::from(left), 0.0),
                max: Point::new(f64::from(right), 3.0),
            };
            let counted = (left..right).filter(|column| column % 3 == 0).count() as f64;
            let cells = f64::from(3 * (right - left));
            assert_eq!(mask.coverage(bounds), counted / cells, "{left}..{right}");
        }
    }

    #[test]
    fn boxes_on_a_line_are_covered_and_others_are_not() {
        let mut layout = Layout::default();
        let mut runs = Runs::default();
        runs.push_line(Point::new(-100.0, 0.0), Point::new(100.0, 0.0));
        layout.paths.push(&NewPath {
            runs: &runs,
            ..NewPath::default()
        });
        let size = FrameSize::new(90, 60).unwrap();
        let view = View::new(size, Point::new(0.0, 0.0), 1.0).unwrap();
        let mask = LineMask::new(layout.paths.iter(), &view, 1.0);
        let at = |x: f64, y: f64| Bounds {
            min: Point::new(x, y),
            max: Point::new(x + 12.0, y + 9.0),
        };
        // The line is at 30 px from above.
        assert!(mask.coverage(at(20.0, 27.0)) > 0.2);
        assert_eq!(mask.coverage(at(20.0, 12.0)), 0.0);
        assert_eq!(
            mask.coverage(at(200.0, 27.0)),
            0.0,
            "outside of the picture"
        );
    }
}
