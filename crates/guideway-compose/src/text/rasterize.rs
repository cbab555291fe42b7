//! Outlines of shaped glyphs, and their exact coverage per pixel.

use ab_glyph_rasterizer::{Point as RasterPoint, Rasterizer, point};
use guideway_scene::TextLine;
use guideway_spline::Point;
use skrifa::MetadataProvider;
use skrifa::instance::{LocationRef, Size};
use skrifa::outline::{DrawSettings, OutlinePen};

use super::shape::{PlacedGlyph, ShapedLine};

/// From the middle of a line down to its baseline: half the height of a capital.
const BASELINE: f64 = 0.35;

/// The box of a missing letter: left, bottom, right, top and line width, in the font size.
const MISSING: [f64; 5] = [0.07, 0.0, 0.53, 0.7, 0.07];

/// The place of a line of text in a picture.
pub(crate) struct LinePlace {
    /// Middle of its left end, in pixels.
    pub(crate) left_middle: Point<f64>,
    /// Clockwise rotation about that point.
    pub(crate) angle_rad: f64,
    /// The font size.
    pub(crate) size_px: f64,
    /// Its greatest width: a wider line is condensed.
    pub(crate) max_width_px: f64,
}

impl LinePlace {
    /// The place of a line of a draw list.
    pub(crate) fn of(text: &TextLine) -> Self {
        Self {
            left_middle: text.left_middle_px,
            angle_rad: text.angle_rad,
            size_px: text.height_px(),
            max_width_px: text.width_px(),
        }
    }

    /// Middle of the right end of a line of the greatest width, in pixels.
    pub(crate) fn end(&self) -> Point<f64> {
        self.left_middle + self.direction() * self.max_width_px
    }

    fn direction(&self) -> Point<f64> {
        Point::new(self.angle_rad.cos(), self.angle_rad.sin())
    }
}

impl ShapedLine {
    /// Draws the line. Hands every covered pixel and its coverage (0 to 1) to `blend`.
    ///
    /// Cost: linear in the area of the letters.
    pub(crate) fn rasterize(&self, place: &LinePlace, mut blend: impl FnMut(i64, i64, f32)) {
        let middle = place.left_middle.y;
        let baseline = middle + BASELINE * place.size_px;
        // A baseline on a whole pixel keeps the feet of letters sharp.
        let baseline = match place.angle_rad == 0.0 {
            true => baseline.round(),
            false => baseline,
        };
        for pen in self.pens(place, baseline - middle) {
            pen.rasterize(&mut blend);
        }
    }

    /// The outlines of the glyphs.
    pub(crate) fn outlines(&self, place: &LinePlace) -> impl Iterator<Item = Vec<Curve>> {
        let pens = self.pens(place, BASELINE * place.size_px);
        pens.map(|pen| pen.curves)
    }

    /// Draws each glyph from the left end of a baseline, which lies below the middle of the line.
    fn pens(&self, place: &LinePlace, below_px: f64) -> impl Iterator<Item = Pen> {
        let size_px = place.size_px;
        let natural_px = self.width * size_px;
        let condense = match natural_px > place.max_width_px {
            true => place.max_width_px / natural_px,
            false => 1.0,
        };
        let (start, along) = (place.left_middle, place.direction());
        self.glyphs.iter().map(move |glyph| {
            let origin = Point::new(glyph.x * size_px * condense, below_px - glyph.y * size_px);
            let mut pen = Pen::new((start, along), origin, condense);
            pen.draw(glyph, size_px);
            pen
        })
    }
}

/// A part of an outline, in pixels, y down.
pub(crate) enum Curve {
    Line([RasterPoint; 2]),
    Quad([RasterPoint; 3]),
    Cubic([RasterPoint; 4]),
}

/// Collects an outline before the size of its raster is known.
struct Pen {
    /// Start and direction of the line.
    line: (Point<f64>, Point<f64>),
    /// Origin of the glyph from there, along and below the line.
    origin: Point<f64>,
    condense: f64,
    curves: Vec<Curve>,
    start: RasterPoint,
    current: RasterPoint,
}

