//! Labels: names beside their positions, placed without overlaps.

use guideway_scene::{FrameSize, TextLine};
use guideway_spline::{Bounds, Point};

use super::line_mask::LineMask;
use crate::text_format::single_line;

/// Most labels in a view.
const MAX_LABELS: usize = 300;
/// Longest label, in characters.
const MAX_CHARS: usize = 32;
/// Part to the right of a unit vector below which a line is upright.
const UPRIGHT: f64 = 1e-3;
/// Part downward of a unit vector below which a line is level.
const LEVEL: f64 = 5e-3;

/// Size of label text.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LabelSize {
    /// Width of a character, in pixels.
    pub char_px: f64,
    /// Height of a line, in pixels.
    pub line_px: f64,
}

/// A placed label.
#[derive(Clone, Debug, PartialEq)]
pub struct Label {
    /// The text.
    pub text: String,
    /// Middle of the left edge, in pixels.
    pub at_px: Point<f64>,
    /// Clockwise rotation about that point: the angle of the line below the horizontal.
    pub angle_rad: f64,
    /// Place of the letters along the label in a narrower font: see
    /// [`TextLine::anchor`](guideway_scene::TextLine::anchor).
    pub anchor: f64,
}

/// The places of a label to try, the preferred one first.
#[derive(Clone, Copy, Debug)]
pub(super) enum LabelPlaces {
    /// Beside its position.
    Beside(&'static [Side]),
    /// Along a line, above or below it.
    Along {
        /// Unit vector along the line, y down.
        direction: Point<f64>,
        /// Half the width of the line, in pixels.
        line_radius_px: f64,
    },
}

/// Place of a label beside its position.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    Right,
    Left,
    Above,
    Below,
    AboveRight,
    BelowRight,
    AboveLeft,
    BelowLeft,
}

impl Side {
    /// The anchor by which the letters keep near their position.
    fn anchor(self) -> f64 {
        match self {
            Self::Right | Self::AboveRight | Self::BelowRight => 0.0,
            Self::Above | Self::Below => 0.5,
            Self::Left | Self::AboveLeft | Self::BelowLeft => 1.0,
        }
    }
}

/// A name to place beside a position.
pub(super) struct Name<'a> {
    pub(super) text: &'a str,
    /// The position, in pixels.
    pub(super) at_px: Point<f64>,
    pub(super) places: LabelPlaces,
    /// Largest part of its box that lines may cross, from 0 to 1.
    pub(super) max_crossed: f64,
    /// True if the name must not hide an arrow.
    pub(super) spares_arrows: bool,
}

/// The content of the picture before the labels.
pub(super) struct Obstacles<'a> {
    /// Positions of symbols, in pixels.
    pub(super) symbols: &'a [Point<f64>],
    /// Boxes of arrows, in pixels.
    pub(super) arrows: &'a [Bounds<f64>],
    pub(super) lines: &'a LineMask,
}

impl LabelSize {
    /// Boxes that a label is in, in pixels: one of a level label, else a chain of squares.
    pub fn label_boxes(self, label: &Label) -> Vec<Bounds<f64>> {
        let width_px = self.width_px(&label.text);
        self.boxes(label.at_px, label.angle_rad, width_px)
    }

    fn width_px(self, text: &str) -> f64 {
        TextLine::columns(text) as f64 * self.char_px
    }

    fn boxes(self, at_px: Point<f64>, angle_rad: f64, width_px: f64) -> Vec<Bounds<f64>> {
        let half_px = self.line_px / 2.0;
        let half_line = Point::new(0.0, half_px);
        if angle_rad == 0.0 {
            return vec![Bounds {
                min: at_px - half_line,
                max: at_px + half_line + Point::new(width_px, 0.0),
            }];
        }
        let along = Point::new(angle_rad.cos(), angle_rad.sin());
        let half = Point::new(half_px, half_px);
        let inner_px = (width_px - self.line_px).max(0.0);
        let steps = (inner_px / self.line_px).ceil().max(1.0);
        let square = |step: u32| {
            let center = at_px + along * (half_px + inner_px * f64::from(step) / steps);
            Bounds {
                min: center - half,
                max: center + half,
            }
        };
        (0..=steps as u32).map(square).collect()
    }

    /// The places of a label to try: middle of the left edge, rotation, and anchor.
    fn places(self, name: &Name<'_>, width_px: f64) -> Vec<(Point<f64>, f64, f64)> {
        match name.places {
            LabelPlaces::Beside(sides) => {
                let of_side = |&side: &Side| {
                    let at_px = self.left_middle_px(side, name.at_px, width_px);
                    (at_px, 0.0, side.anchor())
                };
                sides.iter().map(of_side).collect()
            }
            LabelPlaces::Along {
                direction,
                line_radius_px,
            } => {
                // Texts read to the right, and upright ones upward.
                let is_backward =
                    direction.x < -UPRIGHT || direction.x <= UPRIGHT && direction.y > 0.0;
                let along = if is_backward {
                    direction * -1.0
                } else {
                    direction
                };
                let angle_rad = match along.y.abs() < LEVEL {
                    true => 0.0,
                    false => along.y.atan2(along.x),
                };
                let above = Point::new(along.y, -along.x) * (self.line_px + line_radius_px);
                let left = name.at_px - along * (width_px / 2.0);
                [above, above * -1.0]
                    .map(|aside| (left + aside, angle_rad, 0.5))
                    .into()
            }
        }
    }

