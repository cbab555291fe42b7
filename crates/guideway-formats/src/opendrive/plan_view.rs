//! Reads the plan view of a road: `geometry` elements in, segments of the reference line out.

use std::f64::consts::TAU;

use guideway_layout::Code;
use guideway_spline::Point;
use roxmltree::Node;

use super::arc_length::ArcLength;
use super::geometry::{Geometry, Shape, parameter_at_length};
use super::polynomial::Cubic;
use super::reader::DocumentReader;
use crate::xml::child;

/// Headings beyond it are probably degrees, in radians. Those of the public roads are within half a
/// turn; programs that add angles up may exceed a whole one.
const LARGEST_HEADING: f64 = 2.0 * TAU;

/// Reads a `geometry` element; `None`, with a finding, if its numbers give no curve.
pub(super) fn read_geometry<'d, 't>(
    reader: &mut DocumentReader<'_, 'd, 't>,
    node: Node<'d, 't>,
) -> Option<Geometry> {
    let [start_m, x, y, heading, length_m] =
        ["s", "x", "y", "hdg", "length"].map(|key| reader.number(node, key));
    let (start_m, x, y, heading, length_m) = (start_m?, x?, y?, heading?, length_m?);
    let origin = Point::new(x, y);
    if !reader.check_point(origin, node) {
        return None;
    }
    let max_m = reader.base.builder.source.options.limits.coordinate_m;
    if !(0.0..=max_m).contains(&length_m) || start_m.abs() > max_m {
        let message = || {
            format!("its length is {length_m} m and its start {start_m} m, expected 0 to {max_m} m")
        };
        let remedy = "It is left out; correct the length and `s`";
        reader.report(Code::OutOfRange, node, message, remedy);
        return None;
    }
    if heading.abs() > LARGEST_HEADING {
        let message = || format!("its heading is {heading:?} rad");
        let remedy = "Check whether the angles are in degrees";
        reader.report(Code::Implausible, node, message, remedy);
    }
    let Some(shape) = read_shape(reader, node, heading, length_m) else {
        let message = || "it has no valid line, arc, spiral or polynomial".to_owned();
        let remedy = "It is left out with the lanes beside it; correct it";
        reader.report(Code::UnknownValue, node, message, remedy);
        return None;
    };
    Some(Geometry {
        start_m,
        length_m,
        origin,
        heading,
        shape,
    })
}

fn read_shape<'d, 't>(
    reader: &mut DocumentReader<'_, 'd, 't>,
    geometry: Node<'d, 't>,
    heading: f64,
    length_m: f64,
) -> Option<Shape> {
    let mut counts = reader.shape_counts.iter_mut();
    let (tag, count) = counts.find(|(tag, _)| child(geometry, tag).is_some())?;
    *count += 1;
    let tag = *tag;
    let node = child(geometry, tag)?;
    let mut cubic = |keys: [&'static str; 4]| {
        let [a, b, c, d] = keys.map(|key| reader.number(node, key));
        Some(Cubic {
            a: a?,
            b: b?,
            c: c?,
            d: d?,
        })
    };
    let shape = match tag {
        "line" => clothoid(reader, [0.0, 0.0], heading, length_m)?,
        "arc" => {
            let curvature = reader.number(node, "curvature")?;
            clothoid(reader, [curvature, 0.0], heading, length_m)?
        }
        "spiral" => {
            let [start, end] = ["curvStart", "curvEnd"].map(|key| reader.number(node, key));
            let (start, end) = (start?, end?);
            let rate = if length_m > 0.0 {
                (end - start) / length_m
            } else {
                0.0
            };
            clothoid(reader, [start, rate], heading, length_m)?
        }
        "poly3" => {
            let v = cubic(["a", "b", "c", "d"])?;
            // The file gives v as a function of u, and the length along the curve.
            let u = Cubic {
                b: 1.0,
                ..Cubic::default()
            };
            polynomial(
                reader,
                geometry,
                [u, v],
                parameter_at_length(v, length_m),
                length_m,
            )?
        }
        _ => {
            let (u, v) = (
                cubic(["aU", "bU", "cU", "dU"])?,
                cubic(["aV", "bV", "cV", "dV"])?,
            );
            let end = match node.attribute("pRange") {
                Some("arcLength") => length_m,
                _ => 1.0,
            };
            polynomial(reader, geometry, [u, v], end, length_m)?
        }
    };
    Some(shape)
}

/// Relative difference between the stated length of a curve and its own that is reported.
const MAX_LENGTH_ERROR: f64 = 0.01;

/// A parametric cubic on the parameters from 0 to `end`. Reports a finding if its length is not the
/// stated one. Charges its panels to the budget of control points.
fn polynomial<'d, 't>(
    reader: &mut DocumentReader<'_, 'd, 't>,
    geometry: Node<'d, 't>,
    [u, v]: [Cubic; 2],
    end: f64,
    length_m: f64,
) -> Option<Shape> {
    let arc = ArcLength::new(u, v, end)?;
    let points_left = &mut reader.base.builder.points_left;
    *points_left = points_left.checked_sub(arc.panel_count())?;
    let scale = arc.total() / length_m;
    if (scale - 1.0).abs() > MAX_LENGTH_ERROR {
        let message = || {
            format!(
                "its `length` is {length_m} m; its curve is {:.3} m long",
                arc.total()
            )
        };
        let remedy =
            "The whole curve is drawn, and lanes are stretched along it; correct the length";
        reader.report(Code::Implausible, geometry, message, remedy);
    }
    scale.is_finite().then_some(Shape::Cubic { arc, scale })
}

/// A clothoid. Charges its quadrature panels to the budget of control points, because both take
/// memory in proportion to the turning angle.
fn clothoid(
    reader: &mut DocumentReader<'_, '_, '_>,
    curvature: [f64; 2],
    heading: f64,
    length_m: f64,
) -> Option<Shape> {
    let builder = &mut reader.base.builder;
    let shape = Shape::clothoid(curvature, heading, length_m, builder.points_left)?;
    if let Shape::Clothoid { panels, .. } = &shape {
        builder.points_left -= panels.len() as u64;
    }
    Some(shape)
}
