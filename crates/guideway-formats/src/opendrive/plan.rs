//! The plan view of a road: its records become lines.

use guideway_layout::Code;
use guideway_spline::Point;
use roxmltree::Node;

use super::polynomial::Cubic;
use super::reference::{Line, Shape, reach};
use super::road::Mapper;
use crate::xml::child;

impl<'d, 't> Mapper<'_, 'd, 't> {
    /// A record of the plan view; none if its numbers make no line.
    pub(super) fn line(&mut self, node: Node<'d, 't>) -> Option<Line> {
        let [start_m, x, y, heading, length_m] =
            ["s", "x", "y", "hdg", "length"].map(|key| self.number(node, key));
        let (start_m, x, y, heading, length_m) = (start_m?, x?, y?, heading?, length_m?);
        let origin = Point::new(x, y);
        let xml = self.xml;
        if !self.builder.check_point(origin, &|| xml.place(node)) {
            return None;
        }
        let most = self.builder.source.options.limits.coordinate_m;
        if !(0.0..=most).contains(&length_m) || start_m.abs() > most {
            let message = || format!("the length is {length_m} m, at {start_m} m of the road");
            let remedy = "It is left out; correct the length";
            self.report(Code::OutOfRange, node, message, remedy);
            return None;
        }
        let Some(shape) = self.shape(node, heading, length_m) else {
            let message =
                || "it holds no line, arc, spiral or polynomial, or one without end".to_owned();
            let remedy = "It is left out, and the lanes there too; correct it";
            self.report(Code::UnknownValue, node, message, remedy);
            return None;
        };
        Some(Line {
            start_m,
            length_m,
            origin,
            heading,
            shape,
        })
    }

    fn shape(&mut self, geometry: Node<'d, 't>, heading: f64, length_m: f64) -> Option<Shape> {
        let found = self
            .shapes
            .iter()
            .position(|(tag, _)| child(geometry, tag).is_some());
        let (tag, count) = &mut self.shapes[found?];
        *count += 1;
        let node = child(geometry, tag)?;
        let tag = *tag;
        let mut cubic = |keys: [&'static str; 4]| {
            let [a, b, c, d] = keys.map(|key| self.number(node, key));
            Some(Cubic {
                a: a?,
                b: b?,
                c: c?,
                d: d?,
            })
        };
        let shape = match tag {
            "line" => self.turn([0.0, 0.0], heading, length_m)?,
            "arc" => {
                let curvature = self.number(node, "curvature")?;
                self.turn([curvature, 0.0], heading, length_m)?
            }
            "spiral" => {
                let [start, end] = ["curvStart", "curvEnd"].map(|key| self.number(node, key));
                let (start, end) = (start?, end?);
                let rate = if length_m > 0.0 {
                    (end - start) / length_m
                } else {
                    0.0
                };
                self.turn([start, rate], heading, length_m)?
            }
            "poly3" => {
                let v = cubic(["a", "b", "c", "d"])?;
                // The file has a function of u, and its length along the curve.
                let factor = reach(v, length_m) / length_m;
                let u = Cubic {
                    b: 1.0,
                    ..Cubic::default()
                };
                Shape::Cubic {
                    u: u.stretched(factor),
                    v: v.stretched(factor),
                }
            }
            _ => {
                let (u, v) = (
                    cubic(["aU", "bU", "cU", "dU"])?,
                    cubic(["aV", "bV", "cV", "dV"])?,
                );
                let factor = match node.attribute("pRange") {
                    Some("arcLength") => 1.0,
                    _ => 1.0 / length_m,
                };
                Shape::Cubic {
                    u: u.stretched(factor),
                    v: v.stretched(factor),
                }
            }
        };
        match &shape {
            Shape::Cubic { u, v } if !(u.is_finite() && v.is_finite()) => None,
            _ => Some(shape),
        }
    }

    /// A line whose curvature changes evenly. What it takes is paid for as control points are.
    fn turn(&mut self, curvature: [f64; 2], heading: f64, length_m: f64) -> Option<Shape> {
        let most = self.builder.points_left;
        let shape = Shape::turn(curvature, heading, length_m, most)?;
        if let Shape::Turn { panels, .. } = &shape {
            self.builder.points_left -= panels.len() as u64;
        }
        Some(shape)
    }
}
