//! Selection, colors and sizes of decorations.

use guideway_document::decorations::{LabelSize, MarkKind};
use guideway_scene::{FrameSize, Rgba, TextLine};

/// The decorations of a picture. The default is none.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Decorations {
    /// Lines at round coordinates, below the paths.
    pub has_grid: bool,
    /// Arrows along the paths, in the direction of travel.
    pub has_arrows: bool,
    /// A diamond per node.
    pub has_nodes: bool,
    /// A square per station.
    pub has_stations: bool,
    /// Names of stations, nodes and paths, where they have room.
    pub has_labels: bool,
    /// A bar of a round length.
    pub has_scale_bar: bool,
    /// The meaning of the colors, if the scene colors paths by a column.
    pub has_legend: bool,
    /// One line at the top.
    pub title: Option<String>,
}

impl Decorations {
    /// All decorations, with a title.
    pub fn site(title: impl Into<String>) -> Self {
        Self {
            has_grid: true,
            has_arrows: true,
            has_nodes: true,
            has_stations: true,
            has_labels: true,
            has_scale_bar: true,
            has_legend: true,
            title: Some(title.into()),
        }
    }

    /// Whether there is any arrow, node, station or label.
    pub(super) fn has_marks(&self) -> bool {
        self.has_arrows || self.has_nodes || self.has_stations || self.has_labels
    }
}

/// Size of labels, in points.
const LABEL_POINTS: f64 = 11.0;

/// Colors and sizes of decorations. A point is a pixel of a screen at 96 dpi.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DecorationStyle {
    /// Color of lines, arrows and texts.
    pub ink: Rgba,
    /// Color behind texts.
    pub paper: Rgba,
    /// Color of nodes.
    pub node: Rgba,
    /// Color of stations.
    pub station: Rgba,
    /// Pixels per point.
    pub px_per_point: f64,
}

impl DecorationStyle {
    /// Dark ink on a light background, light ink on a dark one.
    pub fn new(background: Rgba, px_per_point: f64) -> Self {
        let [r, g, b] = [background.r, background.g, background.b].map(u32::from);
        // Weights of red, green and blue in luma (ITU-R BT.601), in thousandths.
        let is_dark = background.a > 127 && 299 * r + 587 * g + 114 * b < 128_000;
        let gray = if is_dark { 220 } else { 40 };
        Self {
            ink: Rgba::opaque(gray, gray, gray),
            paper: match background.a {
                0 => Rgba::WHITE,
                _ => Rgba {
                    a: 0xFF,
                    ..background
                },
            },
            node: Rgba::opaque(0, 140, 90),
            station: Rgba::opaque(200, 40, 120),
            px_per_point,
        }
    }

    /// The style for a picture of this size: larger pictures have larger texts.
    pub fn for_picture(size: FrameSize, background: Rgba) -> Self {
        let px_per_point = match size.height() {
            0..1200 => 1.0,
            1200..2400 => 1.5,
            _ => 2.0,
        };
        Self::new(background, px_per_point)
    }

    /// Color of an arrow, a node or a station.
    pub fn mark_color(&self, kind: MarkKind) -> Rgba {
        match kind {
            MarkKind::Arrow => self.ink,
            MarkKind::Node => self.node,
            MarkKind::Station => self.station,
        }
    }

    /// Size of labels.
    pub fn label_size(&self) -> LabelSize {
        let size_px = LABEL_POINTS * self.px_per_point;
        LabelSize {
            char_px: size_px * TextLine::CHAR_ASPECT,
            line_px: size_px * 1.2,
        }
    }

    /// Height of a line of the legend.
    pub(super) fn line_px(&self) -> f64 {
        16.0 * self.px_per_point
    }

    /// Height of the band that a title keeps to itself; zero without a title.
    pub(crate) fn title_band_px(&self, decorations: &Decorations) -> f64 {
        match decorations.title {
            Some(_) => 2.5 * self.line_px(),
            None => 0.0,
        }
    }

    /// A color with another opacity.
    pub(super) fn faded(color: Rgba, opacity: f64) -> Rgba {
        Rgba {
            a: (f64::from(color.a) * opacity).round() as u8,
            ..color
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ink_contrasts_with_background() {
        let style = |background| DecorationStyle::new(background, 1.0);
        assert_eq!(style(Rgba::WHITE).ink, Rgba::opaque(40, 40, 40));
        assert_eq!(
            style(Rgba::opaque(24, 26, 30)).ink,
            Rgba::opaque(220, 220, 220)
        );
        assert_eq!(style(Rgba::from_u32(0)).paper, Rgba::WHITE);
    }
}
