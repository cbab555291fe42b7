use guideway_scene::FrameSize;
use guideway_spline::{Bounds, Point};

/// Most names in one view.
const MOST: usize = 300;
/// Longest name that is written whole, in characters.
const LONGEST: usize = 32;

/// How much room a name takes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LabelSize {
    /// Width of a character, in pixels.
    pub char_px: f64,
    /// Height of a line, in pixels.
    pub line_px: f64,
}

/// A name in the view.
#[derive(Clone, Debug, PartialEq)]
pub struct Label {
    /// What it says.
    pub text: String,
    /// The middle of its left edge, in pixels.
    pub at_px: Point<f64>,
}

/// Puts names beside their places, earlier ones first; one that would lie over another, over a symbol, or out of
/// the picture, is left out.
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
    for (name, place_px) in names {
        if labels.len() == MOST {
            break;
        }
        if name.is_empty() {
            continue;
        }
        let text = shortened(name);
        let width_px = text.chars().count() as f64 * size.char_px;
        let at_px = place_px + Point::new(size.line_px / 2.0, 0.0);
        let room = Bounds {
            min: at_px - Point::new(0.0, size.line_px / 2.0),
            max: at_px + Point::new(width_px, size.line_px / 2.0),
        };
        let is_inside = picture.contains(room.min) && picture.contains(room.max);
        if is_inside && !taken.iter().any(|other| other.intersects(room)) {
            // Two names without a space between them would be read as one.
            let space = Point::new(size.char_px, 0.0);
            taken.push(Bounds {
                min: room.min - space,
                max: room.max + space,
            });
            labels.push(Label { text, at_px });
        }
    }
    labels
}

fn shortened(name: &str) -> String {
    match name.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("{}…", &name[..end]),
        None => name.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_on_a_line_have_room_for_a_space_between_them() {
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
