//! From elements to runs: paths and the basic shapes.

use std::f64::consts::{FRAC_PI_2, TAU};

use guideway_spline::{Affine, Point};
use roxmltree::Node;
use svgtypes::PointsParser;

use super::data::Pen;
use super::page::Viewport;

/// The elements that draw something.
pub(super) const SHAPES: [&str; 7] = [
    "path", "rect", "circle", "ellipse", "line", "polyline", "polygon",
];

/// Draws an element. Fails where its numbers are wrong, with what is; what comes before that is drawn.
pub(super) fn draw(node: Node<'_, '_>, viewport: Viewport, pen: &mut Pen) -> Result<(), String> {
    let number = |name, whole: fn(Viewport) -> f64| viewport.attribute(node, name, whole);
    let (across, down) = (
        Viewport::width as fn(Viewport) -> f64,
        Viewport::height as fn(Viewport) -> f64,
    );
    let x = |name| number(name, across).unwrap_or(0.0);
    let y = |name| number(name, down).unwrap_or(0.0);
    match node.tag_name().name() {
        "path" => pen.follow(node.attribute("d").unwrap_or_default())?,
        "rect" => {
            let (width, height) = (x("width"), y("height"));
            let radii = (number("rx", across), number("ry", down));
            let (rx, ry) = match radii {
                (Some(rx), ry) => (rx, ry.unwrap_or(rx)),
                (None, ry) => (ry.unwrap_or(0.0), ry.unwrap_or(0.0)),
            };
            if !(width > 0.0 && height > 0.0) {
                return Err(format!("its width is {width} and its height {height}"));
            }
            let corner = [rx.clamp(0.0, width / 2.0), ry.clamp(0.0, height / 2.0)];
            rectangle(Point::new(x("x"), y("y")), [width, height], corner, pen);
        }
        tag @ ("circle" | "ellipse") => {
            let r = |name| number(name, Viewport::diagonal).unwrap_or(0.0);
            let (rx, ry) = match tag {
                "circle" => (r("r"), r("r")),
                _ => (x("rx"), y("ry")),
            };
            if !(rx > 0.0 && ry > 0.0) {
                return Err(format!("its radius is {}", rx.min(ry)));
            }
            pen.arc(ellipse(Point::new(x("cx"), y("cy")), rx, ry), 0.0, TAU);
        }
        "line" => {
            pen.move_to(Point::new(x("x1"), y("y1")));
            pen.line_to(Point::new(x("x2"), y("y2")));
        }
        tag => {
            let mut points = PointsParser::from(node.attribute("points").unwrap_or_default());
            if let Some((x, y)) = points.next() {
                pen.move_to(Point::new(x, y));
            }
            for (x, y) in points {
                pen.line_to(Point::new(x, y));
            }
            if tag == "polygon" && !pen.runs.is_empty() {
                pen.close();
            }
        }
    }
    Ok(())
}

fn ellipse(origin: Point<f64>, rx: f64, ry: f64) -> Affine {
    Affine {
        x: Point::new(rx, 0.0),
        y: Point::new(0.0, ry),
        origin,
    }
}

fn rectangle(corner: Point<f64>, [width, height]: [f64; 2], [rx, ry]: [f64; 2], pen: &mut Pen) {
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
            pen.move_to(from);
            pen.line_to(to);
        }
        if is_round {
            let start = (index as f64 - 1.0) * FRAC_PI_2;
            pen.arc(ellipse(center, rx, ry), start, FRAC_PI_2);
        }
    }
}
