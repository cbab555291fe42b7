//! Legend: the meaning of the colors, in a corner.

use guideway_scene::{DrawList, FrameSize, Legend, LegendEntry, TextLine};
use guideway_spline::{Bounds, Point};

use super::style::DecorationStyle;
use crate::text_format::{count, single_line};

/// Longest label, in characters.
const MAX_LABEL_CHARS: usize = 40;
/// Opacity of the paper behind the legend: paths shine through without making it hard to read.
const PAPER_OPACITY: f64 = 0.9;

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
    let text_line = |text: String| TextLine {
        text,
        left_middle_px: Point::default(),
        char_width_px: line_px * TextLine::CHAR_ASPECT,
        color: style.ink,
        background: style.paper.with_opacity(0.0),
    };
    let column = text_line(single_line(&legend.title(), MAX_LABEL_CHARS));
    let labels: Vec<TextLine> = legend.entries.iter().map(label).map(text_line).collect();
    let widest_px = labels
        .iter()
        .map(|label| swatch_px + gap_px + label.width_px())
        .fold(column.width_px(), f64::max);

    let gap = Point::new(gap_px, gap_px);
    let lines_px = (labels.len() + 1) as f64 * line_px;
    let extent = Point::new(widest_px.ceil(), lines_px) + gap * 2.0;
    let first = gap + Point::new(0.0, top_px);
    let last = Point::new(f64::from(size.width()), f64::from(size.height())) - gap - extent;
    if first.x > last.x || first.y > last.y {
        return None;
    }
    let min = match corner {
        Corner::UpperLeft => first,
        Corner::UpperRight => Point::new(last.x, first.y),
        Corner::LowerRight => last,
        Corner::LowerLeft => Point::new(first.x, last.y),
    };
    let max = min + extent;
    let mut list = DrawList::default();
    list.fill_rectangle(style.paper.with_opacity(PAPER_OPACITY), min, max);
    let corner = min + gap;
    for (i, entry) in legend.entries.iter().enumerate() {
        let swatch = corner + Point::new(0.0, (i as f64 + 1.25) * line_px);
        let swatch_size = Point::new(swatch_px, line_px / 2.0);
        list.fill_rectangle(entry.color, swatch, swatch + swatch_size);
    }
    let mut left_middle_px = corner + Point::new(0.0, line_px / 2.0);
    list.texts.push(TextLine {
        left_middle_px,
        ..column
    });
    left_middle_px.x += swatch_px + gap_px;
    for label in labels {
        left_middle_px.y += line_px;
        list.texts.push(TextLine {
            left_middle_px,
            ..label
        });
    }
    Some((list, Bounds { min, max }))
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
            is_continuous: false,
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
}
