//! Scenes far from the origin, and at extreme scales.

use super::scene_case::{SceneCase, case};
use crate::sketch::Sketch;

pub(super) fn cases() -> Vec<SceneCase> {
    let mut cases = Vec::new();
    for (name, x, y) in [
        ("origin", 0.0, 0.0),
        ("1e4m", 1e4, -1e4),
        ("1e7m", 1e7, 1e7),
        ("minus-1e7m", -1e7, -1e7),
        ("odd-millions", 4_512_345.678, -9_876_543.21),
    ] {
        cases.push(case(format!("far/at-{name}"), move || {
            three_paths().px_per_m(100.0).at(x, y)
        }));
    }
    cases.push(case("far/1px-is-1mm-at-1e7m", || {
        three_paths().px_per_m(1000.0).at(1e7, -1e7)
    }));
    for (name, px_per_m) in [
        ("0.1mm", 1e4),
        ("1um", 1e6),
        ("1km", 1e-3),
        ("1000km", 1e-6),
    ] {
        cases.push(case(format!("zoom/1px-is-{name}"), move || {
            three_paths().px_per_m(px_per_m)
        }));
    }
    for (name, length_px) in [("1e4", 1e4), ("1e6", 1e6), ("1e9", 1e9)] {
        cases.push(case(format!("zoom/line-of-{name}px-crosses"), move || {
            Sketch::new(96, 64).width(3.0).line(
                (-0.6 * length_px, -0.3 * length_px + 20.0),
                (0.4 * length_px, 0.2 * length_px + 20.0),
            )
        }));
        cases.push(case(format!("zoom/curve-of-{name}px-crosses"), move || {
            // The segment is centered in the picture.
            let l = length_px;
            let control = [
                (-l, -0.1 * l),
                (-0.3 * l, 0.2 * l),
                (0.3 * l, -0.2 * l),
                (l, 0.1 * l),
            ];
            Sketch::new(96, 64)
                .width(4.0)
                .curve(&control.map(|(x, y)| (x + 48.0, y + 32.0)))
        }));
    }
    cases.push(case("zoom/part-of-a-long-run", || {
        let control: Vec<_> = (0..200)
            .map(|i| {
                (
                    700.0 * f64::from(i) - 50_000.0,
                    48.0 + 900.0 * (0.37 * (f64::from(i) - 71.5)).sin(),
                )
            })
            .collect();
        Sketch::new(128, 96).curve(&control).width(6.0)
    }));
    cases.push(case("zoom/line-of-1000km-at-0.1mm", || {
        Sketch::new(96, 64)
            .px_per_m(1e4)
            .width(3.0)
            .line((-5e9, 40.0), (5e9, 20.0))
    }));
    for (name, length_px) in [("20px", 20.0), ("600px", 600.0)] {
        cases.push(case(
            format!("zoom/paths-of-{name}-small-beside-the-scene"),
            move || small_beside_the_scene(length_px),
        ));
    }
    cases.push(case("zoom/crowd-on-one-pixel", || {
        (0..200).fold(Sketch::new(48, 48).width(0.004), |sketch, i| {
            let x = 24.1 + 0.004 * f64::from(i);
            sketch.line((x, 24.1), (x + 0.01, 24.9))
        })
    }));
    cases
}

fn three_paths() -> Sketch {
    Sketch::new(96, 64)
        .width(2.5)
        .line((8.3, 8.9), (88.1, 20.4))
        .curve(&[(-30.0, 90.0), (20.0, 22.0), (70.0, 50.0), (120.0, -30.0)])
        .color(0xc030_20ff)
        .curve(&[
            (10.0, 50.0),
            (30.0, 58.0),
            (50.0, 44.0),
            (70.0, 60.0),
            (90.0, 40.0),
        ])
        .own_width(5.0)
}

/// Bent paths across the picture, and one far away, so that a method may round the points of the
/// others.
fn small_beside_the_scene(length_px: f64) -> Sketch {
    let far = Sketch::new(96, 64)
        .width(1.5)
        .line((1e5, 0.0), (1e5 + 9.0, 5.0));
    (0..300_u32).fold(far, |sketch, path| {
        let f = f64::from(path);
        let position =
            |share: f64, side: f64| (f * share).fract() * (side + length_px) - length_px / 2.0;
        let (x, y) = (position(0.618_034, 96.0), position(0.754_878, 64.0));
        let control = [0.0, 0.25, 0.5, 0.75, 1.0].map(|part| {
            let turn = 2.4 * f + 1.5 * part;
            let out_px = length_px * part;
            (x + out_px * turn.cos(), y + out_px * turn.sin())
        });
        let color = path.wrapping_mul(0x9e37_79b9) | 0xff;
        sketch.curve(&control).color(color)
    })
}
