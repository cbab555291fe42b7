//! What the colors of a picture mean, in its upper left corner.

use guideway::render::{DrawList, FrameSize, TextLine};
use guideway::scene::{Legend, LegendEntry, Rgba, Scene};
use guideway::spline::Point;

use super::Wishes;
use crate::cli::text;

/// Longest label, in characters.
const LABEL_CHARS: usize = 40;
const PAPER: Rgba = Rgba {
    a: 0xE6,
    ..Rgba::WHITE
};
const INK: Rgba = Rgba::BLACK;
const NOTHING: Rgba = Rgba {
    a: 0,
    ..Rgba::WHITE
};

/// The legend of a scene as it lies on a picture, if one is wished for and there is room; and what is to be said if there is
/// none.
pub(super) fn wished(scene: &Scene, wishes: &Wishes) -> (DrawList, Option<String>) {
    let legend = scene.legend().filter(|_| wishes.has_legend);
    match legend.map(|legend| sheet(legend, wishes.size)) {
        None => (DrawList::default(), None),
        Some(Some(sheet)) => (sheet, None),
        Some(None) => {
            let note = "the legend is larger than the picture, so it is only in this report";
            (DrawList::default(), Some(note.to_owned()))
        }
    }
}

/// None if it takes more room than there is.
fn sheet(legend: &Legend, size: FrameSize) -> Option<DrawList> {
    let (width, height) = (f64::from(size.width()), f64::from(size.height()));
    let line_px = match size.height() {
        0..1200 => 16.0,
        1200..2400 => 24.0,
        _ => 32.0,
    };
    let char_px = line_px * TextLine::CHAR_ASPECT;
    let (gap_px, swatch_px) = (line_px / 2.0, 2.0 * line_px);
    let title = text::plain(&legend.column, LABEL_CHARS);
    let labels: Vec<String> = legend.entries.iter().map(label).collect();
    let text_px = |text: &String| text.chars().count() as f64 * char_px;
    let widest_px = labels
        .iter()
        .map(|label| swatch_px + gap_px + text_px(label))
        .fold(text_px(&title), f64::max);

    let corner = Point::new(gap_px, gap_px);
    let lines_px = (labels.len() + 1) as f64 * line_px;
    let end = corner + Point::new(widest_px.ceil(), lines_px) + corner * 2.0;
    if end.x + gap_px > width || end.y + gap_px > height {
        return None;
    }
    let mut sheet = DrawList::default();
    sheet.fill_rectangle(PAPER, corner, end);
    let mut at_px = corner * 2.0 + Point::new(0.0, line_px / 2.0);
    let mut write = |text, at_px| {
        sheet.texts.push(TextLine {
            text,
            left_middle_px: at_px,
            char_width_px: char_px,
            color: INK,
            background: NOTHING,
        });
    };
    write(title, at_px);
    let after_swatch = Point::new(swatch_px + gap_px, 0.0);
    for label in labels {
        at_px.y += line_px;
        write(label, at_px + after_swatch);
    }
    for (i, entry) in legend.entries.iter().enumerate() {
        let top = corner * 2.0 + Point::new(0.0, (i as f64 + 1.25) * line_px);
        sheet.fill_rectangle(entry.color, top, top + Point::new(swatch_px, line_px / 2.0));
    }
    Some(sheet)
}

fn label(entry: &LegendEntry) -> String {
    let label = text::plain(&entry.label, LABEL_CHARS);
    match entry.paths {
        Some(paths) => format!("{label} ({})", text::count(paths)),
        None => label,
    }
}

#[cfg(test)]
mod tests {
    use guideway::render::{Frame, Strip, View};

    use super::super::sheet::Laid;
    use super::*;

    fn legend() -> Legend {
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
    fn the_legend_shows_its_colors_in_the_upper_left() {
        for (height, line) in [(200, 16), (1200, 24), (2400, 32)] {
            let size = FrameSize::new(800, height).unwrap();
            let view = View::new(size, Point::default(), 1.0).unwrap();
            let mut frame = Frame::new(size);
            frame.pixels_mut().fill([255; 4]);
            let sheet = sheet(&legend(), size).unwrap();
            Laid::new(&sheet, &view).onto(&Strip::whole(&view), &mut frame);
            let swatch = frame.pixels().iter().enumerate();
            let swatch: Vec<_> = swatch
                .filter(|(_, p)| **p == [200, 0, 0, 255])
                .map(|(at, _)| (at % 800, at / 800))
                .collect();
            assert_eq!(swatch.len(), 2 * line * (line / 2), "{line}");
            assert_eq!(swatch[0], (line, line + 5 * line / 4));
            let is_dark = |p: &[u8; 4]| p[1] < 64 && p[0] < 64;
            assert!(frame.pixels().iter().any(is_dark), "there is text");
            assert_eq!(frame.pixels().last(), Some(&[255; 4]));
        }
    }

    #[test]
    fn a_legend_that_is_larger_than_the_picture_is_none() {
        let size = FrameSize::new(60, 40).unwrap();
        assert_eq!(sheet(&legend(), size), None);
    }
}
