//! Legend: the meaning of the colors, in a corner.

use guideway_scene::{DrawList, FrameSize, Legend, LegendEntry, LegendScale, TextLine};
use guideway_spline::{Bounds, Point};

use super::style::DecorationStyle;
use crate::text_format::{count, single_line};

/// Longest label, in characters.
const MAX_LABEL_CHARS: usize = 40;
/// Opacity of the paper behind the legend: paths shine through without making it hard to read.
const PAPER_OPACITY: f64 = 0.9;
/// Height of the bar of a scale, in lines.
const BAR_LINES: f64 = 9.0;
/// Width of that bar, in lines.
const BAR_WIDTH: f64 = 1.0;
/// Length and thickness of a tick beside it, in lines.
const TICK: Point<f64> = Point { x: 0.3, y: 0.08 };

/// A corner of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Corner {
    /// On the left, at the top.
    UpperLeft,
    /// On the right, at the top.
    UpperRight,
    /// On the right, at the bottom.
    LowerRight,
    /// On the left, at the bottom.
    LowerLeft,
}

impl Corner {
    /// All corners, clockwise.
    pub const ALL: [Self; 4] = [
        Self::UpperLeft,
        Self::UpperRight,
        Self::LowerRight,
        Self::LowerLeft,
    ];
}

/// The legend and its box in a corner of a picture of `size` pixels, whose upper `top_px` are
/// taken. `None` if the legend does not fit the picture.
///
/// ```text
/// +-------------------+
/// | column            |   line   = style.line_px()
/// | ==                |   bar    = 9 lines high, 1 line wide, if there is a scale
/// | ==- 1.5           |
/// | ==                |
/// | ====  label       |   swatch = 2 lines wide, 1/2 line high
/// | ====  label       |   gaps   = 1/2 line
/// +-------------------+
/// ```
pub fn legend(
    legend: &Legend,
    size: FrameSize,
    top_px: f64,
    corner: Corner,
    style: &DecorationStyle,
) -> Option<(DrawList, Bounds<f64>)> {
    let line_px = style.line_px();
    let (gap_px, swatch_px) = (line_px / 2.0, 2.0 * line_px);
    let tick_count = legend.scale.as_ref().map_or(0, |scale| scale.at.len());
    let (ticks, classes) = legend
        .entries
        .split_at(tick_count.min(legend.entries.len()));
    let title = text(single_line(&legend.title(), MAX_LABEL_CHARS), style);
    let labels_of = |entries: &[LegendEntry]| -> Vec<TextLine> {
        let labels = entries.iter().map(label);
        labels.map(|label| text(label, style)).collect()
    };
    let (of_ticks, labels) = (labels_of(ticks), labels_of(classes));
    let bar_px = legend
        .scale
        .as_ref()
        .map_or(0.0, |_| (BAR_LINES + 1.0) * line_px);
    let beside_bar_px = (BAR_WIDTH + TICK.x) * line_px + gap_px;
    let of_ticks_px = of_ticks
        .iter()
        .map(|label| beside_bar_px + label.width_px());
    let of_labels_px = labels
        .iter()
        .map(|label| swatch_px + gap_px + label.width_px());
    let widest_px = of_ticks_px
        .chain(of_labels_px)
        .fold(title.width_px(), f64::max);

    let gap = Point::new(gap_px, gap_px);
    let lines_px = (labels.len() + 1) as f64 * line_px + bar_px;
    let extent = Point::new(widest_px.ceil(), lines_px) + gap * 2.0;
    let min = place(extent, gap, size, top_px, corner)?;
    let max = min + extent;
    let mut list = DrawList::default();
    list.fill_rectangle(style.paper.with_opacity(PAPER_OPACITY), min, max);
    let mut at = min + gap;
    let put = |list: &mut DrawList, text: TextLine, left: f64, middle: f64| {
        let left_middle_px = Point::new(left, middle);
        list.texts.push(TextLine {
            left_middle_px,
            ..text
        });
    };
    put(&mut list, title, at.x, at.y + line_px / 2.0);
    at.y += line_px;
    if let Some(scale) = &legend.scale {
        let top = at + Point::new(0.0, line_px / 2.0);
        bar(&mut list, scale, top, style);
        for (label, share) in of_ticks.into_iter().zip(&scale.at) {
            let middle = top.y + (1.0 - share) * BAR_LINES * line_px;
            put(&mut list, label, at.x + beside_bar_px, middle);
        }
        at.y += bar_px;
    }
    for (label, entry) in labels.into_iter().zip(classes) {
        let swatch = at + Point::new(0.0, line_px / 4.0);
        let swatch_size = Point::new(swatch_px, line_px / 2.0);
        list.fill_rectangle(entry.color, swatch, swatch + swatch_size);
        put(
            &mut list,
            label,
            at.x + swatch_px + gap_px,
            at.y + line_px / 2.0,
        );
        at.y += line_px;
    }
    Some((list, Bounds { min, max }))
}

