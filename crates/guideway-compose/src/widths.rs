//! Chooses the widths of lines by what a picture shows: hairlines for drawings and for ways that
//! would cover each other, thin lines for other ways.

use guideway_layout::{Layout, PathRef};
use guideway_scene::{LineRule, View};
use guideway_spline::Point;

use crate::center_lines::{PARTS, rows_of_part, walk};

/// Shorter side of a picture whose lines have these widths, in pixels; larger ones have wider
/// lines.
const SIDE_PX: f64 = 1080.0;
const HAIRLINE_PX: f64 = 1.0;
const WAY_PX: f64 = 2.0;
/// Width of hairlines that still touch each other as ways.
const FINEST_PX: f64 = 0.6;

/// Side of a cell in which lines are counted, in points: a few lines with gaps that are seen.
const CELL: usize = 8;
/// Points of a cell on center lines from which on lines of two points leave no gaps. Derived: three
/// lines through a cell, 8 / 3 points apart.
const CROWDED: u32 = 3 * CELL as u32;
/// Least share of all points that are crowded.
const MANY: f64 = 0.2;

/// The widths that suit a layout in any view, in points: hairlines for drawings, else those of
/// tracks in meters. Lines with a width of their own keep it.
pub fn usual_widths(layout: &Layout) -> LineRule {
    match layout.is_drawing() {
        true => lines_of(HAIRLINE_PX),
        false => LineRule::default(),
    }
}

/// Lines of one width in pixels, at any scale.
fn lines_of(min_px: f64) -> LineRule {
    LineRule::World {
        width_m: 0.0,
        min_px,
        max_px: 12.0,
    }
}

/// The widths that suit a layout in a view. Lines with a width of their own keep it.
pub fn suitable_widths(layout: &Layout, view: &View, is_all_shown: bool) -> LineRule {
    let size = view.size();
    let side_px = f64::from(size.width().min(size.height()));
    let px_per_point = (side_px / SIDE_PX).max(1.0);
    let rule = match (layout.is_drawing(), is_all_shown) {
        (true, _) => usual_widths(layout),
        (false, true) if is_crowded(layout, view, px_per_point).0 => lines_of(FINEST_PX),
        (false, true) => lines_of(WAY_PX),
        (false, false) => return usual_widths(layout),
    };
    rule.scaled(px_per_point)
}

/// Returns `true` if many lines of two points would touch their neighbors, and the number of parts
/// of the paths that this took.
///
/// Cost: O(control points + points of the picture on paths); of those of a part of the paths, if
/// that part alone is enough.
fn is_crowded(layout: &Layout, view: &View, px_per_point: f64) -> (bool, usize) {
    let mut cells = Cells::new(view, px_per_point);
    let most = MANY * cells.reach(layout, view) as f64;
    for part in 0..PARTS {
        for row in rows_of_part(layout.paths.len(), part).flatten() {
            cells.mark(layout.paths.get(row), view);
        }
        // More paths add crowded points, and never more points than are within reach.
        if cells.count()[1] as f64 > most {
            return (true, part + 1);
        }
    }
    let [all, crowded] = cells.count();
    (crowded as f64 > MANY * all as f64, PARTS)
}

/// The points of a picture that are on center lines, by cell.
struct Cells {
    columns: usize,
    rows: usize,
    /// Points per pixel.
    scale: f64,
    /// A mask of the points of each cell: lines over each other count once.
    masks: Vec<u64>,
}

impl Cells {
    fn new(view: &View, px_per_point: f64) -> Self {
        let size = view.size();
        let [columns, rows] = [size.width(), size.height()]
            .map(|side| ((f64::from(side) / px_per_point).ceil() as usize).div_ceil(CELL));
        Self {
            columns,
            rows,
            scale: 1.0 / px_per_point,
            masks: vec![0; columns * rows],
        }
    }

    /// Most points that the center lines of a layout may have in these cells.
    fn reach(&self, layout: &Layout, view: &View) -> usize {
        let Some(bounds) = layout.paths.hull_bounds() else {
            return 0;
        };
        let corners = bounds
            .corners()
            .map(|p| view.pixel_from_world(p) * self.scale);
        let points = |at: fn(&Point<f64>) -> f64, cells: usize| {
            let least = corners.iter().map(at).fold(f64::INFINITY, f64::min);
            let most = corners.iter().map(at).fold(f64::NEG_INFINITY, f64::max);
            let end = (cells * CELL) as f64;
            (most.ceil().clamp(0.0, end) - least.floor().clamp(0.0, end)) as usize + 1
        };
        points(|p| p.x, self.columns) * points(|p| p.y, self.rows)
    }

