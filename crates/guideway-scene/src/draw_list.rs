//! Draw list: filled polygons and lines of text in pixels, for decorations over or below paths.
//!
//! The window, the PNG writer and the SVG writer all consume it.

use guideway_spline::Point;
use unicode_width::UnicodeWidthStr;

use crate::color::Rgba;

/// Filled polygons and lines of text in the pixels of a picture.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DrawList {
    /// Fills, bottom first.
    pub fills: Vec<Fill>,
    /// Lines of text, drawn over all fills.
    pub texts: Vec<TextLine>,
}

/// Convex polygons that share one color. The color is composited once where several of them
/// overlap.
#[derive(Clone, Debug, PartialEq)]
pub struct Fill {
    /// Color of all polygons.
    pub color: Rgba,
    /// Corners of each polygon in pixels, in order, either way round.
    pub polygons: Vec<Vec<Point<f64>>>,
}

/// A line of text, as wide as in a monospaced font.
#[derive(Clone, Debug, PartialEq)]
pub struct TextLine {
    /// The characters.
    pub text: String,
    /// Middle of the left edge, in pixels.
    pub left_middle_px: Point<f64>,
    /// Clockwise rotation about that point: the angle of the line below the horizontal.
    pub angle_rad: f64,
    /// Place of the letters along the line in a font that is narrower, such as that of a window: 0
    /// at the left end, 1 at the right end.
    pub anchor: f64,
    /// Width of a character, in pixels.
    pub char_width_px: f64,
    /// Color of the characters.
    pub color: Rgba,
    /// Color of the halo around the characters, which sets them off from lines below; a transparent
    /// one draws none.
    pub halo: Rgba,
}

impl TextLine {
    /// Width of a character of common monospaced fonts, per unit of its height.
    pub const CHAR_ASPECT: f64 = 0.6;

    /// Width of a halo, per unit of the height of the text.
    const HALO: f64 = 0.17;

    /// Height of the text, in pixels.
    pub fn height_px(&self) -> f64 {
        self.char_width_px / Self::CHAR_ASPECT
    }

    /// Width of the halo around each character, in pixels.
    pub fn halo_px(&self) -> f64 {
        Self::HALO * self.height_px()
    }

    /// Width of the line, in pixels.
    pub fn width_px(&self) -> f64 {
        Self::columns(&self.text) as f64 * self.char_width_px
    }

    /// Columns of a text, as in a terminal: two for an ideograph, none for a combining accent.
    pub fn columns(text: &str) -> usize {
        text.width()
    }
}

impl DrawList {
    /// Returns `true` if it draws nothing.
    pub fn is_empty(&self) -> bool {
        self.fills.is_empty() && self.texts.is_empty()
    }

    /// Adds a convex polygon above all earlier ones. Polygons of one color in a row form one fill.
    pub fn fill_polygon(&mut self, color: Rgba, corners: &[Point<f64>]) {
        match self.fills.last_mut() {
            Some(top) if top.color == color => top.polygons.push(corners.to_vec()),
            _ => self.fills.push(Fill {
                color,
                polygons: vec![corners.to_vec()],
            }),
        }
    }

    /// Adds an axis-aligned rectangle, given two opposite corners.
    pub fn fill_rectangle(&mut self, color: Rgba, a: Point<f64>, b: Point<f64>) {
        self.fill_polygon(color, &[a, Point::new(b.x, a.y), b, Point::new(a.x, b.y)]);
    }

    /// Adds a straight line with flat ends; nothing if it has no length.
    pub fn stroke_segment(&mut self, color: Rgba, [a, b]: [Point<f64>; 2], radius: f64) {
        let along = b - a;
        let length = along.norm();
        if length > 0.0 {
            let side = Point::new(-along.y, along.x) * (radius / length);
            self.fill_polygon(color, &[a + side, b + side, b - side, a - side]);
        }
    }

    /// Adds all fills and texts of `other` above these.
    pub fn append(&mut self, other: Self) {
        self.fills.extend(other.fills);
        self.texts.extend(other.texts);
    }

