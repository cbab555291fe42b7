//! Scenes of translucent paths and backgrounds.

use super::scene_case::{SceneCase, case};
use super::shapes::LOOP;
use crate::sketch::Sketch;

const HALF_RED: u32 = 0xd020_2080;
const HALF_BLUE: u32 = 0x2040_d080;
const GREEN: u32 = 0x20a0_30ff;

pub(super) fn cases() -> Vec<SceneCase> {
    let mut cases = vec![
        case("translucent/one", || {
            Sketch::new(64, 48)
                .width(9.0)
                .line((8.0, 12.0), (56.0, 36.0))
                .color(HALF_RED)
        }),
        case("translucent/two-cross", || crossing(HALF_RED, HALF_BLUE)),
        case("translucent/over-opaque", || crossing(GREEN, HALF_BLUE)),
        case("translucent/under-opaque", || crossing(HALF_BLUE, GREEN)),
        case("translucent/opaque-between", || {
            crossing(HALF_RED, GREEN)
                .line((32.0, 6.0), (32.0, 58.0))
                .color(HALF_BLUE)
        }),
        case("translucent/loop-is-no-darker", || {
            Sketch::new(80, 80).width(10.0).curve(&LOOP).color(HALF_RED)
        }),
        case("translucent/joins-are-no-darker", || {
            Sketch::new(64, 64)
                .width(12.0)
                .polyline(&[(12.0, 12.0), (52.0, 20.0), (20.0, 50.0), (52.0, 54.0)])
                .color(HALF_BLUE)
        }),
        case("translucent/fold-is-no-darker", || {
            Sketch::new(80, 48)
                .width(7.0)
                .curve(&[(-100.0, 24.0), (70.0, 24.0), (70.0, 24.0), (-100.0, 24.0)])
                .color(HALF_RED)
        }),
        case("translucent/stack-of-50", || {
            (0..50).fold(Sketch::new(64, 48).width(5.0), |sketch, i| {
                let color = if i % 2 == 0 { 0xd020_2014 } else { 0x2040_d014 };
                sketch
                    .line((8.0, 24.0), (56.0, 8.0 + 0.65 * f64::from(i)))
                    .color(color)
            })
        }),
        case("translucent/stack-of-50-in-one-place", || {
            (0..50).fold(Sketch::new(64, 48).width(7.0), |sketch, i| {
                let color = if i % 2 == 0 { 0xd020_2014 } else { 0x2040_d014 };
                sketch.line((8.0, 10.4), (56.0, 36.2)).color(color)
            })
        }),
        case("translucent/ranks-decide", || {
            Sketch::new(64, 64)
                .width(12.0)
                .line((8.0, 8.0), (56.0, 56.0))
                .color(HALF_RED)
                .rank(2)
                .line((56.0, 8.0), (8.0, 56.0))
                .color(HALF_BLUE)
                .rank(1)
        }),
        case("translucent/thin", || {
            (0..20).fold(Sketch::new(96, 64).width(0.6), |sketch, i| {
                let y = 3.0 + 3.0 * f64::from(i);
                sketch.line((4.0, y), (92.0, 64.0 - y)).color(0x1020_30a0)
            })
        }),
        case("translucent/common-color", || {
            Sketch::new(64, 64)
                .width(9.0)
                .common_color(0x3070_2060)
                .line((8.0, 20.0), (56.0, 44.0))
                .line((8.0, 44.0), (56.0, 20.0))
        }),
        case("translucent/some-among-many-opaque", || {
            (0..60).fold(Sketch::new(96, 64).width(3.0), |sketch, i| {
                let x = 4.0 + 1.5 * f64::from(i);
                let color = if i % 6 == 0 {
                    0xf0c0_1090
                } else {
                    0x3050_7000 + 0xff - i as u32 % 2
                };
                sketch.line((x, 4.0), (96.0 - x, 60.0)).color(color)
            })
        }),
        case("translucent/over-a-transparent-background", || {
            crossing(HALF_RED, HALF_BLUE).background(0xffff_ff00)
        }),
        case("translucent/over-a-translucent-background", || {
            crossing(HALF_RED, GREEN).background(0x4060_2080)
        }),
    ];
    for alpha in [1, 2, 64, 200, 254] {
        cases.push(case(format!("translucent/opacity-{alpha}"), move || {
            crossing(0xd020_2000 + alpha, 0x2040_d000 + alpha)
        }));
    }
    cases
}

fn crossing(below: u32, above: u32) -> Sketch {
    Sketch::new(64, 64)
        .width(12.0)
        .line((8.0, 14.0), (56.0, 50.0))
        .color(below)
        .line((56.0, 14.0), (8.0, 50.0))
        .color(above)
}
