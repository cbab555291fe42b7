//! Scale bar: a bar of round length in a lower corner, labeled with its length.

use guideway_scene::{DrawList, TextLine, View, round_step};
use guideway_spline::{Bounds, Point};

use super::legend::Corner;
use super::style::DecorationStyle;
use crate::text_format;

/// Least length of the bar, in points.
const MIN_LENGTH_POINTS: f64 = 80.0;
/// Half the thickness of the bar, in points.
const HALF_THICKNESS_POINTS: f64 = 1.0;
/// From the sides of the picture to the bar, in points.
const MARGIN_POINTS: f64 = 16.0;
/// From the left end of the bar to the left middle of its label, in points.
const LABEL_POINTS: Point<f64> = Point { x: 4.0, y: -12.0 };
/// Height of the ticks at both ends, in points.
const TICK_POINTS: f64 = 6.0;

/// Margin of [`scale_bar_box`] around bar and label, in points.
const BOX_MARGIN_POINTS: f64 = 8.0;

/// The scale bar of a view, at the bottom on the side of a corner. Its length is 1, 2 or 5 times a
/// power of ten meters.
pub fn scale_bar(view: &View, style: &DecorationStyle, corner: Corner) -> DrawList {
    let mut list = DrawList::default();
    let point_px = style.px_per_point;
    let [left, right] = ends_px(view, style, corner);
    let half = Point::new(1.0, 1.0) * (HALF_THICKNESS_POINTS * point_px);
    list.fill_rectangle(style.ink, left - half, right + half);
    for end in [left, right] {
        let tick = Point::new(0.0, TICK_POINTS * point_px);
        list.fill_rectangle(style.ink, end - half - tick, end + half);
    }
    list.texts.push(TextLine {
        text: text_format::length(length_m(view, style)),
        left_middle_px: left + LABEL_POINTS * point_px,
        angle_rad: 0.0,
        anchor: 0.0,
        char_width_px: style.label_size().char_px,
        color: style.ink,
        halo: style.paper,
    });
    list
}

/// Box of the scale bar and its label with a margin, in pixels, to keep clear of labels.
pub fn scale_bar_box(view: &View, style: &DecorationStyle, corner: Corner) -> Bounds<f64> {
    let point_px = style.px_per_point;
    let [left, right] = ends_px(view, style, corner);
    let label_top = LABEL_POINTS.y * point_px - style.label_size().line_px / 2.0;
    let bounds = Bounds {
        min: left + Point::new(0.0, label_top),
        max: right,
    };
    bounds.inflated(BOX_MARGIN_POINTS * point_px)
}

fn length_m(view: &View, style: &DecorationStyle) -> f64 {
    round_step(MIN_LENGTH_POINTS * style.px_per_point / view.px_per_m())
}

/// Both ends of the bar, in pixels.
fn ends_px(view: &View, style: &DecorationStyle, corner: Corner) -> [Point<f64>; 2] {
    let margin_px = MARGIN_POINTS * style.px_per_point;
    let length_px = length_m(view, style) * view.px_per_m();
    let x = match corner {
        Corner::UpperLeft | Corner::LowerLeft => margin_px,
        Corner::UpperRight | Corner::LowerRight => {
            f64::from(view.size().width()) - margin_px - length_px
        }
    };
    let left = Point::new(x, f64::from(view.size().height()) - margin_px);
    [left, left + Point::new(length_px, 0.0)]
}

#[cfg(test)]
mod tests {
    use guideway_scene::{FrameSize, Rgba};

    use super::*;

    #[test]
    fn bar_is_as_long_as_its_label_says() {
        let size = FrameSize::new(400, 300).unwrap();
        let view = View::new(size, Point::default(), 20.0).unwrap();
        for (px_per_point, label, length_px) in [(1.0, "5 m", 100.0), (2.0, "10 m", 200.0)] {
            let style = DecorationStyle::new(Rgba::WHITE, px_per_point);
            for (corner, is_left) in [(Corner::LowerLeft, true), (Corner::LowerRight, false)] {
                let list = scale_bar(&view, &style, corner);
                assert_eq!(list.texts[0].text, label);
                let bar = &list.fills[0].polygons[0];
                assert_eq!(bar[1].x - bar[0].x, length_px + 2.0 * px_per_point);
                assert_eq!(bar[0].x < 200.0 - length_px / 2.0, is_left);
            }
        }
    }
}
