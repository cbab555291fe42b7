//! Scenes of caps, joins, curves, cusps, loops and degenerate curves.

use super::scene_case::{SceneCase, case};
use crate::sketch::Sketch;

/// One segment that crosses itself: Bezier (10, 10), (110, 80), (-30, 80), (70, 10).
pub(super) const LOOP: [(f64, f64); 4] = [
    (-770.0, -340.0),
    (250.0, 80.0),
    (-170.0, 80.0),
    (850.0, -340.0),
];

pub(super) fn cases() -> Vec<SceneCase> {
    let mut cases = caps_and_joins();
    cases.extend(curves());
    cases.extend(degenerate());
    cases
}

fn caps_and_joins() -> Vec<SceneCase> {
    let corner = |degrees: f64| {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let end = (40.0 + 26.0 * cos, 40.0 + 26.0 * sin);
        Sketch::new(80, 80)
            .polyline(&[(66.0, 40.0), (40.0, 40.0), end])
            .width(9.0)
    };
    let mut cases = vec![
        case("caps/level", || {
            Sketch::new(64, 48)
                .line((18.0, 24.0), (46.0, 24.0))
                .width(20.0)
        }),
        case("caps/slanted", || {
            Sketch::new(64, 64)
                .line((20.5, 20.2), (44.0, 39.0))
                .width(17.0)
        }),
        case("caps/one-end-outside", || {
            Sketch::new(64, 48)
                .line((-40.0, 10.0), (40.0, 24.0))
                .width(15.0)
        }),
        case("caps/only-the-cap-is-seen", || {
            Sketch::new(64, 48)
                .line((-60.0, 24.0), (-6.0, 24.0))
                .width(30.0)
        }),
        case("caps/only-a-corner-is-seen", || {
            Sketch::new(64, 48)
                .line((-60.0, -9.0), (-7.0, -7.0))
                .width(24.0)
        }),
        case("joins/zigzag", || {
            let corners = [8.0, 24.0, 40.0, 56.0, 72.0, 88.0]
                .map(|x| (x, if x as i32 / 16 % 2 == 0 { 12.0 } else { 52.0 }));
            Sketch::new(96, 64).polyline(&corners).width(5.0)
        }),
        case("joins/turn-back", || {
            Sketch::new(64, 48)
                .polyline(&[(12.0, 24.0), (50.0, 24.0), (30.0, 24.0)])
                .width(8.0)
        }),
        case("joins/square", || {
            Sketch::new(64, 64)
                .polyline(&[
                    (14.0, 14.0),
                    (50.0, 14.0),
                    (50.0, 50.0),
                    (14.0, 50.0),
                    (14.0, 14.0),
                ])
                .width(6.0)
        }),
        case("joins/triple-control-point", || {
            let corner = (44.0, 14.0);
            Sketch::new(64, 64)
                .curve(&[
                    (-30.0, 14.0),
                    (8.0, 14.0),
                    corner,
                    corner,
                    corner,
                    (44.0, 54.0),
                    (44.0, 90.0),
                ])
                .width(7.0)
        }),
    ];
    for degrees in [15, 45, 90, 135, 170, 179] {
        cases.push(case(format!("joins/corner-{degrees}"), move || {
            corner(f64::from(degrees))
        }));
    }
    cases
}

