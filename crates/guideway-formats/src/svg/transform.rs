//! Parses transforms: the attribute `transform`, the CSS properties `transform`, `translate`,
//! `rotate`, `scale` and `transform-origin` in, an affine map out.
//!
//! Sources: CSS Transforms 1, sections 7 and 13; CSS Transforms 2, section 5; SVG 2, section 8.5.
//! Percentages refer to the sizes of the viewport.

use std::str::FromStr;

use guideway_spline::{Affine, Point};
use svgtypes::{Angle, AngleUnit, Transform};

use super::cascade::Property;
use super::length::{FontSizes, length};
use super::viewport::Viewport;

/// Parses the attribute `transform`; `None` if it is malformed.
pub(super) fn attribute_transform(text: &str) -> Option<Affine> {
    let Transform { a, b, c, d, e, f } = Transform::from_str(text).ok()?;
    finite([a, b, c, d, e, f])
}

/// Parses the CSS property `transform`; `None` if it is malformed or leaves the plane.
pub(super) fn css_transform(text: &str, viewport: Viewport) -> Option<Affine> {
    let mut rest = text.trim();
    let mut transform = Affine::IDENTITY;
    if rest == "none" {
        return Some(transform);
    }
    while !rest.is_empty() {
        let (name, after) = rest.split_once('(')?;
        let (arguments, after) = after.split_once(')')?;
        let function = function(name.trim(), arguments, viewport)?;
        transform = function.then(transform);
        rest = after.trim_start();
    }
    transform.is_finite().then_some(transform)
}

/// Returns whether a text is a value of the CSS property `transform`.
pub(super) fn is_transform(text: &str) -> bool {
    css_transform(text, Viewport::new(1.0, 1.0)).is_some()
}

/// Parses one of the CSS properties `translate`, `rotate` and `scale`; `None` if it is malformed or
/// leaves the plane.
pub(super) fn single_transform(
    property: Property,
    text: &str,
    viewport: Viewport,
) -> Option<Affine> {
    let words: Vec<&str> = text.split_ascii_whitespace().collect();
    let single = match (property, words.as_slice()) {
        (_, ["none"]) => Affine::IDENTITY,
        (Property::Rotate, [turn] | ["z", turn] | [turn, "z"]) => {
            function("rotate", turn, viewport)?
        }
        (Property::Translate, [x]) => function("translate", x, viewport)?,
        (Property::Translate, [x, y]) => function("translate", &format!("{x},{y}"), viewport)?,
        (Property::Scale, [both]) => function("scale", both, viewport)?,
        // A third factor is along the axis of sight.
        (Property::Scale, [x, y] | [x, y, _]) => function("scale", &format!("{x},{y}"), viewport)?,
        _ => return None,
    };
    single.is_finite().then_some(single)
}

/// Returns whether a text is a value of such a property.
pub(super) fn is_single_transform(property: Property, text: &str) -> bool {
    single_transform(property, text, Viewport::new(1.0, 1.0)).is_some()
}

/// A transform about an origin.
pub(super) fn about(transform: Affine, origin: Point<f64>) -> Affine {
    let back = Affine::translation(-origin);
    back.then(transform).then(Affine::translation(origin))
}

/// Parses the property `transform-origin`; `None` if it is malformed.
pub(super) fn transform_origin(text: &str, viewport: Viewport) -> Option<Point<f64>> {
    let mut words = text.split_ascii_whitespace();
    let (first, second) = (words.next()?, words.next().unwrap_or("center"));
    // A third value lies outside of the plane.
    if words.nth(1).is_some() {
        return None;
    }
    let is_swapped = is_one_of(first, ["top", "bottom"]) || is_one_of(second, ["left", "right"]);
    let (x, y) = if is_swapped {
        (second, first)
    } else {
        (first, second)
    };
    Some(Point::new(
        place(x, ["left", "right"], viewport.fonts, viewport.width())?,
        place(y, ["top", "bottom"], viewport.fonts, viewport.height())?,
    ))
}

/// Returns whether a text is a value of the property `transform-origin`.
pub(super) fn is_origin(text: &str) -> bool {
    transform_origin(text, Viewport::new(1.0, 1.0)).is_some()
}

fn is_one_of(word: &str, names: [&str; 2]) -> bool {
    names.contains(&word)
}

/// A coordinate of an origin along an axis of this size; `ends` are the names of its ends.
fn place(word: &str, ends: [&str; 2], fonts: FontSizes, size: f64) -> Option<f64> {
    match word {
        "center" => Some(0.5 * size),
        _ if word == ends[0] => Some(0.0),
        _ if word == ends[1] => Some(size),
        _ => length(word, fonts, size),
    }
}