    /// Middle of the left edge of a label on a side of a position.
    fn left_middle_px(self, side: Side, at_px: Point<f64>, width_px: f64) -> Point<f64> {
        // Clear of a symbol or line at the position.
        let gap_px = 0.7 * self.line_px;
        let left_px = -gap_px - width_px;
        let near_px = 0.8 * self.line_px;
        let (x, y) = match side {
            Side::Right => (gap_px, 0.0),
            Side::Left => (left_px, 0.0),
            Side::Above => (-width_px / 2.0, -self.line_px),
            Side::Below => (-width_px / 2.0, self.line_px),
            Side::AboveRight => (gap_px, -near_px),
            Side::BelowRight => (gap_px, near_px),
            Side::AboveLeft => (left_px, -near_px),
            Side::BelowLeft => (left_px, near_px),
        };
        at_px + Point::new(x, y)
    }

    /// Box of the symbol of a node or station.
    fn symbol_box(self, at: Point<f64>) -> Bounds<f64> {
        Bounds { min: at, max: at }.inflated(self.line_px / 2.1)
    }
}

/// Places names beside their positions, first come, first served, on the side where lines cross
/// least. Omits a name that would leave the picture, be crossed more than it allows, or overlap
/// another label, a symbol or, if it spares arrows, an arrow.
pub(super) fn place<'a>(
    names: impl Iterator<Item = Name<'a>>,
    obstacles: &Obstacles<'_>,
    size: LabelSize,
    picture: FrameSize,
) -> Vec<Label> {
    let picture = Bounds {
        min: Point::new(0.0, 0.0),
        max: Point::new(f64::from(picture.width()), f64::from(picture.height())),
    };
    let mut labels = Vec::new();
    let symbols = obstacles.symbols.iter();
    let mut taken: Vec<Bounds<f64>> = symbols.map(|&at| size.symbol_box(at)).collect();
    for name in names {
        if labels.len() == MAX_LABELS {
            break;
        }
        if name.text.is_empty() || is_place(name.text) {
            continue;
        }
        let text = single_line(name.text, MAX_CHARS);
        let width_px = size.width_px(&text);
        let is_clear = |boxes: &[Bounds<f64>], others: &[Bounds<f64>]| {
            let hits = |other: &Bounds<f64>| boxes.iter().any(|of| of.intersects(*other));
            !others.iter().any(hits)
        };
        let mut best: Option<(f64, Label, Vec<Bounds<f64>>)> = None;
        for (at_px, angle_rad, anchor) in size.places(&name, width_px) {
            let boxes = size.boxes(at_px, angle_rad, width_px);
            let covered = boxes.iter().map(|of| obstacles.lines.coverage(*of));
            let crossed = covered.sum::<f64>() / boxes.len() as f64;
            let least = best
                .as_ref()
                .map_or(f64::INFINITY, |(crossed, ..)| *crossed);
            let is_inside = |of: &Bounds<f64>| picture.contains(of.min) && picture.contains(of.max);
            let is_free = boxes.iter().all(is_inside)
                && crossed < least
                && crossed <= name.max_crossed
                && is_clear(&boxes, &taken)
                && (!name.spares_arrows || is_clear(&boxes, obstacles.arrows));
            if is_free {
                let label = Label {
                    text: text.clone(),
                    at_px,
                    angle_rad,
                    anchor,
                };
                best = Some((crossed, label, boxes));
            }
            if crossed == 0.0 && is_free {
                break;
            }
        }
        if let Some((_, label, boxes)) = best {
            // Keeps a space between neighbors, which would read as one name.
            let space = Point::new(size.char_px, 0.0);
            taken.extend(boxes.iter().map(|of| Bounds {
                min: of.min - space,
                max: of.max + space,
            }));
            labels.push(label);
        }
    }
    labels
}

/// Returns `true` if a name is a place in a file, such as `L1.vertices[4]`: readers give it to
/// elements without a name, and it tells a person nothing.
fn is_place(name: &str) -> bool {
    let parts = name.strip_suffix(']').and_then(|name| {
        let (list, index) = name.rsplit_once('[')?;
        Some((list.rsplit_once('.')?.1, index))
    });
    parts.is_some_and(|(list, index)| {
        let is_list = !list.is_empty() && list.bytes().all(|byte| byte.is_ascii_lowercase());
        is_list && !index.is_empty() && index.bytes().all(|byte| byte.is_ascii_digit())
    })
}

#[cfg(test)]
mod tests;
