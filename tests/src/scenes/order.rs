//! Scenes of draw order and colors: file order, ranks, overlapping paths.

use super::scene_case::{SceneCase, case};
use crate::sketch::Sketch;

const RED: u32 = 0xd020_20ff;
const GREEN: u32 = 0x20a0_30ff;
const BLUE: u32 = 0x2040_d0ff;

pub(super) fn cases() -> Vec<SceneCase> {
    vec![
        case("order/of-the-file", crossing),
        case("order/ranks-turn-it-round", || crossing_ranked([2, 1, 0])),
        case("order/ranks-below-zero", || {
            crossing_ranked([0, -5, i32::MIN])
        }),
        case("order/ties-in-file-order", || crossing_ranked([7, 7, 7])),
        case("order/one-rank-above-ties", || crossing_ranked([9, 3, 3])),
        case("order/largest-ranks", || {
            crossing_ranked([i32::MAX, i32::MAX - 1, i32::MIN])
        }),
        case("order/interleaved", || {
            (0..12).fold(Sketch::new(96, 96).width(5.0), |sketch, i| {
                let at = 8.0 + 14.0 * f64::from(i / 2);
                let (sketch, rank) = if i % 2 == 0 {
                    (sketch.line((4.0, at), (92.0, at)).color(RED), i * 5 % 7)
                } else {
                    (sketch.line((at, 4.0), (at, 92.0)).color(BLUE), i * 3 % 7)
                };
                sketch.rank(rank)
            })
        }),
        case("order/thousand-layers", || thousand(|_| 0)),
        case("order/thousand-layers-by-rank", || {
            thousand(|i| i * 389 % 1000)
        }),
        case("order/the-same-path-many-times", || {
            (0..100).fold(Sketch::new(64, 48), |sketch, i| {
                let color = if i == 99 { GREEN } else { RED };
                sketch.line((8.0, 10.3), (56.0, 38.6)).color(color)
            })
        }),
        case("order/one-edge-shared", || {
            Sketch::new(64, 48)
                .width(8.0)
                .line((8.0, 20.3), (56.0, 20.3))
                .color(RED)
                .line((8.0, 28.3), (56.0, 28.3))
                .color(BLUE)
        }),
        case("order/wide-below-narrow", || {
            Sketch::new(64, 48)
                .line((10.0, 12.0), (54.0, 36.0))
                .own_width(16.0)
                .color(GREEN)
                .line((10.0, 12.0), (54.0, 36.0))
                .own_width(5.0)
                .color(RED)
        }),
        case("order/wide-over-narrow", || {
            Sketch::new(64, 48)
                .line((10.0, 12.0), (54.0, 36.0))
                .own_width(5.0)
                .color(RED)
                .line((10.0, 12.0), (54.0, 36.0))
                .own_width(16.0)
                .color(GREEN)
        }),
        case("colors/common", || slanted_pair().common_color(BLUE)),
        case("colors/own-and-common", || {
            slanted_pair().color(RED).common_color(GREEN)
        }),
        case("colors/of-each", || {
            (0..32).fold(Sketch::new(128, 64).width(3.0), |sketch, i| {
                let x = 2.0 + 4.0 * f64::from(i);
                let color = (i as u32).wrapping_mul(0x9e37_79b9) | 0xff;
                sketch.line((x, 4.0), (x, 60.0)).color(color)
            })
        }),
        case("colors/extremes", || {
            [
                0x0000_00ff,
                0xffff_ffff,
                0xff00_00ff,
                0x00ff_00ff,
                0x0000_ffff,
                0x0101_01ff,
            ]
            .into_iter()
            .enumerate()
            .fold(
                Sketch::new(96, 48).background(0x8080_80ff).width(9.0),
                |sketch, (i, c)| {
                    let x = 10.5 + 15.0 * i as f64;
                    sketch.line((x, 8.0), (x, 40.0)).color(c)
                },
            )
        }),
        case("colors/white-on-black", || {
            slanted_pair()
                .common_color(0xffff_ffff)
                .background(0x0000_00ff)
        }),
        case("colors/as-the-background", || {
            slanted_pair().common_color(0xffff_ffff)
        }),
    ]
}

fn slanted_pair() -> Sketch {
    Sketch::new(64, 48)
        .width(4.0)
        .line((8.0, 8.0), (56.0, 30.0))
        .line((8.0, 34.0), (56.0, 40.0))
}

fn crossing() -> Sketch {
    Sketch::new(64, 64)
        .width(9.0)
        .line((8.0, 32.0), (56.0, 32.0))
        .color(RED)
        .line((14.0, 10.0), (50.0, 54.0))
        .color(GREEN)
        .line((50.0, 10.0), (14.0, 54.0))
        .color(BLUE)
}

fn crossing_ranked([red, green, blue]: [i32; 3]) -> Sketch {
    Sketch::new(64, 64)
        .width(9.0)
        .line((8.0, 32.0), (56.0, 32.0))
        .color(RED)
        .rank(red)
        .line((14.0, 10.0), (50.0, 54.0))
        .color(GREEN)
        .rank(green)
        .line((50.0, 10.0), (14.0, 54.0))
        .color(BLUE)
        .rank(blue)
}

/// A thousand lines, each shifted to the right of the one before, so that a sliver of each stays
/// visible.
fn thousand(rank: fn(i32) -> i32) -> Sketch {
    (0..1000).fold(Sketch::new(128, 48).width(6.0), |sketch, i| {
        let x = 6.0 + 0.115 * f64::from(i);
        let color = (i as u32).wrapping_mul(0x9e37_79b9) | 0xff;
        sketch.line((x, 8.0), (x, 40.0)).color(color).rank(rank(i))
    })
}