fn function(name: &str, arguments: &str, viewport: Viewport) -> Option<Affine> {
    let arguments: Vec<&str> = arguments.split(',').map(str::trim).collect();
    let x = |text| length(text, viewport.fonts, viewport.width());
    let y = |text| length(text, viewport.fonts, viewport.height());
    Some(match (name, arguments.as_slice()) {
        ("matrix", all) => {
            let numbers: Option<Vec<f64>> = all.iter().map(|text| number(text)).collect();
            finite(numbers?.try_into().ok()?)?
        }
        ("translate", [dx]) | ("translateX", [dx]) => translation(x(dx)?, 0.0),
        ("translate", [dx, dy]) => translation(x(dx)?, y(dy)?),
        ("translateY", [dy]) => translation(0.0, y(dy)?),
        ("scale", [both]) => scale(number(both)?, number(both)?),
        ("scale", [sx, sy]) => scale(number(sx)?, number(sy)?),
        ("scaleX", [sx]) => scale(number(sx)?, 1.0),
        ("scaleY", [sy]) => scale(1.0, number(sy)?),
        ("rotate", [turn]) => Affine::rotation(angle(turn)?, Point::new(0.0, 0.0)),
        ("skew", [ax]) | ("skewX", [ax]) => skew(angle(ax)?, 0.0),
        ("skew", [ax, ay]) => skew(angle(ax)?, angle(ay)?),
        ("skewY", [ay]) => skew(0.0, angle(ay)?),
        _ => return None,
    })
}

fn translation(x: f64, y: f64) -> Affine {
    Affine::translation(Point::new(x, y))
}

fn scale(x: f64, y: f64) -> Affine {
    Affine::scale(x, y, Point::new(0.0, 0.0))
}

fn skew(x_rad: f64, y_rad: f64) -> Affine {
    Affine {
        x: Point::new(1.0, y_rad.tan()),
        y: Point::new(x_rad.tan(), 1.0),
        origin: Point::new(0.0, 0.0),
    }
}

fn finite([a, b, c, d, e, f]: [f64; 6]) -> Option<Affine> {
    let affine = Affine {
        x: Point::new(a, b),
        y: Point::new(c, d),
        origin: Point::new(e, f),
    };
    affine.is_finite().then_some(affine)
}

/// Parses a number or a percentage.
fn number(text: &str) -> Option<f64> {
    let number = match text.strip_suffix('%') {
        Some(percent) => percent.parse::<f64>().ok()? / 100.0,
        None => text.parse().ok()?,
    };
    number.is_finite().then_some(number)
}

/// Parses an angle to radians. A number without a unit is in degrees.
fn angle(text: &str) -> Option<f64> {
    let angle = Angle::from_str(text).ok()?;
    let radians = match angle.unit {
        AngleUnit::Degrees => angle.number.to_radians(),
        AngleUnit::Gradians => angle.number * std::f64::consts::TAU / 400.0,
        AngleUnit::Radians => angle.number,
        AngleUnit::Turns => angle.number * std::f64::consts::TAU,
    };
    radians.is_finite().then_some(radians)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn assert_near(found: Point<f64>, expected: [f64; 2], text: &str) {
        let expected = Point::new(expected[0], expected[1]);
        assert!(found.distance(expected) < 1e-9, "{text}: {found:?}");
    }

    #[test]
    fn functions_map_a_point() {
        let viewport = Viewport::new(200.0, 100.0);
        for (text, expected) in [
            ("none", [3.0, 4.0]),
            ("translate(30px, 1in) rotate(90deg)", [26.0, 99.0]),
            ("rotate(0.25turn)", [-4.0, 3.0]),
            ("rotate(100grad)", [-4.0, 3.0]),
            ("scale(2)", [6.0, 8.0]),
            ("scale(200%, -1) translateY(10%)", [6.0, -14.0]),
            ("translateX(50%)", [103.0, 4.0]),
            ("skewX(45deg)", [7.0, 4.0]),
            ("skew(0, 45deg)", [3.0, 7.0]),
            ("matrix(0, 1, -1, 0, 5, 6)", [1.0, 9.0]),
        ] {
            let found = css_transform(text, viewport).unwrap();
            assert_near(found.apply(Point::new(3.0, 4.0)), expected, text);
        }
        for text in [
            "scale(2",
            "scale()",
            "rotate3d(1,1,1,45deg)",
            "qwe",
            "matrix(1,2)",
        ] {
            assert!(!is_transform(text), "{text}");
        }
    }

    #[test]
    fn origins_have_names_lengths_and_percentages() {
        let viewport = Viewport::new(200.0, 100.0);
        for (text, expected) in [
            ("center", [100.0, 50.0]),
            ("left", [0.0, 50.0]),
            ("bottom", [100.0, 100.0]),
            ("bottom right", [200.0, 100.0]),
            ("top 10px", [10.0, 0.0]),
            ("60 60", [60.0, 60.0]),
            ("25% 1em 3px", [50.0, 16.0]),
        ] {
            let found = transform_origin(text, viewport).unwrap();
            assert_near(found, expected, text);
        }
        for text in ["", "nowhere", "left left", "1 2 3 4"] {
            assert!(!is_origin(text), "{text}");
        }
    }
}