impl Pen {
    fn new(line: (Point<f64>, Point<f64>), origin: Point<f64>, condense: f64) -> Self {
        Self {
            line,
            origin,
            condense,
            curves: Vec::new(),
            start: point(0.0, 0.0),
            current: point(0.0, 0.0),
        }
    }

    /// Draws a glyph, or the box of a missing letter.
    fn draw(&mut self, glyph: &PlacedGlyph, size_px: f64) {
        let Some(font) = &glyph.font else {
            return self.draw_missing(size_px as f32);
        };
        let Some(tables) = font.tables() else {
            return;
        };
        if let Some(outline) = tables.outline_glyphs().get(glyph.id) {
            let size = Size::new(size_px as f32);
            let settings = DrawSettings::unhinted(size, LocationRef::default());
            // A damaged outline leaves a gap; the rest of the line stays readable.
            let _ = outline.draw(settings, self);
        }
    }

    fn draw_missing(&mut self, size_px: f32) {
        let [left, bottom, right, top, line] = MISSING.map(|v| v as f32 * size_px);
        // At small sizes a line of one pixel still shows.
        let line = line.max(1.0);
        let (inner_left, inner_right) = (left + line, right - line);
        let (inner_bottom, inner_top) = (bottom + line, top - line);
        // The inner contour runs the other way round, so that it is a hole.
        let outer = [(left, bottom), (right, bottom), (right, top), (left, top)];
        let inner = [
            (inner_left, inner_bottom),
            (inner_left, inner_top),
            (inner_right, inner_top),
            (inner_right, inner_bottom),
        ];
        for contour in [outer, inner] {
            let [(x, y), others @ ..] = contour;
            self.move_to(x, y);
            others.into_iter().for_each(|(x, y)| self.line_to(x, y));
            self.close();
        }
    }

    /// From units of the outline (pixels, y up) to pixels of the picture.
    fn at(&self, x: f32, y: f32) -> RasterPoint {
        let (start, along) = self.line;
        let right = self.origin.x + f64::from(x) * self.condense;
        let down = self.origin.y - f64::from(y);
        let at = start + along * right + Point::new(-along.y, along.x) * down;
        point(at.x as f32, at.y as f32)
    }

    /// Hands every pixel that the outline covers to `blend`.
    fn rasterize(&self, blend: &mut impl FnMut(i64, i64, f32)) {
        let points = || {
            self.curves.iter().flat_map(|curve| match curve {
                Curve::Line(points) => points.as_slice(),
                Curve::Quad(points) => points.as_slice(),
                Curve::Cubic(points) => points.as_slice(),
            })
        };
        let fold = |of: fn(&RasterPoint) -> f32, pick: fn(f32, f32) -> f32| {
            points().map(of).reduce(pick).unwrap_or(0.0)
        };
        let (left, top) = (
            fold(|p| p.x, f32::min).floor(),
            fold(|p| p.y, f32::min).floor(),
        );
        let width = (fold(|p| p.x, f32::max) - left).ceil() as usize + 1;
        let height = (fold(|p| p.y, f32::max) - top).ceil() as usize + 1;
        if self.curves.is_empty() {
            return;
        }
        let mut raster = Rasterizer::new(width, height);
        let local = |p: RasterPoint| point(p.x - left, p.y - top);
        for curve in &self.curves {
            match *curve {
                Curve::Line([a, b]) => raster.draw_line(local(a), local(b)),
                Curve::Quad([a, b, c]) => raster.draw_quad(local(a), local(b), local(c)),
                Curve::Cubic([a, b, c, d]) => {
                    raster.draw_cubic(local(a), local(b), local(c), local(d));
                }
            }
        }
        raster.for_each_pixel_2d(|x, y, coverage| {
            if coverage > 0.0 {
                let (x, y) = (i64::from(x) + left as i64, i64::from(y) + top as i64);
                blend(x, y, coverage.min(1.0));
            }
        });
    }
}