/// The upper left corner of a box of this extent in a corner of a picture, a gap away from its
/// sides. `None` if it does not fit.
fn place(
    extent: Point<f64>,
    gap: Point<f64>,
    size: FrameSize,
    top_px: f64,
    corner: Corner,
) -> Option<Point<f64>> {
    let first = gap + Point::new(0.0, top_px);
    let last = Point::new(f64::from(size.width()), f64::from(size.height())) - gap - extent;
    if first.x > last.x || first.y > last.y {
        return None;
    }
    Some(match corner {
        Corner::UpperLeft => first,
        Corner::UpperRight => Point::new(last.x, first.y),
        Corner::LowerRight => last,
        Corner::LowerLeft => Point::new(first.x, last.y),
    })
}

/// The bar of a scale below `top`, its highest number at the top, with ticks on the right.
fn bar(list: &mut DrawList, scale: &LegendScale, top: Point<f64>, style: &DecorationStyle) {
    let line_px = style.line_px();
    let (width_px, height_px) = (BAR_WIDTH * line_px, BAR_LINES * line_px);
    let count = scale.colors.len() as f64;
    for (i, color) in scale.colors.iter().enumerate() {
        let y = |i: f64| top.y + (1.0 - i / count) * height_px;
        let (low, high) = (y(i as f64), y(i as f64 + 1.0));
        // Each color reaches below the next one, so that no paper shows between them.
        let low = (low + 1.0).min(top.y + height_px);
        let corner = Point::new(top.x, high);
        list.fill_rectangle(*color, corner, Point::new(top.x + width_px, low));
    }
    let half = Point::new(0.0, TICK.y * line_px / 2.0);
    for share in &scale.at {
        let start = Point::new(top.x + width_px, top.y + (1.0 - share) * height_px);
        let end = start + Point::new(TICK.x * line_px, 0.0);
        list.fill_rectangle(style.ink, start - half, end + half);
    }
}

/// A line of text that has no place yet.
fn text(text: String, style: &DecorationStyle) -> TextLine {
    TextLine {
        text,
        left_middle_px: Point::default(),
        angle_rad: 0.0,
        anchor: 0.0,
        char_width_px: style.line_px() * TextLine::CHAR_ASPECT,
        color: style.ink,
        halo: style.paper.with_opacity(0.0),
    }
}

/// The value, and the number of its paths in a legend of classes.
fn label(entry: &LegendEntry) -> String {
    let label = single_line(&entry.label, MAX_LABEL_CHARS);
    match entry.paths {
        Some(paths) => format!("{label} ({})", count(paths)),
        None => label,
    }
}

#[cfg(test)]
mod tests {
    use guideway_scene::Rgba;

    use super::*;

    fn speeds() -> Legend {
        Legend {
            column: "maxSpeed".into(),
            unit: Some("m/s"),
            entries: vec![LegendEntry {
                label: "fast".into(),
                color: Rgba::opaque(200, 0, 0),
                paths: Some(1234),
            }],
            scale: None,
        }
    }

