//! Title: one line of text at the top center of a picture.

use guideway_document::decorations::DecorationStyle;
use guideway_document::text_format;
use guideway_scene::{DrawList, FrameSize, Rgba, TextLine};
use guideway_spline::{Bounds, Point};

/// Size of the title, in lines of the legend.
const SIZE: f64 = 1.5;
/// Most characters.
const MAX_CHARS: usize = 80;
/// Opacity of the paper behind the title.
const PAPER_OPACITY: f64 = 0.9;

/// The title and its box. A title that is wider than the picture ends in `…`.
pub(super) fn title(
    text: &str,
    size: FrameSize,
    style: &DecorationStyle,
) -> (DrawList, Bounds<f64>) {
    let line_px = style.line_px();
    let char_width_px = SIZE * line_px * TextLine::CHAR_ASPECT;
    let width = f64::from(size.width());
    let fitting = ((width - 2.0 * line_px) / char_width_px).max(1.0) as usize;
    let mut line = TextLine {
        text: text_format::single_line(text, fitting.min(MAX_CHARS)),
        left_middle_px: Point::new(0.0, 1.25 * line_px),
        angle_rad: 0.0,
        anchor: 0.0,
        char_width_px,
        color: style.ink,
        halo: Rgba::from_u32(0),
    };
    let width_px = line.width_px();
    line.left_middle_px.x = ((width - width_px) / 2.0).max(line_px / 2.0);
    let half_height = Point::new(0.0, 0.75 * line_px);
    let paper = Bounds {
        min: line.left_middle_px - half_height,
        max: line.left_middle_px + half_height + Point::new(width_px, 0.0),
    };
    let paper = Bounds {
        min: paper.min - Point::new(line_px / 2.0, 0.0),
        max: paper.max + Point::new(line_px / 2.0, 0.0),
    };
    let mut list = DrawList::default();
    let color = style.paper.with_opacity(PAPER_OPACITY);
    list.fill_rectangle(color, paper.min, paper.max);
    list.texts.push(line);
    (list, paper)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn title_is_centered_and_inside() {
        let size = FrameSize::new(400, 300).unwrap();
        let style = DecorationStyle::new(Rgba::WHITE, 1.0);
        let (list, paper) = title("Halle Süd", size, &style);
        assert_eq!(list.texts[0].text, "Halle Süd");
        assert!((paper.center().x - 200.0).abs() < 1e-9);
        let (list, paper) = title(&"x".repeat(200), size, &style);
        assert!(list.texts[0].text.ends_with('…'));
        assert!(paper.max.x <= 400.0 + style.line_px());
    }
}
