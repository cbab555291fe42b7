//! Grid: vertical and horizontal lines at round coordinates.

use guideway_document::grid_lines_px;
use guideway_scene::{DrawList, View};
use guideway_spline::Point;

use super::options::DecorationStyle;

/// Least distance between lines, in points: fewer lines than paths.
const MIN_DISTANCE: f64 = 96.0;
/// Opacity of the lines: visible, and behind the paths.
const OPACITY: f64 = 0.12;

/// The grid of a view, a point wide. Lines are 1, 2 or 5 times a power of ten meters apart.
pub fn grid(view: &View, style: &DecorationStyle) -> DrawList {
    let mut list = DrawList::default();
    let color = DecorationStyle::faded(style.ink, OPACITY);
    let (half_px, size) = (style.px_per_point / 2.0, view.size());
    let end = Point::new(f64::from(size.width()), f64::from(size.height()));
    let [x_px, y_px] = grid_lines_px(view, MIN_DISTANCE * style.px_per_point);
    for x in x_px {
        let (left, right) = (x - half_px, x + half_px);
        list.fill_rectangle(color, Point::new(left, 0.0), Point::new(right, end.y));
    }
    for y in y_px {
        let (top, bottom) = (y - half_px, y + half_px);
        list.fill_rectangle(color, Point::new(0.0, top), Point::new(end.x, bottom));
    }
    list
}

#[cfg(test)]
mod tests {
    use guideway_scene::{FrameSize, Rgba};

    use super::*;

    #[test]
    fn lines_cross_the_picture_at_round_coordinates() {
        let size = FrameSize::new(400, 300).unwrap();
        let view = View::new(size, Point::new(0.0, 0.0), 20.0).unwrap();
        let list = grid(&view, &DecorationStyle::new(Rgba::WHITE, 1.0));
        let lines: Vec<_> = list.fills.iter().flat_map(|fill| &fill.polygons).collect();
        // 20 m x 15 m in steps of 5 m: 5 vertical lines, 3 horizontal ones.
        assert_eq!(lines.len(), 8);
        assert_eq!(lines[2][0], Point::new(199.5, 0.0));
        assert_eq!(lines[2][2], Point::new(200.5, 300.0));
    }
}
