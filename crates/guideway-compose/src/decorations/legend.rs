//! Legend: the meaning of the colors of a picture, in its upper left corner.

use guideway_scene::{DrawList, FrameSize, Legend, LegendEntry, Rgba, TextLine};
use guideway_spline::{Bounds, Point};

use super::options::DecorationStyle;
use crate::text::line_width_px;
use crate::text_format;

/// Longest label, in characters.
const MAX_LABEL_CHARS: usize = 40;
/// Opacity of the paper behind the legend.
const PAPER_OPACITY: f64 = 0.9;

/// The legend and its box, `top_px` below the top of the picture; `None` if the picture is too
/// small for it.
///
/// ```text
///   column
///   ====  label (paths)
///   ====  label (paths)
/// ```
pub(super) fn legend(
    legend: &Legend,
    size: FrameSize,
    top_px: f64,
    style: &DecorationStyle,
) -> Option<(DrawList, Bounds<f64>)> {
    let (width, height) = (f64::from(size.width()), f64::from(size.height()));
    let line_px = style.line_px();
    let (gap_px, swatch_px) = (line_px / 2.0, 2.0 * line_px);
    let text_line = |text: String| TextLine {
        text,
        left_middle_px: Point::default(),
        char_width_px: line_px * TextLine::CHAR_ASPECT,
        color: style.ink,
        background: Rgba::from_u32(0),
    };
    let column = text_line(text_format::single_line(&legend.column, MAX_LABEL_CHARS));
    let labels: Vec<TextLine> = legend.entries.iter().map(label).map(text_line).collect();
    let widest_px = labels
        .iter()
        .map(|label| swatch_px + gap_px + line_width_px(label))
        .fold(line_width_px(&column), f64::max);

    let gap = Point::new(gap_px, gap_px);
    let corner = gap + Point::new(0.0, top_px);
    let lines_px = (labels.len() + 1) as f64 * line_px;
    let end = corner + Point::new(widest_px.ceil(), lines_px) + gap * 2.0;
    if end.x + gap_px > width || end.y + gap_px > height {
        return None;
    }
    let mut list = DrawList::default();
    list.fill_rectangle(
        DecorationStyle::faded(style.paper, PAPER_OPACITY),
        corner,
        end,
    );
    let top = corner + gap;
    let mut at_px = top + Point::new(0.0, line_px / 2.0);
    list.texts.push(TextLine {
        left_middle_px: at_px,
        ..column
    });
    for label in labels {
        at_px.y += line_px;
        list.texts.push(TextLine {
            left_middle_px: at_px + Point::new(swatch_px + gap_px, 0.0),
            ..label
        });
    }
    for (i, entry) in legend.entries.iter().enumerate() {
        let swatch = top + Point::new(0.0, (i as f64 + 1.25) * line_px);
        let size = Point::new(swatch_px, line_px / 2.0);
        list.fill_rectangle(entry.color, swatch, swatch + size);
    }
    let bounds = Bounds {
        min: corner,
        max: end,
    };
    Some((list, bounds))
}

fn label(entry: &LegendEntry) -> String {
    let label = text_format::single_line(&entry.label, MAX_LABEL_CHARS);
    match entry.paths {
        Some(paths) => format!("{label} ({})", text_format::count(paths)),
        None => label,
    }
}

#[cfg(test)]
mod tests {
    use guideway_scene::{Frame, Strip, View};

    use super::*;
    use crate::overlay::PreparedOverlay;

    fn speeds() -> Legend {
        Legend {
            column: "maxSpeed".into(),
            entries: vec![LegendEntry {
                label: "schnell é 漢".into(),
                color: Rgba::opaque(200, 0, 0),
                paths: Some(1234),
            }],
            is_continuous: false,
        }
    }

    #[test]
    fn swatches_and_labels_are_in_upper_left_corner() {
        for (height, line) in [(200, 16), (1200, 24), (2400, 32)] {
            let size = FrameSize::new(800, height).unwrap();
            let style = DecorationStyle::for_picture(size, Rgba::WHITE);
            let view = View::new(size, Point::default(), 1.0).unwrap();
            let mut frame = Frame::new(size);
            frame.pixels_mut().fill([255; 4]);
            let (list, _) = legend(&speeds(), size, 0.0, &style).unwrap();
            PreparedOverlay::new(&list, &view).draw(&Strip::whole(&view), &mut frame);
            let swatch = frame.pixels().iter().enumerate();
            let swatch: Vec<_> = swatch
                .filter(|(_, p)| **p == [200, 0, 0, 255])
                .map(|(at, _)| (at % 800, at / 800))
                .collect();
            assert_eq!(swatch.len(), 2 * line * (line / 2), "{line}");
            assert_eq!(swatch[0], (line, line + 5 * line / 4));
            let is_dark = |p: &[u8; 4]| p[1] < 96 && p[0] < 96;
            assert!(frame.pixels().iter().any(is_dark), "there is text");
            assert_eq!(frame.pixels().last(), Some(&[255; 4]));
        }
    }

    #[test]
    fn legend_larger_than_the_picture_is_left_out() {
        let size = FrameSize::new(60, 40).unwrap();
        let style = DecorationStyle::for_picture(size, Rgba::WHITE);
        assert!(legend(&speeds(), size, 0.0, &style).is_none());
    }
}
