//! Scenes of widths from 0.02 px to wider than the picture, by every line rule.

use guideway_scene::LineRule;

use super::scene_case::{SceneCase, case};
use crate::sketch::Sketch;

pub(super) fn cases() -> Vec<SceneCase> {
    let mut cases = Vec::new();
    for width in [0.02, 0.1, 0.3, 0.5, 0.7, 0.9] {
        cases.push(case(format!("widths/{width}px"), move || {
            two_lines_and_a_bend().width(width)
        }));
    }
    for width in [1.0, 1.5, 3.0, 12.0, 33.0] {
        cases.push(case(format!("widths/{width}px"), move || {
            two_lines_and_a_bend().width(width)
        }));
    }
    for (name, width) in [
        ("as-wide-as-the-picture", 80.0),
        ("wider-than-the-picture", 500.0),
        ("wider-than-a-city", 1e6),
    ] {
        cases.push(case(format!("widths/{name}"), move || {
            Sketch::new(64, 64)
                .line((30.0, 30.0), (34.0, 33.0))
                .width(width)
        }));
    }
    cases.push(case("widths/edge-of-a-huge-disc", || {
        Sketch::new(64, 64)
            .curve(&[(-2000.0, 900.0); 4])
            .width(4420.0)
    }));
    cases.push(case("widths/zero-leaves-nothing", || {
        two_lines_and_a_bend().width(0.0)
    }));
    for (name, scale) in [("least", 0.5), ("own", 30.0), ("greatest", 400.0)] {
        cases.push(case(format!("widths/world-held-at-{name}"), move || {
            two_lines_and_a_bend()
                .px_per_m(scale)
                .rule(LineRule::World {
                    width_m: 0.1,
                    min_px: 1.2,
                    max_px: 9.0,
                })
        }));
    }
    cases.push(case("widths/least-above-greatest", || {
        two_lines_and_a_bend().rule(LineRule::World {
            width_m: 1.0,
            min_px: 5.0,
            max_px: 2.0,
        })
    }));
    for scale in [0.1, 1.0, 5.0, 12.0, 100.0, 1000.0, 4000.0] {
        cases.push(case(
            format!("widths/thesis-at-{scale}px-per-m"),
            move || {
                two_lines_and_a_bend()
                    .px_per_m(scale)
                    .rule(LineRule::Thesis)
            },
        ));
    }
    cases.push(case("widths/of-each-path", || {
        (0..8).fold(Sketch::new(128, 96), |sketch, i| {
            let y = 6.0 + 11.5 * f64::from(i);
            sketch
                .line((14.0, y), (114.0, y + 3.0))
                .own_width(0.2 + 1.3 * f64::from(i))
        })
    }));
    cases.push(case("widths/of-some-paths", || {
        Sketch::new(96, 64)
            .width(1.5)
            .line((10.0, 12.0), (86.0, 16.0))
            .line((10.0, 30.0), (86.0, 34.0))
            .own_width(9.0)
            .line((10.0, 48.0), (86.0, 52.0))
    }));
    cases.push(case("widths/of-each-path-held-by-the-rule", || {
        (0..8).fold(
            Sketch::new(128, 96).px_per_m(20.0).rule(LineRule::World {
                width_m: 0.2,
                min_px: 2.0,
                max_px: 6.0,
            }),
            |sketch, i| {
                let y = 8.0 + 11.0 * f64::from(i);
                sketch
                    .line((14.0, y), (114.0, y + 3.0))
                    .own_width(1.4 * f64::from(i))
            },
        )
    }));
    cases.push(case("widths/thesis-ignores-those-of-paths", || {
        Sketch::new(96, 64)
            .px_per_m(12.0)
            .rule(LineRule::Thesis)
            .line((10.0, 20.0), (86.0, 24.0))
            .own_width(20.0)
            .line((10.0, 40.0), (86.0, 44.0))
    }));
    cases
}

fn two_lines_and_a_bend() -> Sketch {
    Sketch::new(96, 64)
        .line((12.3, 10.1), (84.2, 10.1))
        .line((12.0, 54.0), (30.0, 16.5))
        .curve(&[(0.0, -40.0), (30.0, 46.0), (70.0, 46.0), (100.0, -40.0)])
}
