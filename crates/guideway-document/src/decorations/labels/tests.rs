//! Tests of the places of labels.

use guideway_layout::{Layout, NewPath};
use guideway_scene::View;
use guideway_spline::Runs;

use super::*;

const SIZE: LabelSize = LabelSize {
    char_px: 7.0,
    line_px: 14.0,
};

fn picture() -> FrameSize {
    FrameSize::new(100, 100).unwrap()
}

/// Places names in a picture with a level line at this height, in pixels.
fn placed(names: Vec<Name<'_>>, arrows: &[Bounds<f64>], line_y_px: f64) -> Vec<Label> {
    let mut layout = Layout::default();
    let mut runs = Runs::default();
    let y = 50.0 - line_y_px;
    runs.push_line(Point::new(-100.0, y), Point::new(100.0, y));
    layout.paths.push(&NewPath {
        runs: &runs,
        ..NewPath::default()
    });
    let view = View::new(picture(), Point::new(0.0, 0.0), 1.0).unwrap();
    let obstacles = Obstacles {
        symbols: &[],
        arrows,
        lines: &LineMask::new(layout.paths.iter(), &view, 1.0),
    };
    place(names.into_iter(), &obstacles, SIZE, picture())
}

fn name(text: &'static str, at_px: Point<f64>, sides: &'static [Side]) -> Name<'static> {
    Name {
        text,
        at_px,
        places: LabelPlaces::Beside(sides),
        max_crossed: 0.0,
        spares_arrows: true,
    }
}

#[test]
fn places_in_a_file_are_no_names() {
    for (text, is_shown) in [
        ("L1.rows[4]", false),
        ("B.2.rows[1]", false),
        ("rack[4]", true),
        ("L1.rows[]", true),
        ("L1.rows [4]", true),
    ] {
        let at = Point::new(1.0, 50.0);
        let placed = placed(vec![name(text, at, &[Side::Right])], &[], 5.0);
        assert_eq!(placed.len(), usize::from(is_shown), "{text}");
    }
}

#[test]
fn keeps_a_space_between_labels_on_one_line() {
    let count = |gap_px: f64| {
        let names = [("one", 20.0), ("two", 20.0 + 3.0 * SIZE.char_px + gap_px)];
        let names = names.map(|(text, x)| name(text, Point::new(x, 50.0), &[Side::Right]));
        placed(names.into(), &[], 5.0).len()
    };
    assert_eq!([1.0, 6.5, 7.5].map(count), [1, 1, 2]);
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
        let labels = placed(vec![name("one", at, sides)], &[arrow], 5.0);
        labels.first().map(|label| label.at_px)
    };
    let above = Point::new(50.0 - 1.5 * SIZE.char_px, 50.0 - SIZE.line_px);
    assert_eq!(placed(&[Side::Right]), None);
    assert_eq!(
        placed(&[Side::Right, Side::Above, Side::Below]),
        Some(above)
    );
}

#[test]
fn letters_of_a_narrower_font_keep_near_their_position() {
    let at = Point::new(50.0, 50.0);
    let anchor = |sides| {
        placed(vec![name("one", at, sides)], &[], 5.0)
            .remove(0)
            .anchor
    };
    let anchors = [
        anchor(&[Side::Right]),
        anchor(&[Side::Above]),
        anchor(&[Side::BelowLeft]),
    ];
    assert_eq!(anchors, [0.0, 0.5, 1.0]);
}

#[test]
fn no_line_strikes_a_name_through_unless_it_may() {
    let at = Point::new(20.0, 50.0);
    let y_of = |max_crossed, sides| {
        let names = vec![Name {
            max_crossed,
            ..name("one", at, sides)
        }];
        placed(names, &[], 50.0).first().map(|label| label.at_px.y)
    };
    assert_eq!(y_of(0.0, &[Side::Right]), None);
    assert_eq!(y_of(1.0, &[Side::Right]), Some(50.0));
    let sides = &[Side::Right, Side::AboveRight];
    assert!(y_of(1.0, sides).unwrap() < 45.0);
}

#[test]
fn names_along_a_line_turn_with_it_and_read_to_the_right() {
    let along = |direction: Point<f64>| {
        let names = vec![Name {
            places: LabelPlaces::Along {
                direction,
                line_radius_px: 2.0,
            },
            ..name("one", Point::new(50.0, 60.0), &[])
        }];
        let label = placed(names, &[], 5.0).remove(0);
        (label.angle_rad.to_degrees().round(), label.at_px)
    };
    let level = Point::new(50.0 - 1.5 * SIZE.char_px, 60.0 - SIZE.line_px - 2.0);
    for direction in [Point::new(1.0, 0.0), Point::new(-1.0, 0.0)] {
        assert_eq!(along(direction), (0.0, level));
    }
    for (direction, degrees) in [((0.0, 1.0), -90.0), ((0.0, -1.0), -90.0)] {
        assert_eq!(along(Point::new(direction.0, direction.1)).0, degrees);
    }
    let sloped = Point::new(-0.8, -0.6);
    assert_eq!(along(sloped).0, 37.0);
}

#[test]
fn boxes_of_a_turned_label_cover_it_and_little_more() {
    let label = Label {
        text: "a long name".into(),
        at_px: Point::new(20.0, 80.0),
        angle_rad: -std::f64::consts::FRAC_PI_4,
        anchor: 0.5,
    };
    let boxes = SIZE.label_boxes(&label);
    let along = Point::new(label.angle_rad.cos(), label.angle_rad.sin());
    let width_px = 11.0 * SIZE.char_px;
    for step in 1..100 {
        let at = label.at_px + along * (width_px * f64::from(step) / 100.0);
        assert!(boxes.iter().any(|of| of.contains(at)), "{step}");
    }
    let all = boxes.into_iter().reduce(Bounds::union).unwrap();
    assert!(all.size().x < width_px * along.x + SIZE.line_px);
}
