//! Colors and sizes of decorations.

use guideway_scene::{FrameSize, Rgba, TextLine};

use super::labels::LabelSize;

/// Height of label text, in points.
const LABEL_POINTS: f64 = 11.0;
/// Line height of label text, per unit of its height.
const LINE_HEIGHT: f64 = 1.2;
/// Height of a line of the legend, in points.
const LEGEND_LINE_POINTS: f64 = 16.0;

/// Shorter side of a picture with one pixel per point, in pixels.
const PICTURE_SIDE_PX: f64 = 1080.0;
/// Least pixels per point of a picture. Derived: labels of 9 pixels are still read with ease.
const LEAST_PX_PER_POINT: f64 = 0.8;

/// Colors and sizes of decorations. A point is a pixel of a screen at 96 dpi.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DecorationStyle {
    /// Pixels per point: the scale of a high-density screen, or of a large picture.
    pub px_per_point: f64,
    /// Color of lines, arrows and texts.
    pub ink: Rgba,
    /// Color of the paper that the picture is drawn on, shown behind texts.
    pub paper: Rgba,
    /// Color of node symbols.
    pub node: Rgba,
    /// Color of station symbols.
    pub station: Rgba,
}

/// Kind of a mark, which decides its color.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MarkKind {
    /// A direction arrow on a path.
    Arrow,
    /// A node symbol.
    Node,
    /// A station symbol.
    Station,
}

impl DecorationStyle {
    /// Dark ink on a light background, light ink on a dark one. A transparent background has white
    /// paper.
    pub fn new(background: Rgba, px_per_point: f64) -> Self {
        let [r, g, b] = [background.r, background.g, background.b].map(u32::from);
        // Weights of red, green and blue in luma (ITU-R BT.601), in thousandths.
        let is_dark = background.a > 127 && 299 * r + 587 * g + 114 * b < 128_000;
        let gray = if is_dark { 220 } else { 40 };
        Self {
            px_per_point,
            ink: Rgba::opaque(gray, gray, gray),
            paper: match background.a {
                0 => Rgba::WHITE,
                _ => background.with_opacity(1.0),
            },
            node: Rgba::opaque(0, 140, 90),
            station: Rgba::opaque(200, 40, 120),
        }
    }

    /// The style for a picture of this size: texts grow with the shorter side.
    pub fn for_picture(size: FrameSize, background: Rgba) -> Self {
        let side_px = f64::from(size.height().min(size.width()));
        let px_per_point = (side_px / PICTURE_SIDE_PX).max(LEAST_PX_PER_POINT);
        Self::new(background, px_per_point)
    }

    /// Color of a kind of mark.
    pub fn mark_color(&self, kind: MarkKind) -> Rgba {
        match kind {
            MarkKind::Arrow => self.ink,
            MarkKind::Node => self.node,
            MarkKind::Station => self.station,
        }
    }

    /// Size of label text.
    pub fn label_size(&self) -> LabelSize {
        let height_px = LABEL_POINTS * self.px_per_point;
        LabelSize {
            char_px: height_px * TextLine::CHAR_ASPECT,
            line_px: height_px * LINE_HEIGHT,
        }
    }

    /// Height of a line of the legend, in pixels.
    pub fn line_px(&self) -> f64 {
        LEGEND_LINE_POINTS * self.px_per_point
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ink_contrasts_with_the_background() {
        let style = |background| DecorationStyle::new(background, 1.0);
        let dark = Rgba::opaque(24, 26, 30);
        assert_eq!(style(Rgba::WHITE).ink, Rgba::opaque(40, 40, 40));
        assert_eq!(style(dark).ink, Rgba::opaque(220, 220, 220));
        assert_eq!(style(Rgba::from_u32(0)).paper, Rgba::WHITE);
    }

    #[test]
    fn texts_grow_with_the_picture() {
        let line_px = |width, height| {
            let size = FrameSize::new(width, height).unwrap();
            DecorationStyle::for_picture(size, Rgba::WHITE).line_px()
        };
        assert_eq!((line_px(1920, 1080), line_px(6480, 4320)), (16.0, 64.0));
        assert_eq!(line_px(400, 300), 12.8);
    }
}
