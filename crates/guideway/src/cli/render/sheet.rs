//! Shapes and texts, drawn and written.

use std::io::{self, Write};
use std::ops::Range;

use guideway::cpu::{Areas, lay_areas};
use guideway::formats::svg::Page;
use guideway::render::{DrawList, Frame, Strip, TextLine, View};
use guideway::scene::Rgba;
use guideway::spline::Point;
use noto_sans_mono_bitmap::{
    FontWeight, RasterHeight, RasterizedChar, get_raster, get_raster_width,
};

use super::floor_plan::over;
use super::vector::STEP_PX;

/// Letters are made from those of this height.
const LETTERS: RasterHeight = RasterHeight::Size32;

/// A sheet that is ready to be laid over the strips of a view.
pub(super) struct Laid<'s> {
    areas: Vec<(Rgba, Areas)>,
    texts: &'s [TextLine],
}

impl<'s> Laid<'s> {
    pub(super) fn new(sheet: &'s DrawList, view: &View) -> Self {
        let areas = sheet.fills.iter().map(|fill| {
            let mut areas = Areas::default();
            for polygon in &fill.polygons {
                let corner = |&p| view.world_from_pixel(p);
                areas.push(&polygon.iter().map(corner).collect::<Vec<_>>());
            }
            (fill.color, areas)
        });
        Self {
            areas: areas.collect(),
            texts: &sheet.texts,
        }
    }

    /// Draws as much of it as lies on a strip.
    pub(super) fn onto(&self, strip: &Strip, frame: &mut Frame) {
        for (color, areas) in &self.areas {
            lay_areas(areas, strip, *color, frame);
        }
        let rows = strip.rows();
        let mut lines = Lines {
            frame,
            rows: rows.start as usize..rows.end as usize,
        };
        for text in self.texts {
            lines.write(text);
        }
    }
}

/// Writes it as a group of this name.
pub(super) fn write(
    sheet: &DrawList,
    label: &str,
    page: &mut Page<'_, impl Write>,
) -> io::Result<()> {
    if *sheet == DrawList::default() {
        return Ok(());
    }
    page.begin_group(label)?;
    for fill in &sheet.fills {
        page.areas(label, fill.color.to_u32(), STEP_PX, [&fill.polygons])?;
    }
    for text in &sheet.texts {
        let height = text.char_width_px / TextLine::CHAR_ASPECT;
        let width = text.char_width_px * text.text.chars().count() as f64;
        if text.background.a > 0 {
            let corner = text.left_middle_px - Point::new(0.0, 0.6 * height);
            let place = [corner.x, corner.y, width, 1.2 * height];
            page.area(place, text.background.to_u32())?;
        }
        // From the middle of a line to what letters stand on.
        let at = text.left_middle_px + Point::new(0.0, 0.35 * height);
        page.line_of_text([at.x, at.y], height, width, text.color.to_u32(), &text.text)?;
    }
    page.end_group()
}

/// Rows of a picture that texts are drawn on.
struct Lines<'a> {
    frame: &'a mut Frame,
    /// Rows of the picture that the frame holds.
    rows: Range<usize>,
}

impl Lines<'_> {
    fn write(&mut self, text: &TextLine) {
        let scale = text.char_width_px / get_raster_width(FontWeight::Regular, LETTERS) as f64;
        let height_px = scale * LETTERS.val() as f64;
        let corner = text.left_middle_px - Point::new(0.0, height_px / 2.0);
        let width_px = text.char_width_px * text.text.chars().count() as f64;
        self.blend(corner, Point::new(width_px, height_px), |pixel, _, _| {
            over(text.background.to_u32().to_be_bytes(), pixel)
        });
        for (i, char) in text.text.chars().enumerate() {
            let glyph = |c| get_raster(c, FontWeight::Regular, LETTERS);
            // The font has European letters; `?` stands for any other.
            let Some(glyph) = glyph(char).or_else(|| glyph('?')) else {
                continue;
            };
            let corner = corner + Point::new(i as f64 * text.char_width_px, 0.0);
            let ink = text.color.to_u32().to_be_bytes();
            let size = Point::new(text.char_width_px, height_px);
            self.blend(corner, size, |pixel, x, y| {
                let opacity = coverage(&glyph, [x, y], 1.0 / scale) / 255.0;
                let [r, g, b, a] = ink;
                over([r, g, b, (f64::from(a) * opacity).round() as u8], pixel)
            });
        }
    }

    /// Changes the pixels of a box, each by its middle's place in it.
    fn blend(
        &mut self,
        corner: Point<f64>,
        size_px: Point<f64>,
        change: impl Fn([u8; 4], f64, f64) -> [u8; 4],
    ) {
        let width = self.frame.size().width() as usize;
        // Out of range saturates.
        let end = corner + size_px;
        let (left, right) = (
            corner.x.round() as usize,
            (end.x.round() as usize).min(width),
        );
        let (top, bottom) = (corner.y.round() as usize, end.y.round() as usize);
        for y in top.max(self.rows.start)..bottom.min(self.rows.end) {
            let row = &mut self.frame.pixels_mut()[(y - self.rows.start) * width..][..width];
            for (x, pixel) in (left..right).zip(row.iter_mut().skip(left)) {
                let at = Point::new(x as f64 + 0.5, y as f64 + 0.5) - corner;
                *pixel = change(*pixel, at.x, at.y);
            }
        }
    }
}

