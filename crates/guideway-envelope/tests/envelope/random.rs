//! Generates random paths, bodies and headings.

use guideway_envelope::{Body, Heading, Sweep};
use guideway_layout::{Layout, NewPath};
use guideway_spline::{Affine, Point, Runs};
use proptest::prelude::*;

pub(crate) type P = Point<f64>;

/// A path as connected Bezier curves.
#[derive(Clone, Debug)]
pub(crate) struct Curve(pub(crate) Vec<[P; 4]>);

/// A vehicle on a path.
#[derive(Clone, Debug)]
pub(crate) struct Case {
    pub(crate) curve: Curve,
    pub(crate) body: Body,
    pub(crate) heading: Heading,
}

impl Case {
    pub(crate) fn sweep(&self) -> Sweep {
        let mut runs = Runs::default();
        self.curve
            .0
            .iter()
            .for_each(|bezier| runs.push_bezier(bezier));
        let mut layout = Layout::default();
        layout.paths.push(&NewPath {
            id: "path",
            runs: &runs,
            ..NewPath::default()
        });
        Sweep::new(layout.paths.get(0), self.body, &[self.heading]).expect("it has a length")
    }
}

pub(crate) fn p(x: f64, y: f64) -> P {
    Point::new(x, y)
}

fn point() -> impl Strategy<Value = P> {
    (-4.0..4.0, -4.0..4.0).prop_map(|(x, y)| p(x, y))
}

fn free() -> impl Strategy<Value = Curve> {
    let legs = prop::collection::vec([point(), point(), point()], 1..3);
    (point(), legs).prop_map(|(start, legs)| {
        let mut start = start;
        let bezier = |[a, b, end]: [P; 3]| {
            let bezier = [start, a, b, end];
            start = end;
            bezier
        };
        Curve(legs.into_iter().map(bezier).collect())
    })
}

/// Straight lines with kinks.
fn polyline() -> impl Strategy<Value = Curve> {
    prop::collection::vec(point(), 2..5).prop_map(|points| {
        let line = |ends: &[P]| {
            let at = |t| ends[0].lerp(ends[1], t);
            [ends[0], at(1.0 / 3.0), at(2.0 / 3.0), ends[1]]
        };
        Curve(points.windows(2).map(line).collect())
    })
}

/// Curves with a cusp: by crossed control points, and along a line.
fn cusp() -> impl Strategy<Value = Curve> {
    let crossed = [p(0.0, 0.0), p(1.0, 1.0), p(0.0, 1.0), p(1.0, 0.0)];
    let back = [p(0.0, 0.0), p(1.0, 0.0), p(1.2, 0.0), p(-0.5, 0.0)];
    let shape = prop_oneof![Just(crossed), Just(back)];
    (shape, 1.0..5.0_f64, 0.0..6.0_f64, point()).prop_map(|(shape, scale, angle, to)| {
        let origin = p(0.0, 0.0);
        let place = Affine::scale(scale, scale, origin)
            .then(Affine::rotation(angle, origin))
            .then(Affine::translation(to));
        Curve(vec![shape.map(|p| place.apply(p))])
    })
}

pub(crate) fn case() -> impl Strategy<Value = Case> {
    let curve = prop_oneof![3 => free(), 2 => polyline(), 2 => cusp()];
    let body = (0.2..2.0_f64, 0.2..1.5_f64, 0.0..1.0_f64)
        .prop_map(|(length, width, rear)| Body::vehicle(length, width, length * rear));
    let heading = prop_oneof![
        2 => Just(Heading::Tangential(0.0)),
        1 => (-3.0..3.0).prop_map(Heading::Tangential),
        1 => (-3.0..3.0).prop_map(Heading::Fixed),
    ];
    (curve, body, heading).prop_map(|(curve, body, heading)| Case {
        curve,
        body,
        heading,
    })
}
