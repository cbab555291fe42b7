//! Rasterizes a draw list over the strips of a view.

use std::ops::Range;

use guideway_cpu::{Areas, lay_areas};
use guideway_scene::{DrawList, Frame, Rgba, Strip, TextLine, View};

use crate::blend::over;
use crate::text::{LinePlace, ShapedLine};

/// A draw list, prepared for all strips of a view.
pub(crate) struct PreparedOverlay {
    fills: Vec<(Rgba, Areas)>,
    texts: Vec<(TextLine, ShapedLine)>,
}

impl PreparedOverlay {
    /// Shapes all texts and converts polygons to the coordinates of the rasterizer.
    pub(crate) fn new(list: &DrawList, view: &View) -> Self {
        let fills = list.fills.iter().map(|fill| {
            let mut areas = Areas::default();
            for polygon in &fill.polygons {
                let corner = |&p| view.world_from_pixel(p);
                areas.push(&polygon.iter().map(corner).collect::<Vec<_>>());
            }
            (fill.color, areas)
        });
        let texts = list.texts.iter();
        Self {
            fills: fills.collect(),
            texts: texts
                .map(|text| (text.clone(), ShapedLine::new(&text.text)))
                .collect(),
        }
    }

    /// Composites the part of the list that lies in a strip over a frame of the strip's size.
    pub(crate) fn draw(&self, strip: &Strip, frame: &mut Frame) {
        for (color, areas) in &self.fills {
            lay_areas(areas, strip, *color, frame);
        }
        let rows = strip.rows();
        let mut canvas = StripCanvas {
            frame,
            rows: i64::from(rows.start)..i64::from(rows.end),
        };
        for (text, line) in &self.texts {
            canvas.draw_text(text, line);
        }
    }
}

/// The rows of a picture that one frame holds.
struct StripCanvas<'a> {
    frame: &'a mut Frame,
    rows: Range<i64>,
}

impl StripCanvas<'_> {
    fn draw_text(&mut self, text: &TextLine, line: &ShapedLine) {
        let place = LinePlace::of(text);
        // Letters and halos reach less than their size beyond the middle of the line.
        let ends = [place.left_middle, place.end()];
        let reach = 1.5 * place.size_px;
        let top = ends[0].y.min(ends[1].y) - reach;
        let bottom = ends[0].y.max(ends[1].y) + reach;
        if (bottom as i64) < self.rows.start || (top as i64) >= self.rows.end {
            return;
        }
        if text.halo.a > 0 {
            let [r, g, b, a] = text.halo.to_u32().to_be_bytes();
            line.rasterize_halo(&place, text.halo_px(), |x, y, coverage| {
                self.blend(x, y, [r, g, b, (f32::from(a) * coverage).round() as u8]);
            });
        }
        let [r, g, b, a] = text.color.to_u32().to_be_bytes();
        line.rasterize(&place, |x, y, coverage| {
            let alpha = (f32::from(a) * coverage).round() as u8;
            self.blend(x, y, [r, g, b, alpha]);
        });
    }

    /// Composites a color over one pixel of the picture; outside of the strip it has no effect.
    fn blend(&mut self, x: i64, y: i64, color: [u8; 4]) {
        let width = i64::from(self.frame.size().width());
        if (0..width).contains(&x) && self.rows.contains(&y) {
            let at = ((y - self.rows.start) * width + x) as usize;
            let pixel = &mut self.frame.pixels_mut()[at];
            *pixel = over(color, *pixel);
        }
    }
}

#[cfg(test)]
mod tests {
    use guideway_scene::FrameSize;
    use guideway_spline::Point;

    use super::*;

    fn view(width: u32, height: u32) -> View {
        let size = FrameSize::new(width, height).unwrap();
        View::new(size, Point::new(3.0, 4.0), 20.0).unwrap()
    }

    fn list() -> DrawList {
        let mut list = DrawList::default();
        let red = Rgba::opaque(255, 0, 0);
        list.fill_rectangle(red, Point::new(10.0, 60.0), Point::new(20.0, 80.0));
        list.texts.push(TextLine {
            text: "lé\u{10FFFD}".into(),
            left_middle_px: Point::new(40.0, 64.0),
            angle_rad: 0.0,
            anchor: 0.0,
            char_width_px: 12.0,
            color: Rgba::BLACK,
            halo: Rgba::opaque(0, 255, 0),
        });
        list
    }

    fn drawn(strip: &Strip) -> Frame {
        let mut frame = Frame::new(strip.size());
        frame.pixels_mut().fill([255; 4]);
        PreparedOverlay::new(&list(), strip.view()).draw(strip, &mut frame);
        frame
    }

    #[test]
    fn draws_fills_letters_and_missing_letters_in_their_cells() {
        let frame = drawn(&Strip::whole(&view(100, 128)));
        let at = |x: usize, y: usize| frame.pixels()[y * 100 + x];
        assert_eq!((at(9, 70), at(10, 70)), ([255; 4], [255, 0, 0, 255]));
        assert_eq!((at(15, 59), at(15, 60)), ([255; 4], [255, 0, 0, 255]));
        assert_eq!((at(35, 64), at(80, 64)), ([255; 4], [255; 4]));
        // The halo reaches beyond the letters, and not into the space between lines.
        let halo = (30..90).flat_map(|x| (40..90).map(move |y| (x, y)));
        let halo: Vec<_> = halo
            .filter(|&(x, y)| at(x, y) == [0, 255, 0, 255])
            .collect();
        assert!(halo.len() > 100 && halo.iter().all(|&(_, y)| y > 50 && y < 80));
        let dark = |x: Range<usize>| {
            let pixels = x.flat_map(|x| (40..90).map(move |y| (x, y)));
            pixels.filter(|&(x, y)| at(x, y)[1] < 64).count()
        };
        for cell in [40..52, 52..64, 64..76] {
            assert!(dark(cell.clone()) > 4, "{cell:?}");
        }
    }

    #[test]
    fn strips_together_equal_the_whole() {
        let view = view(100, 128);
        let whole = drawn(&Strip::whole(&view));
        let mut rows = whole.pixels().iter();
        for strip in view.strips(0) {
            let frame = drawn(&strip);
            assert!(rows.by_ref().take(frame.pixels().len()).eq(frame.pixels()));
        }
        assert!(rows.next().is_none());
    }
}
