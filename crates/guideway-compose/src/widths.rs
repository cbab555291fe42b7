//! Chooses the widths of lines by what a picture shows: hairlines for drawings and for ways that
//! would cover each other, thin lines for other ways.

use guideway_layout::{Layout, PathRef};
use guideway_scene::{LineRule, View};
use guideway_spline::{Point, uniform};

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

/// The widths that suit a layout in a view. Lines with a width of their own keep it.
pub fn suitable_widths(layout: &Layout, view: &View, is_all_shown: bool) -> LineRule {
    let size = view.size();
    let side_px = f64::from(size.width().min(size.height()));
    let px_per_point = (side_px / SIDE_PX).max(1.0);
    let min_px = match (layout.is_drawing(), is_all_shown) {
        (true, _) => HAIRLINE_PX,
        (false, true) if is_crowded(layout, view, px_per_point) => FINEST_PX,
        (false, true) => WAY_PX,
        (false, false) => return LineRule::default(),
    };
    let rule = LineRule::World {
        width_m: 0.0,
        min_px,
        max_px: 12.0,
    };
    rule.scaled(px_per_point)
}

/// Returns `true` if many lines of two points would touch their neighbors.
///
/// Cost: O(control points + points of the picture on paths).
fn is_crowded(layout: &Layout, view: &View, px_per_point: f64) -> bool {
    let size = view.size();
    let [columns, rows] = [size.width(), size.height()]
        .map(|side| ((f64::from(side) / px_per_point).ceil() as usize).div_ceil(CELL));
    // A cell is a mask of its points: lines over each other count once.
    let mut cells = vec![0_u64; columns * rows];
    for path in layout.paths.iter() {
        mark(path, view, px_per_point, |x, y| {
            let (column, row) = (x / CELL, y / CELL);
            if column < columns && row < rows {
                cells[row * columns + column] |= 1 << (y % CELL * CELL + x % CELL);
            }
        });
    }
    let (mut all, mut crowded) = (0_u64, 0_u64);
    for points in cells.into_iter().map(u64::count_ones) {
        all += u64::from(points);
        crowded += u64::from(if points > CROWDED { points } else { 0 });
    }
    crowded as f64 > MANY * all as f64
}

/// Hands the points of a picture on a path to `at`, without those left of the picture or above it.
fn mark(path: PathRef<'_>, view: &View, px_per_point: f64, mut at: impl FnMut(usize, usize)) {
    /// Most steps of a segment: one across a wide picture.
    const MOST: f64 = 4096.0;
    for segment in path.runs().flat_map(|run| run.segments()) {
        let corners = segment.map(|p| view.pixel_from_world(p) * (1.0 / px_per_point));
        let reach = |a: Point<f64>, b: Point<f64>| a.distance(b);
        let length = reach(corners[0], corners[1])
            .max(reach(corners[1], corners[2]))
            .max(reach(corners[2], corners[3]));
        let steps = length.clamp(1.0, MOST).ceil();
        for step in 0..steps as u32 {
            let point = uniform::point(&corners, f64::from(step) / steps);
            if point.x >= 0.0 && point.y >= 0.0 {
                at(point.x as usize, point.y as usize);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use guideway_layout::NewPath;
    use guideway_scene::FrameSize;
    use guideway_spline::Runs;

    use super::*;

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

    /// 40 parallel ways, this far apart in pixels, each there and back.
    fn ways(apart_px: f64) -> Layout {
        let mut layout = Layout::default();
        layout.provenance.format = "LIF".to_owned();
        for i in 0..40 {
            let y = f64::from(i) * apart_px / 50.0;
            let ends = [Point::new(-5.0, y), Point::new(5.0, y)];
            for [from, to] in [ends, [ends[1], ends[0]]] {
                let mut runs = Runs::default();
                runs.push_line(from, to);
                layout.paths.push(&NewPath {
                    runs: &runs,
                    ..NewPath::default()
                });
            }
        }
        layout
    }

    #[test]
    fn ways_that_would_cover_each_other_are_fine_lines() {
        assert_eq!(radius_px(&ways(2.0), true, 1920, 1080), 0.3);
        assert_eq!(radius_px(&ways(6.0), true, 1920, 1080), 1.0);
        assert_eq!(radius_px(&ways(2.0), false, 1920, 1080), 2.5);
    }
}