fn curves() -> Vec<SceneCase> {
    vec![
        case("curves/arch", || {
            Sketch::new(96, 64).curve(&[(-40.0, -60.0), (16.0, 50.0), (80.0, 50.0), (136.0, -60.0)])
        }),
        case("curves/s-bend", || {
            Sketch::new(96, 96)
                .curve(&[
                    (-60.0, 10.0),
                    (10.0, 16.0),
                    (60.0, 16.0),
                    (36.0, 80.0),
                    (90.0, 80.0),
                    (160.0, 90.0),
                ])
                .width(4.0)
        }),
        case("curves/spiral", || {
            let control: Vec<_> = (0..40)
                .map(|i| {
                    let (sin, cos) = (f64::from(i) * 0.6).sin_cos();
                    let radius = 2.0 + 1.4 * f64::from(i);
                    (64.0 + radius * cos, 64.0 + radius * sin)
                })
                .collect();
            Sketch::new(128, 128).curve(&control).width(2.5)
        }),
        case("curves/tight-turn-inside-the-stroke", || {
            Sketch::new(64, 64)
                .curve(&[
                    (-16.0, 30.0),
                    (4.0, 30.0),
                    (24.0, 30.0),
                    (40.0, 32.0),
                    (24.0, 34.0),
                    (4.0, 34.0),
                    (-16.0, 34.0),
                ])
                .width(14.0)
        }),
        case("curves/ripple-below-a-pixel", || {
            let control: Vec<_> = (0..60)
                .map(|i| (2.0 * f64::from(i) - 10.0, 32.0 + 0.6 * f64::from(i % 2)))
                .collect();
            Sketch::new(96, 64).curve(&control).width(1.2)
        }),
        case("curves/closed-ring", || {
            let control: Vec<_> = (0..11)
                .map(|i| {
                    let (sin, cos) = (f64::from(i) * std::f64::consts::TAU / 8.0).sin_cos();
                    (40.0 + 30.0 * cos, 40.0 + 30.0 * sin)
                })
                .collect();
            Sketch::new(80, 80).curve(&control).width(5.0)
        }),
        case("cusps/half-way", || {
            Sketch::new(80, 64)
                .curve(&[(-136.0, -88.0), (80.0, 56.0), (0.0, 56.0), (216.0, -88.0)])
                .width(3.0)
        }),
        case("cusps/nearly", || {
            Sketch::new(80, 64)
                .curve(&[(-133.0, -88.0), (79.0, 56.0), (1.0, 56.0), (213.0, -88.0)])
                .width(0.9)
        }),
        case("cusps/there-and-back-along-a-line", || {
            Sketch::new(80, 48)
                .curve(&[(-100.0, 24.0), (70.0, 24.0), (70.0, 24.0), (-100.0, 24.0)])
                .width(5.0)
        }),
        case("loops/one-segment", || {
            Sketch::new(80, 80).curve(&LOOP).width(3.0)
        }),
        case("loops/pin-hole", || {
            Sketch::new(80, 64)
                .curve(&[
                    (-446.0, -240.0),
                    (142.0, 60.0),
                    (-62.0, 60.0),
                    (526.0, -240.0),
                ])
                .width(1.5)
        }),
        case("loops/self-overlap-wide", || {
            Sketch::new(80, 80).curve(&LOOP).width(16.0)
        }),
        case("loops/knot-of-many-turns", || {
            let control: Vec<_> = (0..90)
                .map(|i| {
                    let t = f64::from(i) * 0.2;
                    (64.0 + 52.0 * (5.0 * t).sin(), 64.0 + 52.0 * (4.0 * t).cos())
                })
                .collect();
            Sketch::new(128, 128).curve(&control).width(3.0)
        }),
        case("runs/two-that-meet", || {
            Sketch::new(80, 48)
                .runs(&[
                    &[(-30.0, 24.0), (10.0, 24.0), (40.0, 24.0), (76.0, 24.0)],
                    &[(16.0, 40.0), (40.0, 24.0), (64.0, 8.0), (88.0, -8.0)],
                ])
                .width(6.0)
        }),
        case("runs/gap-between", || {
            Sketch::new(80, 48)
                .runs(&[
                    &[(-10.0, 24.0), (10.0, 24.0), (30.0, 24.0), (50.0, 24.0)],
                    &[(30.0, 30.0), (50.0, 24.0), (70.0, 18.0), (90.0, 12.0)],
                ])
                .width(5.0)
        }),
        case("runs/twenty", || {
            let corners: Vec<_> = (0..21)
                .map(|i| (4.0 + 6.0 * f64::from(i), 32.0 + 24.0 * f64::from(i).sin()))
                .collect();
            Sketch::new(128, 64).polyline(&corners)
        }),
    ]
}

fn degenerate() -> Vec<SceneCase> {
    let dot = |x: f64, y: f64, width: f64| Sketch::new(48, 48).curve(&[(x, y); 4]).width(width);
    vec![
        case("dots/in-the-middle-of-a-pixel", move || {
            dot(24.5, 24.5, 9.0)
        }),
        case("dots/on-a-corner-of-pixels", move || dot(24.0, 24.0, 9.0)),
        case("dots/below-a-pixel", move || dot(24.3, 24.6, 0.7)),
        case("dots/large", move || dot(20.0, 28.0, 37.0)),
        case("dots/all-points-equal-in-a-long-run", || {
            Sketch::new(48, 48).curve(&[(24.2, 23.1); 40]).width(11.0)
        }),
        case("dots/row", || {
            (0..12).fold(Sketch::new(128, 32), |sketch, i| {
                let x = 10.2 + 9.7 * f64::from(i);
                sketch
                    .curve(&[(x, 16.0); 4])
                    .own_width(0.3 + 0.6 * f64::from(i))
            })
        }),
        case("collinear/uneven-steps", || {
            Sketch::new(80, 48)
                .curve(&[
                    (-20.0, 10.0),
                    (12.0, 18.0),
                    (16.0, 19.0),
                    (64.0, 31.0),
                    (68.0, 32.0),
                ])
                .width(4.0)
        }),
        case("collinear/folds-over-itself", || {
            Sketch::new(80, 48)
                .curve(&[
                    (10.0, 24.0),
                    (60.0, 24.0),
                    (20.0, 24.0),
                    (70.0, 24.0),
                    (30.0, 24.0),
                ])
                .width(4.0)
        }),
        case("collinear/first-points-equal", || {
            Sketch::new(80, 48)
                .curve(&[
                    (14.0, 14.0),
                    (14.0, 14.0),
                    (14.0, 14.0),
                    (66.0, 36.0),
                    (66.0, 36.0),
                    (66.0, 36.0),
                ])
                .width(3.0)
        }),
        case("collinear/hardly-bent", || {
            Sketch::new(96, 48)
                .curve(&[
                    (-60.0, 24.0),
                    (8.0, 24.0),
                    (48.0, 24.08),
                    (88.0, 24.0),
                    (150.0, 24.0),
                ])
                .width(1.0)
        }),
    ]
}