    /// The same drawing with colors that are more translucent, from opacity 0 to 1.
    pub fn faded(mut self, opacity: f64) -> Self {
        let fade = |color: &mut Rgba| *color = color.faded(opacity);
        self.fills.iter_mut().for_each(|fill| fade(&mut fill.color));
        for text in &mut self.texts {
            fade(&mut text.color);
            fade(&mut text.halo);
        }
        self
    }

    /// The same drawing for a picture that is larger by `factor`.
    pub fn scaled(mut self, factor: f64) -> Self {
        let polygons = self.fills.iter_mut().flat_map(|fill| &mut fill.polygons);
        polygons
            .flatten()
            .for_each(|corner| *corner = *corner * factor);
        for text in &mut self.texts {
            text.left_middle_px = text.left_middle_px * factor;
            text.char_width_px *= factor;
        }
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn p(x: f64, y: f64) -> Point<f64> {
        Point::new(x, y)
    }

    #[test]
    fn merges_adjacent_fills_of_one_color_and_keeps_their_order() {
        let triangle = [p(0.0, 0.0), p(1.0, 0.0), p(0.0, 1.0)];
        let mut list = DrawList::default();
        list.fill_rectangle(Rgba::BLACK, p(1.0, 2.0), p(3.0, 5.0));
        for color in [Rgba::BLACK, Rgba::WHITE, Rgba::BLACK] {
            list.fill_polygon(color, &triangle);
        }
        let fills = list.fills.iter();
        let counts: Vec<_> = fills.map(|f| (f.color, f.polygons.len())).collect();
        let (black, white) = (Rgba::BLACK, Rgba::WHITE);
        assert_eq!(counts, [(black, 2), (white, 1), (black, 1)]);
    }

    #[test]
    fn segments_are_as_wide_as_twice_their_radius() {
        let mut list = DrawList::default();
        list.stroke_segment(Rgba::BLACK, [p(1.0, 1.0); 2], 0.5);
        assert!(list.is_empty());
        list.stroke_segment(Rgba::BLACK, [p(1.0, 1.0), p(1.0, 5.0)], 0.5);
        let corners = [p(0.5, 1.0), p(0.5, 5.0), p(1.5, 5.0), p(1.5, 1.0)];
        assert_eq!(list.fills[0].polygons, [corners]);
    }

    #[test]
    fn scales_polygons_and_texts() {
        let mut list = DrawList::default();
        list.fill_rectangle(Rgba::BLACK, p(1.0, 2.0), p(3.0, 5.0));
        list.texts.push(TextLine {
            text: "a".into(),
            left_middle_px: p(1.0, 2.0),
            angle_rad: 0.0,
            anchor: 0.0,
            char_width_px: 7.0,
            color: Rgba::BLACK,
            halo: Rgba::WHITE,
        });
        let large = list.scaled(3.0);
        assert_eq!(large.fills[0].polygons[0][2], p(9.0, 15.0));
        let text = &large.texts[0];
        assert_eq!(
            (text.left_middle_px, text.char_width_px),
            (p(3.0, 6.0), 21.0)
        );
    }

    #[test]
    fn fading_is_of_fills_letters_and_halos() {
        let mut list = DrawList::default();
        list.fill_rectangle(Rgba::BLACK.with_opacity(0.5), p(1.0, 2.0), p(3.0, 5.0));
        list.texts.push(TextLine {
            text: "a".into(),
            left_middle_px: p(1.0, 2.0),
            angle_rad: 0.0,
            anchor: 0.0,
            char_width_px: 7.0,
            color: Rgba::BLACK,
            halo: Rgba::WHITE,
        });
        let alphas = |list: &DrawList| {
            let text = &list.texts[0];
            [list.fills[0].color.a, text.color.a, text.halo.a]
        };
        assert_eq!(alphas(&list), [128, 255, 255]);
        assert_eq!(alphas(&list.clone().faded(1.0)), alphas(&list));
        assert_eq!(alphas(&list.faded(0.2)), [26, 51, 51]);
    }
}
