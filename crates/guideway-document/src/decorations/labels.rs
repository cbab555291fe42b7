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

/// Places names beside their positions, first come, first served. Omits a name that would overlap
/// another label or a symbol, or leave the picture.
pub(super) fn place<'a>(
    names: impl Iterator<Item = (&'a str, Point<f64>)>,
    symbols: impl Iterator<Item = Point<f64>>,
    size: LabelSize,
    picture: FrameSize,
) -> Vec<Label> {
    let picture = Bounds {
        min: Point::new(0.0, 0.0),
        max: Point::new(f64::from(picture.width()), f64::from(picture.height())),
    };
    let mut labels = Vec::new();
    let symbol = |at: Point<f64>| Bounds { min: at, max: at }.inflated(size.line_px / 2.1);
    let mut taken: Vec<Bounds<f64>> = symbols.map(symbol).collect();
    for (name, position_px) in names {
        if labels.len() == MAX_LABELS {
            break;
        }
        if name.is_empty() {
            continue;
        }
        let text = single_line(name, MAX_CHARS);
        let width_px = TextLine::columns(&text) as f64 * size.char_px;
        let at_px = position_px + Point::new(size.line_px / 2.0, 0.0);
        let bounds = Bounds {
            min: at_px - Point::new(0.0, size.line_px / 2.0),
            max: at_px + Point::new(width_px, size.line_px / 2.0),
        };
        let is_inside = picture.contains(bounds.min) && picture.contains(bounds.max);
        if is_inside && !taken.iter().any(|other| other.intersects(bounds)) {
            // Keeps a space between neighbors, which would read as one name.
            let space = Point::new(size.char_px, 0.0);
            taken.push(Bounds {
                min: bounds.min - space,
                max: bounds.max + space,
            });
            labels.push(Label { text, at_px });
        }
    }
    labels
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keeps_a_space_between_labels_on_one_line() {
        let size = LabelSize {
            char_px: 7.0,
            line_px: 14.0,
        };
        let picture = FrameSize::new(100, 100).unwrap();
        let placed = |gap_px: f64| {
            let places = [20.0, 20.0 + 3.0 * size.char_px + gap_px];
            let names = ["one", "two"]
                .into_iter()
                .zip(places.map(|x| Point::new(x, 50.0)));
            place(names, std::iter::empty(), size, picture).len()
        };
        assert_eq!([1.0, 6.5, 7.5].map(placed), [1, 1, 2]);
    }
}
