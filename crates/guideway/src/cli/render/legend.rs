//! A legend drawn into the picture's upper left corner.

use std::ops::Range;

use guideway::render::{Frame, FrameSize, Strip};
use guideway::scene::{Legend, Rgba};
use noto_sans_mono_bitmap::{FontWeight, RasterHeight, get_raster, get_raster_width};

use crate::cli::text;

/// Longest label, in characters.
const LABEL_CHARS: usize = 40;
const PAPER: Rgba = Rgba::WHITE;
const INK: Rgba = Rgba::BLACK;
/// How much of the picture the paper hides.
const PAPER_OPACITY: f64 = 0.9;

/// A legend as it lies on a picture.
pub(super) struct Stamp {
    height: RasterHeight,
    title: String,
    /// A colour and what it means, from the top.
    entries: Vec<(Rgba, String)>,
    /// Size of the paper.
    box_px: (usize, usize),
}

impl Stamp {
    /// None if it takes more room than there is.
    pub(super) fn new(size: FrameSize, legend: &Legend) -> Option<Self> {
        let height = match size.height() {
            0..1200 => RasterHeight::Size16,
            1200..2400 => RasterHeight::Size24,
            _ => RasterHeight::Size32,
        };
        let entries = legend
            .entries
            .iter()
            .map(|entry| (entry.color, label(entry)));
        let entries: Vec<_> = entries.collect();
        let title = text::plain(&legend.column, LABEL_CHARS);
        let line_px = height.val();
        let char_px = get_raster_width(FontWeight::Regular, height);
        let text_px = |text: &str| text.chars().count() * char_px;
        let before_label_px = swatch_px(height) + gap_px(height);
        let widest_px = entries
            .iter()
            .map(|(_, label)| before_label_px + text_px(label))
            .max();
        let gap_px = gap_px(height);
        let box_px = (
            widest_px.unwrap_or(0).max(text_px(&title)) + 2 * gap_px,
            (entries.len() + 1) * line_px + 2 * gap_px,
        );
        let fits = box_px.0 + 2 * gap_px <= size.width() as usize
            && box_px.1 + 2 * gap_px <= size.height() as usize;
        fits.then_some(Self {
            height,
            title,
            entries,
            box_px,
        })
    }

    /// Draws as much of it as lies on a strip.
    pub(super) fn onto(&self, strip: &Strip, frame: &mut Frame) {
        let (line_px, gap_px) = (self.height.val(), gap_px(self.height));
        let rows = strip.rows();
        let mut sheet = Sheet {
            frame,
            rows: rows.start as usize..rows.end as usize,
            height: self.height,
        };
        sheet.fill((gap_px, gap_px), self.box_px, PAPER, PAPER_OPACITY);
        let (left, mut top) = (2 * gap_px, 2 * gap_px);
        sheet.write((left, top), &self.title);
        for (color, label) in &self.entries {
            top += line_px;
            let middle = (left, top + line_px / 4);
            let swatch_px = swatch_px(self.height);
            sheet.fill(middle, (swatch_px, line_px / 2), *color, 1.0);
            sheet.write((left + swatch_px + gap_px, top), label);
        }
    }
}

fn gap_px(height: RasterHeight) -> usize {
    height.val() / 2
}

fn swatch_px(height: RasterHeight) -> usize {
    2 * height.val()
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
    /// Rows of the picture that the frame holds.
    rows: Range<usize>,
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
        if !self.rows.contains(&y) {
            return;
        }
        let width = self.frame.size().width() as usize;
        let pixel = &mut self.frame.pixels_mut()[(y - self.rows.start) * width + x];
        let [r, g, b, a] = *pixel;
        let mixed = Rgba { r, g, b, a }.lerp(color, opacity);
        *pixel = [mixed.r, mixed.g, mixed.b, mixed.a];
    }
}

#[cfg(test)]
mod tests {
    use guideway::render::View;
    use guideway::scene::LegendEntry;
    use guideway::spline::Point;

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

    fn view(width: u32, height: u32) -> View {
        let size = FrameSize::new(width, height).unwrap();
        View::new(size, Point::default(), 1.0).unwrap()
    }

    fn white(strip: &Strip) -> Frame {
        let mut frame = Frame::new(strip.size());
        frame.pixels_mut().fill([255; 4]);
        frame
    }

    #[test]
    fn the_legend_shows_its_colours_in_the_upper_left() {
        let strip = Strip::whole(&view(400, 200));
        let mut frame = white(&strip);
        let stamp = Stamp::new(frame.size(), &legend()).unwrap();
        stamp.onto(&strip, &mut frame);
        let has = |color: [u8; 4]| frame.pixels().iter().position(|&p| p == color);
        assert!(has([200, 0, 0, 255]).is_some_and(|at| at % 400 < 100 && at / 400 < 60));
        assert!(has([0, 0, 0, 255]).is_some(), "there is text");
        assert_eq!(frame.pixels()[199 * 400 + 399], [255; 4]);
    }

    #[test]
    fn a_legend_goes_on_from_one_strip_to_the_next() {
        // In the largest letters, so that it does not end with the first strip.
        let view = view(500, 2400);
        let stamp = Stamp::new(view.size(), &legend()).unwrap();
        let mut whole = white(&Strip::whole(&view));
        stamp.onto(&Strip::whole(&view), &mut whole);
        let mut rows = whole.pixels().iter();
        for strip in view.strips(0) {
            let mut frame = white(&strip);
            stamp.onto(&strip, &mut frame);
            assert!(
                frame
                    .pixels()
                    .iter()
                    .eq(rows.by_ref().take(frame.pixels().len()))
            );
        }
        let second = &whole.pixels()[64 * 500..128 * 500];
        assert!(rows.next().is_none() && second.iter().any(|p| *p != [255; 4]));
    }

    #[test]
    fn a_legend_that_is_larger_than_the_picture_is_none() {
        assert!(Stamp::new(view(60, 40).size(), &legend()).is_none());
    }
}