/// The mean of a letter around a place of what a pixel covers of it, `step` of its pixels wide; at least one.
fn coverage(letter: &RasterizedChar, [x, y]: [f64; 2], step: f64) -> f64 {
    let half = step.max(1.0) / 2.0;
    let span = |at: f64| {
        let (from, to) = (at * step - half, at * step + half);
        let cells = from.floor().max(0.0) as usize..to.ceil().max(0.0) as usize;
        cells.map(move |i| (i, (to.min(i as f64 + 1.0) - from.max(i as f64)).max(0.0)))
    };
    let mut sum = 0.0;
    for (j, high) in span(y) {
        for (i, wide) in span(x) {
            sum += high * wide * f64::from(letter.pixel(i, j).unwrap_or(0));
        }
    }
    sum / (4.0 * half * half)
}

#[cfg(test)]
mod tests {
    use guideway::render::FrameSize;

    use super::*;

    fn view(width: u32, height: u32) -> View {
        let size = FrameSize::new(width, height).unwrap();
        View::new(size, Point::new(3.0, 4.0), 20.0).unwrap()
    }

    fn sheet() -> DrawList {
        let mut sheet = DrawList::default();
        let red = Rgba::opaque(255, 0, 0);
        sheet.fill_rectangle(red, Point::new(10.0, 60.0), Point::new(20.0, 80.0));
        sheet.texts.push(TextLine {
            text: "lé漢".into(),
            left_middle_px: Point::new(40.0, 64.0),
            char_width_px: 12.0,
            color: Rgba::BLACK,
            background: Rgba::opaque(0, 255, 0),
        });
        sheet
    }

    fn drawn(strip: &Strip) -> Frame {
        let mut frame = Frame::new(strip.size());
        frame.pixels_mut().fill([255; 4]);
        Laid::new(&sheet(), strip.view()).onto(strip, &mut frame);
        frame
    }

    #[test]
    fn shapes_and_letters_are_where_they_were_put() {
        let frame = drawn(&Strip::whole(&view(100, 128)));
        let at = |x: usize, y: usize| frame.pixels()[y * 100 + x];
        assert_eq!((at(9, 70), at(10, 70)), ([255; 4], [255, 0, 0, 255]));
        assert_eq!((at(15, 59), at(15, 60)), ([255; 4], [255, 0, 0, 255]));
        assert_eq!((at(39, 64), at(77, 64)), ([255; 4], [255; 4]));
        let dark = |x: Range<usize>| {
            let pixels = x.flat_map(|x| (40..90).map(move |y| (x, y)));
            pixels.filter(|&(x, y)| at(x, y)[1] < 64).count()
        };
        for letter in [40..52, 52..64, 64..76] {
            assert!(dark(letter.clone()) > 4, "{letter:?}");
        }
    }

    #[test]
    fn letters_go_on_from_one_strip_to_the_next() {
        let view = view(100, 128);
        let whole = drawn(&Strip::whole(&view));
        let mut rows = whole.pixels().iter();
        for strip in view.strips(0) {
            let frame = drawn(&strip);
            assert!(rows.by_ref().take(frame.pixels().len()).eq(frame.pixels()));
        }
        assert!(rows.next().is_none());
    }

    #[test]
    fn letters_have_as_much_ink_at_any_size() {
        let glyph = get_raster('m', FontWeight::Regular, LETTERS).unwrap();
        let share = |scale: f64| {
            let (width, height) = (glyph.width() as f64 * scale, LETTERS.val() as f64 * scale);
            let mut sum = 0.0;
            for y in 0..height as usize {
                for x in 0..width as usize {
                    let at = [x as f64 + 0.5, y as f64 + 0.5];
                    sum += coverage(&glyph, at, 1.0 / scale);
                }
            }
            sum / (width * height)
        };
        let as_it_is = share(1.0);
        for scale in [0.5, 2.0, 3.0] {
            assert!((share(scale) / as_it_is - 1.0).abs() < 0.1, "{scale}");
        }
    }

    #[test]
    fn a_sheet_is_written_with_its_texts() {
        let mut out = Vec::new();
        let common = guideway::formats::svg::Stroke::of(0xFF, 1.0);
        let mut page = Page::begin(&mut out, [0.0, 0.0, 100.0, 128.0], "", &common).unwrap();
        write(&sheet(), "marks", &mut page).unwrap();
        write(&DrawList::default(), "nothing", &mut page).unwrap();
        page.end().unwrap();
        let text = String::from_utf8(out).unwrap();
        for part in ["lé漢", "#ff0000", "#00ff00", "marks", "M10 60"] {
            assert!(text.contains(part), "{part}: {text}");
        }
        assert!(!text.contains("nothing"));
    }
}
