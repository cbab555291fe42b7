//! Generates dataset D2, curves scattered over one field: from a number of paths and a seed to the
//! paths.

use std::f64::consts::TAU;

use guideway_spline::{Bounds, Point, uniform};

use crate::random::Random;
use crate::shape::{self, Run};
use crate::{GeneratedPath, Kind};

/// Width of the field of [`d2`], in meters: 0.1 m per pixel at 1920 pixels.
pub const D2_WIDTH_M: f64 = 192.0;
/// Height of the field of [`d2`], in meters.
pub const D2_HEIGHT_M: f64 = 108.0;

const PIXEL_M: f64 = D2_WIDTH_M / 1920.0;
/// Lengths of the curves in pixels, with a margin inside the documented 20 to 115.
const LENGTH_PX: (f64, f64) = (20.5, 114.5);

/// Curves with the shapes of [`crate::d1`], rotated, stretched and scattered over one field of
/// 16:9.
///
/// Each curve is 20 to 115 pixels long if the field fills 1920 x 1080 pixels, and inside the field.
/// At 756,000 paths, many paths overlap each pixel, more than on any real site: the hard case for a
/// renderer. A smaller set is a prefix of a larger one.
pub fn d2(paths: usize, seed: u64) -> impl Iterator<Item = GeneratedPath> {
    let shapes = shapes();
    // A stream that no hall of D1 uses.
    let mut random = Random::new(seed, u64::MAX >> 2);
    (0..paths).map(move |number| {
        let (kind, shape) = &shapes[random.below(shapes.len() as u32) as usize];
        GeneratedPath {
            id: format!("P{number:07}"),
            kind: *kind,
            max_speed_m_s: kind.max_speed_m_s(),
            hall: 0,
            run: scatter(shape, &mut random).map(Point::to_f32),
        }
    })
}

fn shapes() -> [(Kind, Run); 5] {
    let (origin, right, up) = (Point::default(), Point::new(1.0, 0.0), Point::new(0.0, 1.0));
    [
        (Kind::Aisle, shape::line(origin, right)),
        (Kind::Turn, shape::turn(origin, right, up, 1.0, 0.0)),
        (Kind::UTurn, shape::u_turn(origin, right, up, 1.0)),
        (
            Kind::LaneChange,
            shape::lane_change(origin, right, up * 0.4, 1.0),
        ),
        (Kind::Dock, shape::turn(origin, right, up, 1.0, 2.0)),
    ]
}

/// The shape at a random position, angle and size in the field. A B-spline is affine invariant, so
/// its control points are transformed.
fn scatter(shape: &Run, random: &mut Random) -> Run {
    let stretch = random.between(0.6, 1.6);
    let angle = random.between(0.0, TAU);
    let length = random.between(LENGTH_PX.0, LENGTH_PX.1) * PIXEL_M;
    let position = Point::new(random.between(0.0, 1.0), random.between(0.0, 1.0));

    let stretched = shape.map(|p| Point::new(p.x * stretch, p.y));
    let scale = length / run_length(&stretched);
    let (sin, cos) = (libm::sin(angle) * scale, libm::cos(angle) * scale);
    let turned = stretched.map(|p| Point::new(p.x * cos - p.y * sin, p.x * sin + p.y * cos));

    let (low, high) = turned
        .iter()
        .fold((turned[0], turned[0]), |(low, high), p| {
            (
                Point::new(low.x.min(p.x), low.y.min(p.y)),
                Point::new(high.x.max(p.x), high.y.max(p.y)),
            )
        });
    let shift_range = Bounds {
        min: Point::new(-D2_WIDTH_M / 2.0, -D2_HEIGHT_M / 2.0) - low,
        max: Point::new(D2_WIDTH_M / 2.0, D2_HEIGHT_M / 2.0) - high,
    };
    let shift = Point::new(
        shift_range.min.x + (shift_range.max.x - shift_range.min.x) * position.x,
        shift_range.min.y + (shift_range.max.y - shift_range.min.y) * position.y,
    );
    turned.map(|p| p + shift)
}

/// Arc length of a run by two-point Gauss-Legendre quadrature per segment; the error is negligible
/// at these curvatures.
fn run_length(run: &Run) -> f64 {
    // Nodes on [0, 1]; each has weight 1/2.
    const NODES: [f64; 2] = [0.211_324_865_405_187_1, 0.788_675_134_594_812_9];
    let mut length = 0.0;
    for segment in run.array_windows::<4>() {
        for t in NODES {
            let speed = uniform::derivative(segment, t);
            length += libm::sqrt(speed.dot(speed)) / 2.0;
        }
    }
    length
}
