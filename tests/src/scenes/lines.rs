//! Scenes of straight lines: slopes, positions within a pixel, lengths.

use super::scene_case::{SceneCase, case};
use crate::sketch::Sketch;

pub(super) fn cases() -> Vec<SceneCase> {
    let mut cases = Vec::new();
    for degrees in [
        0, 1, 15, 30, 45, 60, 89, 90, 91, 120, 135, 150, 179, 225, 300,
    ] {
        cases.push(case(format!("lines/slope-{degrees}"), move || {
            slope(degrees)
        }));
    }
    for (name, shift) in [
        ("whole", 0.0),
        ("quarter", 0.25),
        ("half", 0.5),
        ("odd", 0.8137),
    ] {
        cases.push(case(format!("lines/level-at-{name}-pixel"), move || {
            Sketch::new(64, 64)
                .line((8.0, 32.0 + shift), (56.0, 32.0 + shift))
                .width(1.0)
        }));
        cases.push(case(format!("lines/upright-at-{name}-pixel"), move || {
            Sketch::new(64, 64)
                .line((32.0 + shift, 8.0), (32.0 + shift, 56.0))
                .width(1.0)
        }));
    }
    for length in [0.01, 0.1, 0.5, 1.0, 3.0] {
        cases.push(case(format!("lines/length-{length}px"), move || {
            Sketch::new(48, 48)
                .line((24.3, 24.6), (24.3 + 0.8 * length, 24.6 + 0.6 * length))
                .width(3.0)
        }));
    }
    cases.push(case("lines/fan", || {
        (0..24).fold(Sketch::new(128, 128).width(1.0), |sketch, i| {
            let (sin, cos) = (f64::from(i) * std::f64::consts::TAU / 24.0).sin_cos();
            let end = |r: f64| (64.0 + r * cos, 64.0 + r * sin);
            sketch.line(end(14.0), end(58.0))
        })
    }));
    cases.push(case("lines/ruling", || {
        (0..30).fold(Sketch::new(128, 64).width(0.8), |sketch, i| {
            let y = 2.0 + 2.03 * f64::from(i);
            sketch.line((4.0, y), (124.0, y + 0.7))
        })
    }));
    cases.push(case("lines/half-of-the-picture", || {
        Sketch::new(64, 64)
            .line((-20.0, 12.0), (90.0, 12.0))
            .width(40.0)
    }));
    cases
}

fn slope(degrees: u32) -> Sketch {
    let (sin, cos) = f64::from(degrees).to_radians().sin_cos();
    let end = |r: f64| (32.2 + r * cos, 31.7 + r * sin);
    Sketch::new(64, 64).line(end(-24.0), end(24.0))
}
