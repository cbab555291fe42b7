use std::f64::consts::TAU;

use guideway_spline::{Bounds, Point, uniform};

use crate::random::Random;
use crate::shape::{self, Run};
use crate::{GeneratedPath, Kind};

/// Width of the field of [`d2`], in meters: a tenth of a meter is a pixel of 1920 across.
pub const D2_WIDTH_M: f64 = 192.0;
/// Height of the field of [`d2`], in meters.
pub const D2_HEIGHT_M: f64 = 108.0;

const PIXEL_M: f64 = D2_WIDTH_M / 1920.0;
/// Lengths of the curves, in pixels, a little within the 20 to 115 that are promised.
const LENGTH_PX: (f64, f64) = (20.5, 114.5);

/// Curves of the shapes of [`crate::d1`] turned, stretched and thrown over one field of 16:9.
///
/// Each is 20 to 115 pixels long when the field fills 1920 x 1080, and all lie within it. At 756,000
/// paths every pixel lies under many, which no site does: it is the hard case for a renderer. The first
/// paths of a larger set are those of the smaller one.
pub fn d2(paths: usize, seed: u64) -> impl Iterator<Item = GeneratedPath> {
    let shapes = shapes();
    // Far from the streams of the halls of the other dataset.
    let mut random = Random::new(seed, u64::MAX >> 2);
    (0..paths).map(move |number| {
        let (kind, shape) = &shapes[random.below(shapes.len() as u32) as usize];
        GeneratedPath {
            id: format!("P{number:07}"),
            kind: *kind,
            max_speed_m_s: kind.max_speed_m_s(),
            hall: 0,
            run: throw(shape, &mut random).map(Point::to_f32),
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

/// The shape somewhere in the field. A B-spline follows its control points through every such change.
fn throw(shape: &Run, random: &mut Random) -> Run {
    let stretch = random.between(0.6, 1.6);
    let angle = random.between(0.0, TAU);
    let length = random.between(LENGTH_PX.0, LENGTH_PX.1) * PIXEL_M;
    let place = Point::new(random.between(0.0, 1.0), random.between(0.0, 1.0));

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
    let room = Bounds {
        min: Point::new(-D2_WIDTH_M / 2.0, -D2_HEIGHT_M / 2.0) - low,
        max: Point::new(D2_WIDTH_M / 2.0, D2_HEIGHT_M / 2.0) - high,
    };
    let shift = Point::new(
        room.min.x + (room.max.x - room.min.x) * place.x,
        room.min.y + (room.max.y - room.min.y) * place.y,
    );
    turned.map(|p| p + shift)
}

/// Length of a run: the speed at two points of each segment, which is exact enough for bends so gentle.
fn run_length(run: &Run) -> f64 {
    // Gauss-Legendre nodes on [0, 1]; each weighs one half.
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
