use crate::Rgba;
use guideway_spline::Point;

/// Shapes and texts in the pixels of a picture, that lie over its paths or below them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sheet {
    /// Convex polygons by color, from the lowest; a color counts once where several of its polygons are.
    pub areas: Vec<(Rgba, Vec<Vec<Point<f64>>>)>,
    /// Texts, over all areas.
    pub texts: Vec<Text>,
}

/// A line of text in letters of one width.
#[derive(Clone, Debug, PartialEq)]
pub struct Text {
    /// What it says.
    pub text: String,
    /// The middle of its left edge, in pixels.
    pub at_px: Point<f64>,
    /// Width of a letter, in pixels.
    pub char_px: f64,
    /// Color of the letters.
    pub ink: Rgba,
    /// What is behind them; it may be translucent.
    pub paper: Rgba,
}

impl Text {
    /// Width of a letter of common fonts of one width, for its height.
    pub const CHAR_SHARE: f64 = 0.6;
}

impl Sheet {
    /// Adds a polygon on top of all of other colors, unless the one on top has its color.
    pub fn add(&mut self, color: Rgba, corners: &[Point<f64>]) {
        match self.areas.last_mut() {
            Some((last, polygons)) if *last == color => polygons.push(corners.to_vec()),
            _ => self.areas.push((color, vec![corners.to_vec()])),
        }
    }

    /// Adds an upright rectangle, by two of its corners.
    pub fn add_rectangle(&mut self, color: Rgba, a: Point<f64>, b: Point<f64>) {
        self.add(color, &[a, Point::new(b.x, a.y), b, Point::new(a.x, b.y)]);
    }

    /// The same for a picture `factor` times as large.
    pub fn scaled(mut self, factor: f64) -> Self {
        let polygons = self.areas.iter_mut().flat_map(|(_, polygons)| polygons);
        polygons
            .flatten()
            .for_each(|corner| *corner = *corner * factor);
        for text in &mut self.texts {
            text.at_px = text.at_px * factor;
            text.char_px *= factor;
        }
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colors_keep_their_order_and_sizes_grow() {
        let mut sheet = Sheet::default();
        let at = |x, y| Point::new(x, y);
        sheet.add_rectangle(Rgba::BLACK, at(1.0, 2.0), at(3.0, 5.0));
        sheet.add(Rgba::BLACK, &[at(0.0, 0.0), at(1.0, 0.0), at(0.0, 1.0)]);
        sheet.add(Rgba::WHITE, &[at(0.0, 0.0), at(1.0, 0.0), at(0.0, 1.0)]);
        sheet.add(Rgba::BLACK, &[at(0.0, 0.0), at(1.0, 0.0), at(0.0, 1.0)]);
        let counts: Vec<_> = sheet.areas.iter().map(|(c, p)| (*c, p.len())).collect();
        let (black, white) = (Rgba::BLACK, Rgba::WHITE);
        assert_eq!(counts, [(black, 2), (white, 1), (black, 1)]);
        sheet.texts.push(Text {
            text: "a".into(),
            at_px: at(1.0, 2.0),
            char_px: 7.0,
            ink: Rgba::BLACK,
            paper: Rgba::WHITE,
        });
        let large = sheet.scaled(3.0);
        assert_eq!(large.areas[0].1[0][2], at(9.0, 15.0));
        assert_eq!(
            (large.texts[0].at_px, large.texts[0].char_px),
            (at(3.0, 6.0), 21.0)
        );
    }
}
