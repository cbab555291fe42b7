//! Converts `path` elements and the basic shapes to runs.

use std::f64::consts::{FRAC_PI_2, TAU};

use guideway_spline::{Affine, Point};
use roxmltree::Node;
use svgtypes::PointsParser;

use super::cascade::{Cascade, path_function};
use super::path_builder::PathBuilder;
use super::viewport::Viewport;

/// Elements that draw lines or curves.
pub(super) const SHAPES: [&str; 7] = [
    "path", "rect", "circle", "ellipse", "line", "polyline", "polygon",
];

/// A shape whose attributes are invalid.
#[derive(Debug, thiserror::Error)]
pub(super) enum ShapeError {
    /// A malformed command of path data.
    #[error("{0}")]
    PathData(#[from] svgtypes::Error),
    /// A rectangle without an area.
    #[error("its width is {width} and its height {height}; both must be above 0")]
    RectSize { width: f64, height: f64 },
    /// A circle or an ellipse without an area.
    #[error("its radius is {0}; it must be above 0")]
    Radius(f64),
}

/// Appends the curve of an element. A property of its geometry counts more than the attribute.
///
/// # Errors
/// When an attribute is invalid. The curve up to the error stays in `path`.
pub(super) fn append_shape(
    node: Node<'_, '_>,
    cascade: &Cascade<'_>,
    viewport: Viewport,
    path: &mut PathBuilder,
) -> Result<(), ShapeError> {
    let number = |name, reference: fn(Viewport) -> f64| {
        let text = cascade.geometry(name).or_else(|| node.attribute(name))?;
        viewport.length(text, reference)
    };
    let x = |name| number(name, Viewport::width).unwrap_or(0.0);
    let y = |name| number(name, Viewport::height).unwrap_or(0.0);
    match node.tag_name().name() {
        "path" => {
            let data = match cascade.geometry("d") {
                Some(value) => path_function(value),
                None => node.attribute("d"),
            };
            path.push_path_data(data.unwrap_or_default())?;
        }
        "rect" => {
            let (width, height) = (x("width"), y("height"));
            let [rx, ry] = radii(number);
            if !(width > 0.0 && height > 0.0) {
                return Err(ShapeError::RectSize { width, height });
            }
            let corner = [rx.min(width / 2.0), ry.min(height / 2.0)];
            rectangle(Point::new(x("x"), y("y")), [width, height], corner, path);
        }
        tag @ ("circle" | "ellipse") => {
            let r = |name| number(name, Viewport::diagonal).unwrap_or(0.0);
            let [rx, ry] = match tag {
                "circle" => [r("r"), r("r")],
                _ => radii(number),
            };
            if !(rx > 0.0 && ry > 0.0) {
                return Err(ShapeError::Radius(rx.min(ry)));
            }
            path.arc(ellipse(Point::new(x("cx"), y("cy")), rx, ry), 0.0, TAU);
        }
        "line" => {
            path.move_to(Point::new(x("x1"), y("y1")));
            path.line_to(Point::new(x("x2"), y("y2")));
        }
        tag => {
            let mut points = PointsParser::from(node.attribute("points").unwrap_or_default());
            if let Some((x, y)) = points.next() {
                path.move_to(Point::new(x, y));
            }
            for (x, y) in points {
                path.line_to(Point::new(x, y));
            }
            if tag == "polygon" && !path.runs.is_empty() {
                path.close();
            }
        }
    }
    Ok(())
}

/// The first attribute of a shape that should be a length and is none that is read.
pub(super) fn unread_length<'d>(
    node: Node<'d, '_>,
    cascade: &Cascade<'_>,
    viewport: Viewport,
) -> Option<(&'static str, &'d str)> {
    let names: &[&'static str] = match node.tag_name().name() {
        "rect" => &["x", "y", "width", "height", "rx", "ry"],
        "circle" => &["cx", "cy", "r"],
        "ellipse" => &["cx", "cy", "rx", "ry"],
        "line" => &["x1", "y1", "x2", "y2"],
        _ => &[],
    };
    let stated = names
        .iter()
        .filter(|name| cascade.geometry(name).is_none())
        .filter_map(|&name| Some((name, node.attribute(name)?)));
    let mut unread = stated.filter(|(_, text)| {
        let is_word = text.trim() == "auto" || text.trim().is_empty();
        !is_word && viewport.length(text, Viewport::width).is_none()
    });
    unread.next()
}

/// The radii of a rectangle's corner or of an ellipse: one that is missing or negative is as the
/// other one, and both are 0 without any.
fn radii(number: impl Fn(&'static str, fn(Viewport) -> f64) -> Option<f64>) -> [f64; 2] {
    let radius = |name, reference: fn(Viewport) -> f64| {
        number(name, reference).filter(|&radius| radius >= 0.0)
    };
    let (rx, ry) = (
        radius("rx", Viewport::width),
        radius("ry", Viewport::height),
    );
    [rx.or(ry), ry.or(rx)].map(|radius| radius.unwrap_or(0.0))
}

/// The map from the unit circle to an axis-aligned ellipse.
fn ellipse(origin: Point<f64>, rx: f64, ry: f64) -> Affine {
    Affine {
        x: Point::new(rx, 0.0),
        y: Point::new(0.0, ry),
        origin,
    }
}

/// Appends a rectangle, clockwise on screen from its top left corner, with elliptical corners.
fn rectangle(
    corner: Point<f64>,
    [width, height]: [f64; 2],
    [rx, ry]: [f64; 2],
    path: &mut PathBuilder,
) {
    let opposite = corner + Point::new(width, height);
    let is_round = rx > 0.0 && ry > 0.0;
    let (rx, ry) = if is_round { (rx, ry) } else { (0.0, 0.0) };
    let (left, right) = (corner.x + rx, opposite.x - rx);
    let (top, bottom) = (corner.y + ry, opposite.y - ry);
    let sides = [
        [(left, corner.y), (right, corner.y)],
        [(opposite.x, top), (opposite.x, bottom)],
        [(right, opposite.y), (left, opposite.y)],
        [(corner.x, bottom), (corner.x, top)],
    ];
    let corners = [(right, top), (right, bottom), (left, bottom), (left, top)];
    for (index, ([from, to], center)) in sides.into_iter().zip(corners).enumerate() {
        let [from, to, center] = [from, to, center].map(|(x, y)| Point::new(x, y));
        if from != to {
            path.move_to(from);
            path.line_to(to);
        }
        if is_round {
            let start = (index as f64 - 1.0) * FRAC_PI_2;
            path.arc(ellipse(center, rx, ry), start, FRAC_PI_2);
        }
    }
}