    fn mark(&mut self, path: PathRef<'_>, view: &View) {
        let Self { columns, rows, .. } = *self;
        walk(path, view, self.scale, |x, y| {
            let (column, row) = (x / CELL, y / CELL);
            if column < columns && row < rows {
                self.masks[row * columns + column] |= 1 << (y % CELL * CELL + x % CELL);
            }
        });
    }

    /// Number of points on center lines, and of those in crowded cells.
    fn count(&self) -> [u64; 2] {
        let (mut all, mut crowded) = (0, 0);
        for points in self.masks.iter().map(|mask| mask.count_ones()) {
            all += u64::from(points);
            crowded += u64::from(if points > CROWDED { points } else { 0 });
        }
        [all, crowded]
    }
}

#[cfg(test)]
mod tests {
    use guideway_scene::FrameSize;

    use super::*;
    use crate::test_layouts::{numbers, straight_ways};

    fn radius_px(layout: &Layout, is_all_shown: bool, width: u32, height: u32) -> f64 {
        let size = FrameSize::new(width, height).unwrap();
        let view = View::new(size, Point::new(0.0, 0.0), 50.0).unwrap();
        suitable_widths(layout, &view, is_all_shown).radius_px(None, 50.0)
    }

    #[test]
    fn widths_suit_drawings_and_ways() {
        let radius_px = |format: &str, is_all_shown, width, height| {
            let mut layout = Layout::default();
            layout.provenance.format = format.to_owned();
            radius_px(&layout, is_all_shown, width, height)
        };
        assert_eq!(radius_px("DXF", true, 1920, 1080), 0.5);
        assert_eq!(radius_px("DXF", false, 300, 300), 0.5);
        assert_eq!(radius_px("LIF", true, 1920, 1080), 1.0);
        assert_eq!(radius_px("LIF", true, 6000, 4320), 4.0);
        assert_eq!(radius_px("LIF", false, 1920, 1080), 2.5);
    }

    #[test]
    fn usual_widths_are_those_of_a_part_of_a_picture() {
        for format in ["DXF", "LIF"] {
            let mut layout = Layout::default();
            layout.provenance.format = format.to_owned();
            let usual = usual_widths(&layout).radius_px(None, 50.0);
            assert_eq!(usual, radius_px(&layout, false, 1920, 1080), "{format}");
        }
    }

    /// 40 parallel ways, this far apart in pixels, each there and back.
    fn ways(apart_px: f64) -> Layout {
        let ends = (0..40).flat_map(|i| {
            let y = f64::from(i) * apart_px / 50.0;
            let ends = [Point::new(-5.0, y), Point::new(5.0, y)];
            [ends, [ends[1], ends[0]]]
        });
        let mut layout = straight_ways(ends);
        layout.provenance.format = "LIF".to_owned();
        layout
    }

    /// This many short ways at random places of a square of 10 m.
    fn scattered(count: u32) -> Layout {
        let mut unit = numbers();
        let mut next = || unit() * 10.0 - 5.0;
        straight_ways((0..count).map(|_| {
            let from = Point::new(next(), next());
            [from, from + Point::new(next(), next()) * 0.02]
        }))
    }

    #[test]
    fn a_crowd_is_known_by_a_part_of_its_paths() {
        let size = FrameSize::new(500, 500).unwrap();
        let view = View::new(size, Point::new(0.0, 0.0), 50.0).unwrap();
        let is_crowded = |count| is_crowded(&scattered(count), &view, 1.0);
        let (dense, parts) = is_crowded(200_000);
        assert!(dense && parts < 7, "{parts} parts");
        assert_eq!(is_crowded(5_000), (false, PARTS));
        // Whatever the number of parts, the answer is that of all paths.
        for count in [20_000, 30_000, 40_000, 50_000, 60_000, 80_000] {
            let layout = scattered(count);
            let mut cells = Cells::new(&view, 1.0);
            layout.paths.iter().for_each(|path| cells.mark(path, &view));
            let [all, crowded] = cells.count();
            let expected = crowded as f64 > MANY * all as f64;
            assert_eq!(
                super::is_crowded(&layout, &view, 1.0).0,
                expected,
                "{count}"
            );
        }
    }

    #[test]
    fn ways_that_would_cover_each_other_are_fine_lines() {
        assert_eq!(radius_px(&ways(2.0), true, 1920, 1080), 0.3);
        assert_eq!(radius_px(&ways(6.0), true, 1920, 1080), 1.0);
        assert_eq!(radius_px(&ways(2.0), false, 1920, 1080), 2.5);
    }
}
