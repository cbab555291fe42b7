//! A legend drawn into the picture's upper left corner.

use guideway::render::Frame;
use guideway::scene::{Legend, Rgba};
use noto_sans_mono_bitmap::{FontWeight, RasterHeight, get_raster, get_raster_width};

use crate::cli::text;

/// Longest label, in characters.
const LABEL_CHARS: usize = 40;
const PAPER: Rgba = Rgba::WHITE;
const INK: Rgba = Rgba::BLACK;
/// How much of the picture the paper hides.
const PAPER_OPACITY: f64 = 0.9;

/// Draws the legend over the picture, unless it takes more room than there is: then the picture stays as
/// it is and the answer is false.
pub(super) fn stamp(frame: &mut Frame, legend: &Legend) -> bool {
    let height = match frame.size().height() {
        0..1200 => RasterHeight::Size16,
        1200..2400 => RasterHeight::Size24,
        _ => RasterHeight::Size32,
    };
    let labels: Vec<String> = legend.entries.iter().map(label).collect();
    let title = text::plain(&legend.column, LABEL_CHARS);
    let line_px = height.val();
    let char_px = get_raster_width(FontWeight::Regular, height);
    let gap_px = line_px / 2;
    let text_px = |text: &str| text.chars().count() * char_px;
    let swatch_px = 2 * line_px;
    let entry_px = labels
        .iter()
        .map(|label| swatch_px + gap_px + text_px(label))
        .max();
    let box_px = (
        entry_px.unwrap_or(0).max(text_px(&title)) + 2 * gap_px,
        (labels.len() + 1) * line_px + 2 * gap_px,
    );
    let room_px = |side: u32| side as usize;
    let size = frame.size();
    if box_px.0 + 2 * gap_px > room_px(size.width())
        || box_px.1 + 2 * gap_px > room_px(size.height())
    {
        return false;
    }
    let mut sheet = Sheet { frame, height };
    sheet.fill((gap_px, gap_px), box_px, PAPER, PAPER_OPACITY);
    let (left, mut top) = (2 * gap_px, 2 * gap_px);
    sheet.write((left, top), &title);
    for (entry, label) in legend.entries.iter().zip(&labels) {
        top += line_px;
        let middle = (left, top + line_px / 4);
        sheet.fill(middle, (swatch_px, line_px / 2), entry.color, 1.0);
        sheet.write((left + swatch_px + gap_px, top), label);
    }
    true
}

fn label(entry: &guideway::scene::LegendEntry) -> String {
    let label = text::plain(&entry.label, LABEL_CHARS);
    match entry.paths {
        Some(paths) => format!("{label} ({})", text::count(paths)),
        None => label,
    }
}

struct Sheet<'a> {
    frame: &'a mut Frame,
    height: RasterHeight,
}

impl Sheet<'_> {
    fn fill(&mut self, corner: (usize, usize), size_px: (usize, usize), color: Rgba, opacity: f64) {
        for y in corner.1..corner.1 + size_px.1 {
            for x in corner.0..corner.0 + size_px.0 {
                self.blend((x, y), color, opacity);
            }
        }
    }

    fn write(&mut self, corner: (usize, usize), text: &str) {
        let mut left = corner.0;
        for char in text.chars() {
            let glyph = |c| get_raster(c, FontWeight::Regular, self.height);
            // The font has European letters; `?` stands for any other.
            let Some(glyph) = glyph(char).or_else(|| glyph('?')) else {
                continue;
            };
            for (y, row) in glyph.rows().enumerate() {
                for (x, &coverage) in row.iter().enumerate() {
                    self.blend((left + x, corner.1 + y), INK, f64::from(coverage) / 255.0);
                }
            }
            left += glyph.width();
        }
    }

    fn blend(&mut self, (x, y): (usize, usize), color: Rgba, opacity: f64) {
        let width = self.frame.size().width() as usize;
        let pixel = &mut self.frame.pixels_mut()[y * width + x];
        let [r, g, b, a] = *pixel;
        let mixed = Rgba { r, g, b, a }.lerp(color, opacity);
        *pixel = [mixed.r, mixed.g, mixed.b, mixed.a];
    }
}

#[cfg(test)]
mod tests {
    use guideway::render::FrameSize;
    use guideway::scene::LegendEntry;

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
    fn the_legend_shows_its_colours_in_the_upper_left() {
        let mut frame = Frame::new(FrameSize::new(400, 200).unwrap());
        frame.pixels_mut().fill([255; 4]);
        assert!(stamp(&mut frame, &legend()));
        let has = |color: [u8; 4]| frame.pixels().iter().position(|&p| p == color);
        assert!(has([200, 0, 0, 255]).is_some_and(|at| at % 400 < 100 && at / 400 < 60));
        assert!(has([0, 0, 0, 255]).is_some(), "there is text");
        assert_eq!(frame.pixels()[199 * 400 + 399], [255; 4]);
    }

    #[test]
    fn a_picture_too_small_for_the_legend_stays_as_it_is() {
        let mut frame = Frame::new(FrameSize::new(60, 40).unwrap());
        let before = frame.clone();
        assert!(!stamp(&mut frame, &legend()));
        assert_eq!(frame, before);
    }
}
