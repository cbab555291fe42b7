//! Scale bar: a bar of a round length in the lower left corner, with its length in meters.

use guideway_document::round_step;
use guideway_scene::{DrawList, Rgba, TextLine, View};
use guideway_spline::{Bounds, Point};

use super::options::DecorationStyle;
use crate::text_format;

/// Least length of the bar, in points: longer than its text.
const MIN_LENGTH: f64 = 80.0;
/// From the lower left corner of the picture to the left end of the bar, in points.
const LEFT_END: Point<f64> = Point { x: 16.0, y: -16.0 };
/// From the left end of the bar to the middle of its text, in points.
const TEXT: Point<f64> = Point { x: 4.0, y: -12.0 };
/// Height of the ticks at both ends, in points.
const TICK: f64 = 6.0;
/// Margin of the paper around bar and text, in points.
const MARGIN: f64 = 8.0;

/// The scale bar of a view. Its length is 1, 2 or 5 times a power of ten meters.
pub fn scale_bar(view: &View, style: &DecorationStyle) -> DrawList {
    let (point_px, ink) = (style.px_per_point, style.ink);
    let length_m = length_m(view, style);
    let [left, right] = ends(view, style);
    let mut list = DrawList::default();
    let half = Point::new(point_px, point_px);
    list.fill_rectangle(ink, left - half, right + half);
    for end in [left, right] {
        let top = Point::new(0.0, TICK * point_px);
        list.fill_rectangle(ink, end - half - top, end + half);
    }
    list.texts.push(TextLine {
        text: text_format::length(length_m),
        left_middle_px: left + TEXT * point_px,
        char_width_px: style.label_size().char_px,
        color: ink,
        background: Rgba::from_u32(0),
    });
    list
}

/// Box of bar and text with a margin, in pixels.
pub(super) fn scale_bar_box(view: &View, style: &DecorationStyle) -> Bounds<f64> {
    let point_px = style.px_per_point;
    let [left, right] = ends(view, style);
    let text_top = TEXT.y * point_px - style.label_size().line_px / 2.0;
    Bounds {
        min: left + Point::new(0.0, text_top),
        max: right,
    }
    .inflated(MARGIN * point_px)
}

fn length_m(view: &View, style: &DecorationStyle) -> f64 {
    round_step(MIN_LENGTH * style.px_per_point / view.px_per_m())
}

/// Both ends of the bar, in pixels.
fn ends(view: &View, style: &DecorationStyle) -> [Point<f64>; 2] {
    let corner = Point::new(0.0, f64::from(view.size().height()));
    let left = corner + LEFT_END * style.px_per_point;
    let length_px = length_m(view, style) * view.px_per_m();
    [left, left + Point::new(length_px, 0.0)]
}

#[cfg(test)]
mod tests {
    use guideway_scene::FrameSize;

    use super::*;

    #[test]
    fn bar_is_as_long_as_its_text_says() {
        let size = FrameSize::new(400, 300).unwrap();
        for (px_per_m, text, length_px) in [(40.0, "2 m", 80.0), (17.0, "5 m", 85.0)] {
            let view = View::new(size, Point::default(), px_per_m).unwrap();
            let style = DecorationStyle::new(Rgba::WHITE, 1.0);
            assert_eq!(scale_bar(&view, &style).texts[0].text, text);
            let [left, right] = ends(&view, &style);
            assert!((right.x - left.x - length_px).abs() < 1e-9, "{px_per_m}");
        }
    }
}
