//! Labels: names beside their positions, placed without overlaps.

use guideway_scene::{FrameSize, TextLine};
use guideway_spline::{Bounds, Point};

use crate::text_format::single_line;

/// Most labels in a view.
const MAX_LABELS: usize = 300;
/// Longest label, in characters.
const MAX_CHARS: usize = 32;

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
}

/// Side of its position on which a label is placed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    Right,
    Above,
    Below,
}

/// A name to place beside a position.
pub(super) struct Name<'a> {
    pub(super) text: &'a str,
    /// The position, in pixels.
    pub(super) at_px: Point<f64>,
    /// Sides to try, the preferred one first.
    pub(super) sides: &'static [Side],
    /// True if the name must not hide an arrow.
    pub(super) spares_arrows: bool,
}

impl LabelSize {
    /// Box of a label, in pixels.
    pub fn label_box(self, label: &Label) -> Bounds<f64> {
        let half_line = Point::new(0.0, self.line_px / 2.0);
        let width_px = TextLine::columns(&label.text) as f64 * self.char_px;
        Bounds {
            min: label.at_px - half_line,
            max: label.at_px + half_line + Point::new(width_px, 0.0),
        }
    }

    /// Middle of the left edge of a label on a side of a position.
    fn left_middle_px(self, side: Side, at_px: Point<f64>, width_px: f64) -> Point<f64> {
        at_px
            + match side {
                Side::Right => Point::new(self.line_px / 2.0, 0.0),
                Side::Above => Point::new(-width_px / 2.0, -self.line_px),
                Side::Below => Point::new(-width_px / 2.0, self.line_px),
            }
    }

    /// Box of the symbol of a node or station.
    fn symbol_box(self, at: Point<f64>) -> Bounds<f64> {
        Bounds { min: at, max: at }.inflated(self.line_px / 2.1)
    }
}

/// Places names beside their positions, first come, first served. Omits a name that would leave the
/// picture or overlap another label, a symbol or, if it spares arrows, one of the boxes `arrows`.
pub(super) fn place<'a>(
    names: impl Iterator<Item = Name<'a>>,
    symbols: impl Iterator<Item = Point<f64>>,
    arrows: &[Bounds<f64>],
    size: LabelSize,
    picture: FrameSize,
) -> Vec<Label> {
    let picture = Bounds {
        min: Point::new(0.0, 0.0),
        max: Point::new(f64::from(picture.width()), f64::from(picture.height())),
    };
    let mut labels = Vec::new();
    let mut taken: Vec<Bounds<f64>> = symbols.map(|at| size.symbol_box(at)).collect();
    for name in names {
        if labels.len() == MAX_LABELS {
            break;
        }
        if name.text.is_empty() {
            continue;
        }
        let text = single_line(name.text, MAX_CHARS);
        let width_px = TextLine::columns(&text) as f64 * size.char_px;
        let is_clear = |bounds: Bounds<f64>, others: &[Bounds<f64>]| {
            !others.iter().any(|other| other.intersects(bounds))
        };
        let placed = name.sides.iter().find_map(|&side| {
            let label = Label {
                text: text.clone(),
                at_px: size.left_middle_px(side, name.at_px, width_px),
            };
            let bounds = size.label_box(&label);
            let is_inside = picture.contains(bounds.min) && picture.contains(bounds.max);
            let is_free = is_inside
                && is_clear(bounds, &taken)
                && (!name.spares_arrows || is_clear(bounds, arrows));
            is_free.then_some((label, bounds))
        });
        if let Some((label, bounds)) = placed {
            // Keeps a space between neighbors, which would read as one name.
            let space = Point::new(size.char_px, 0.0);
            taken.push(Bounds {
                min: bounds.min - space,
                max: bounds.max + space,
            });
            labels.push(label);
        }
    }
    labels
}

#[cfg(test)]
mod tests {
    use std::iter::empty;

    use super::*;

    const SIZE: LabelSize = LabelSize {
        char_px: 7.0,
        line_px: 14.0,
    };

    fn picture() -> FrameSize {
        FrameSize::new(100, 100).unwrap()
    }

    fn name(text: &'static str, at_px: Point<f64>, sides: &'static [Side]) -> Name<'static> {
        Name {
            text,
            at_px,
            sides,
            spares_arrows: true,
        }
    }

    #[test]
    fn keeps_a_space_between_labels_on_one_line() {
        let placed = |gap_px: f64| {
            let names = [("one", 20.0), ("two", 20.0 + 3.0 * SIZE.char_px + gap_px)];
            let names = names.map(|(text, x)| name(text, Point::new(x, 50.0), &[Side::Right]));
            place(names.into_iter(), empty(), &[], SIZE, picture()).len()
        };
        assert_eq!([1.0, 6.5, 7.5].map(placed), [1, 1, 2]);
    }

    #[test]
    fn takes_the_first_side_that_is_clear_of_arrows() {
        let at = Point::new(50.0, 50.0);
        let head = Point::new(10.0, 4.0);
        let arrow = Bounds {
            min: at - head,
            max: at + head,
        };
        let placed = |sides| {
            let names = [name("one", at, sides)].into_iter();
            let labels = place(names, empty(), &[arrow], SIZE, picture());
            labels.first().map(|label| label.at_px)
        };
        let above = Point::new(50.0 - 1.5 * SIZE.char_px, 50.0 - SIZE.line_px);
        assert_eq!(placed(&[Side::Right]), None);
        assert_eq!(
            placed(&[Side::Right, Side::Above, Side::Below]),
            Some(above)
        );
    }
}
