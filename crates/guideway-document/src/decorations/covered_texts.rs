//! Names of several drawings on top of each other: those of the upper ones stay.

use guideway_scene::{DrawList, TextLine};
use guideway_spline::{Bounds, Point};

/// Removes the texts of each drawing that one of a later drawing, which is above it, would cover.
pub fn hide_covered_texts(drawings: &mut [DrawList]) {
    if drawings.len() < 2 {
        return;
    }
    let mut above: Vec<Bounds<f64>> = Vec::new();
    for drawing in drawings.iter_mut().rev() {
        let is_free = |text: &TextLine| {
            let place = text_box(text);
            place.is_none_or(|place| above.iter().all(|other| !place.intersects(*other)))
        };
        drawing.texts.retain(is_free);
        above.extend(drawing.texts.iter().filter_map(text_box));
    }
}

/// Bounding box of a text, in pixels.
fn text_box(text: &TextLine) -> Option<Bounds<f64>> {
    let width_px = text.text.chars().count() as f64 * text.char_width_px;
    let half_height_px = 0.5 * text.char_width_px / TextLine::CHAR_ASPECT;
    let (sin, cos) = text.angle_rad.sin_cos();
    let (along, across) = (Point::new(cos, sin), Point::new(-sin, cos));
    let corners = [0.0, width_px].into_iter().flat_map(|x| {
        [-half_height_px, half_height_px].map(|y| text.left_middle_px + along * x + across * y)
    });
    Bounds::of_points(corners)
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use guideway_scene::Rgba;

    use super::*;

    fn drawing(texts: &[(&str, f64, f64, f64)]) -> DrawList {
        let line = |&(text, x, y, angle_rad): &(&str, f64, f64, f64)| TextLine {
            text: text.to_owned(),
            left_middle_px: Point::new(x, y),
            angle_rad,
            anchor: 0.0,
            char_width_px: 6.0,
            color: Rgba::BLACK,
            halo: Rgba::BLACK,
        };
        DrawList {
            texts: texts.iter().map(line).collect(),
            ..DrawList::default()
        }
    }

    #[test]
    fn names_below_others_are_hidden_and_those_of_one_drawing_stay() {
        let below = [
            ("covered", 50.0, 3.0, 0.0),
            ("beside", 50.0, 20.0, 0.0),
            // It leads down, into the name at its end.
            ("upright", 40.0, -40.0, FRAC_PI_2),
        ];
        let above = [("name", 20.0, 0.0, 0.0), ("names", 40.0, 0.0, 0.0)];
        let mut drawings = [drawing(&below), drawing(&above)];
        hide_covered_texts(&mut drawings);
        let left = drawings.map(|drawing| {
            let texts = drawing.texts.into_iter();
            texts.map(|line| line.text).collect::<Vec<_>>()
        });
        assert_eq!(left, [vec!["beside"], vec!["name", "names"]]);
    }
}