    #[test]
    fn swatch_and_label_share_a_line() {
        let size = FrameSize::new(800, 200).unwrap();
        let style = DecorationStyle::new(Rgba::WHITE, 1.0);
        let (list, _) = legend(&speeds(), size, 0.0, Corner::UpperLeft, &style).unwrap();
        let texts: Vec<_> = list.texts.iter().map(|text| text.text.as_str()).collect();
        assert_eq!(texts, ["maxSpeed (m/s)", "fast (1,234)"]);
        let swatch = &list.fills[1].polygons[0];
        let middle = (swatch[0].y + swatch[2].y) / 2.0;
        assert_eq!(middle, list.texts[1].left_middle_px.y);
    }

    #[test]
    fn a_long_label_keeps_the_number_of_its_paths() {
        let mut legend = speeds();
        legend.entries[0].label = "very ".repeat(9) + "fast";
        let size = FrameSize::new(800, 200).unwrap();
        let style = DecorationStyle::new(Rgba::WHITE, 1.0);
        let (list, _) = super::legend(&legend, size, 0.0, Corner::UpperLeft, &style).unwrap();
        let text = &list.texts[1].text;
        assert!(text.ends_with(" (1,234)"), "{text}");
        assert!(text.chars().count() <= MAX_LABEL_CHARS + "… (1,234)".chars().count());
    }

    #[test]
    fn a_legend_lies_in_its_corner() {
        let size = FrameSize::new(800, 200).unwrap();
        let style = DecorationStyle::new(Rgba::WHITE, 1.0);
        let boxes = Corner::ALL.map(|corner| {
            let (_, bounds) = legend(&speeds(), size, 10.0, corner, &style).unwrap();
            bounds.center()
        });
        let sides = boxes.map(|center| (center.x < 400.0, center.y < 100.0));
        assert_eq!(
            sides,
            [(true, true), (false, true), (false, false), (true, false)]
        );
    }

    #[test]
    fn a_legend_larger_than_the_picture_is_not_drawn() {
        let size = FrameSize::new(60, 40).unwrap();
        let style = DecorationStyle::new(Rgba::WHITE, 1.0);
        assert!(legend(&speeds(), size, 0.0, Corner::UpperLeft, &style).is_none());
    }

    #[test]
    fn a_scale_is_a_bar_whose_ticks_are_at_their_colors() {
        let mut legend = speeds();
        let (blue, red) = (Rgba::opaque(0, 0, 200), Rgba::opaque(200, 0, 0));
        legend.scale = Some(LegendScale {
            colors: vec![blue, red],
            at: vec![0.25, 0.75],
        });
        let entry = |label: &str, paths| LegendEntry {
            label: label.into(),
            color: blue,
            paths,
        };
        legend.entries = vec![
            entry("1", None),
            entry("2", None),
            entry("no value", Some(3)),
        ];
        let size = FrameSize::new(800, 400).unwrap();
        let style = DecorationStyle::new(Rgba::WHITE, 1.0);
        let (list, bounds) = super::legend(&legend, size, 0.0, Corner::LowerRight, &style).unwrap();
        let texts: Vec<_> = list.texts.iter().map(|text| text.text.as_str()).collect();
        assert_eq!(texts, ["maxSpeed (m/s)", "1", "2", "no value (3)"]);
        let box_of = |color| {
            let fill = list.fills.iter().find(|fill| fill.color == color).unwrap();
            Bounds::of_points(fill.polygons[0].iter().copied()).unwrap()
        };
        let (low, high) = (box_of(blue), box_of(red));
        assert!(high.max.y <= low.min.y + 2.0, "the larger number is above");
        assert!(low.min.y < list.texts[1].left_middle_px.y);
        assert!(list.texts[1].left_middle_px.y < low.max.y);
        let of_red = list.texts[2].left_middle_px.y;
        assert!(high.min.y < of_red && of_red < high.max.y);
        assert!(bounds.max.y <= 400.0 && bounds.max.x <= 800.0);
        assert!(bounds.contains(list.texts[3].left_middle_px));
    }
}