impl OutlinePen for Pen {
    fn move_to(&mut self, x: f32, y: f32) {
        self.start = self.at(x, y);
        self.current = self.start;
    }

    fn line_to(&mut self, x: f32, y: f32) {
        let end = self.at(x, y);
        self.curves.push(Curve::Line([self.current, end]));
        self.current = end;
    }

    fn quad_to(&mut self, cx: f32, cy: f32, x: f32, y: f32) {
        let (control, end) = (self.at(cx, cy), self.at(x, y));
        self.curves.push(Curve::Quad([self.current, control, end]));
        self.current = end;
    }

    fn curve_to(&mut self, ax: f32, ay: f32, bx: f32, by: f32, x: f32, y: f32) {
        let (a, b, end) = (self.at(ax, ay), self.at(bx, by), self.at(x, y));
        self.curves.push(Curve::Cubic([self.current, a, b, end]));
        self.current = end;
    }

    fn close(&mut self) {
        self.curves.push(Curve::Line([self.current, self.start]));
        self.current = self.start;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::text::fonts::Fonts;

    /// Total coverage, and the box of covered pixels: left, top, right, bottom.
    fn ink(text: &str, size_px: f64, max_width_px: f64) -> (f32, [i64; 4]) {
        ink_at(0.0, text, size_px, max_width_px)
    }

    fn ink_at(angle_rad: f64, text: &str, size_px: f64, max_width_px: f64) -> (f32, [i64; 4]) {
        let line = ShapedLine::with_fonts(text, &Fonts::embedded());
        let (mut sum, mut bounds) = (0.0, [i64::MAX, i64::MAX, i64::MIN, i64::MIN]);
        let place = LinePlace {
            left_middle: Point::new(50.0, 50.0),
            angle_rad,
            size_px,
            max_width_px,
        };
        line.rasterize(&place, |x, y, coverage| {
            sum += coverage;
            let [left, top, right, bottom] = bounds;
            bounds = [left.min(x), top.min(y), right.max(x), bottom.max(y)];
        });
        (sum, bounds)
    }

    #[test]
    fn ink_grows_with_the_area_of_letters() {
        let (small, _) = ink("Größe", 16.0, 1e9);
        let (large, _) = ink("Größe", 32.0, 1e9);
        assert!((large / small - 4.0).abs() < 0.2, "{small}, {large}");
    }

    #[test]
    fn capitals_stand_in_the_middle_of_the_line() {
        let (_, [_, top, _, bottom]) = ink("H", 40.0, 1e9);
        assert!((top + bottom + 1 - 100).abs() <= 3, "{top}, {bottom}");
    }

    #[test]
    fn turned_line_has_the_same_ink_along_its_direction() {
        let (level, [left, top, right, bottom]) = ink("Hall", 40.0, 1e9);
        let (turned, down) = ink_at(std::f64::consts::FRAC_PI_2, "Hall", 40.0, 1e9);
        assert!((turned / level - 1.0).abs() < 0.01, "{turned}, {level}");
        // A quarter clockwise about (50, 50): right becomes down, down becomes left.
        let expected = [100 - bottom, left, 100 - top, right];
        let pairs = down.into_iter().zip(expected);
        assert!(
            pairs.map(|(a, b)| (a - b).abs()).max() <= Some(1),
            "{down:?}"
        );
    }

    #[test]
    fn wide_lines_are_condensed() {
        let (_, [left, _, right, _]) = ink("wide line", 20.0, 60.0);
        assert!(left >= 50 && right <= 111, "{left}, {right}");
    }

    #[test]
    fn missing_letter_is_a_hollow_box() {
        let (area, [left, top, right, bottom]) = ink("\u{10FFFD}", 40.0, 1e9);
        let whole = ((right - left + 1) * (bottom - top + 1)) as f32;
        assert!(area > 50.0 && area < 0.6 * whole, "{area} of {whole}");
    }
}
