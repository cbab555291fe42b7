//! Scenes of many paths by seeded generators: sites, long curves, short paths; also precision and
//! density.

use std::f64::consts::{FRAC_PI_2, TAU};

use guideway_scene::LineRule;
use guideway_scene::density::ToneMap;

use super::scene_case::{SceneCase, case};
use super::shapes::LOOP;
use crate::random::Lcg;
use crate::sketch::Sketch;

const COLORS: [u32; 5] = [
    0x0072_b2ff,
    0xd55e_00ff,
    0x009e_73ff,
    0xcc79_a7ff,
    0x2020_20ff,
];

pub(super) fn cases() -> Vec<SceneCase> {
    let mut cases = vec![
        case("crowds/site-of-1000", || {
            site(Sketch::new(480, 270).width(1.5), 1000, 1)
        }),
        case("crowds/site-by-the-thesis-rule", || {
            site(
                Sketch::new(320, 180).px_per_m(2.0).rule(LineRule::Thesis),
                1500,
                2,
            )
        }),
        case("crowds/site-on-dark", || {
            site(
                Sketch::new(160, 120).width(0.8).background(0x1018_20ff),
                400,
                3,
            )
        }),
        case("crowds/site-wide", || {
            site(Sketch::new(160, 120).width(5.0), 200, 4)
        }),
        case("crowds/site-far-away", || {
            site(Sketch::new(160, 120).px_per_m(20.0).at(7e6, -3e6), 300, 5)
        }),
        case("crowds/long-curves", || {
            long_curves(Sketch::new(160, 120).width(1.0), 60, 6)
        }),
        case("crowds/long-curves-large", || {
            long_curves(Sketch::new(480, 270).width(1.5), 120, 7)
        }),
        case("crowds/long-curves-hairline", || {
            long_curves(Sketch::new(160, 120).width(0.1), 150, 8)
        }),
        case("crowds/short-paths-2000", || {
            short_paths(Sketch::new(160, 120).width(1.0), 2000, 9)
        }),
        case("crowds/short-paths-below-a-pixel", || {
            (0..2000)
                .fold(
                    (Sketch::new(128, 96).width(0.3), Lcg::new(10)),
                    |(sketch, mut lcg), _| {
                        let (x, y) = (lcg.between(0.0, 128.0), lcg.between(0.0, 96.0));
                        let end = (x + lcg.between(-0.4, 0.4), y + lcg.between(-0.4, 0.4));
                        (sketch.line((x, y), end), lcg)
                    },
                )
                .0
        }),
        case("crowds/near-duplicates", || {
            (0..80).fold(Sketch::new(96, 64).width(1.4), |sketch, i| {
                let shift = 0.003 * f64::from(i);
                sketch
                    .curve(&[
                        (-30.0, 10.0 + shift),
                        (20.0, 40.0),
                        (60.0 + shift, 10.0),
                        (130.0, 70.0),
                    ])
                    .color(COLORS[i as usize % 5])
            })
        }),
        case("crowds/translucent-site", || {
            site(Sketch::new(160, 120).width(2.0), 300, 11).common_color(0x2060_a050)
        }),
        case("crowds/run-of-500-segments", || {
            Sketch::new(160, 120).curve(&wandering(503, 12)).width(1.2)
        }),
        case("crowds/run-of-500-segments-in-f32", || {
            Sketch::new(160, 120)
                .curve(&wandering(503, 12))
                .width(1.2)
                .in_f32()
        }),
        case("precision/site-in-f32", || {
            site(Sketch::new(160, 120), 200, 13).in_f32()
        }),
        case("precision/site-in-f64", || {
            site(Sketch::new(160, 120), 200, 13)
        }),
        case("precision/runs-in-f32", || {
            Sketch::new(96, 64)
                .polyline(&[(8.0, 8.0), (50.0, 50.0), (88.0, 12.0)])
                .line((10.0, 40.0), (80.0, 58.0))
                .in_f32()
        }),
        case("density/one-path", || {
            Sketch::new(64, 48)
                .width(5.0)
                .line((8.0, 10.0), (56.0, 38.0))
                .density(ToneMap::Log)
        }),
        case("density/loop-counts-once", || {
            Sketch::new(80, 80)
                .width(8.0)
                .curve(&LOOP)
                .line((10.0, 10.0), (70.0, 70.0))
                .density(ToneMap::Linear)
        }),
        case("density/ends", || {
            // Lines that meet head on, at a corner, and at a fork; a stub shorter than its width; a
            // kink within a path; curved ends; a ring; a long and a short run of a path.
            Sketch::new(128, 96)
                .width(9.0)
                .line((10.0, 80.0), (50.0, 84.5))
                .line((50.0, 84.5), (90.0, 89.0))
                .line((50.0, 84.5), (72.0, 62.0))
                .line((100.0, 60.0), (103.0, 62.0))
                .polyline(&[(110.0, 86.0), (118.0, 60.0), (106.0, 44.0)])
                .curve(&[
                    (-10.0, 20.0),
                    (20.0, 60.0),
                    (50.0, 20.0),
                    (80.0, 60.0),
                    (110.0, 20.0),
                ])
                .polyline(&[(20.0, 10.0), (60.0, 12.0), (40.0, 34.0), (20.0, 10.0)])
                .polyline(&[(6.0, 68.0), (92.0, 68.0), (92.0, 74.0)])
                .density(ToneMap::Linear)
        }),
        case("density/stack-of-50", || {
            (0..50).fold(
                Sketch::new(64, 48).width(6.0).density(ToneMap::Log),
                |sketch, i| sketch.line((8.0, 24.0), (56.0, 6.0 + 0.7 * f64::from(i))),
            )
        }),
        case("density/below-one-path", || {
            long_curves(
                Sketch::new(96, 64).width(0.2).density(ToneMap::Linear),
                8,
                14,
            )
        }),
        case("density/on-a-transparent-background", || {
            long_curves(Sketch::new(96, 64), 20, 15)
                .background(0)
                .density(ToneMap::Log)
        }),
        case("density/short-paths", || {
            short_paths(Sketch::new(96, 64).density(ToneMap::Linear), 1000, 16)
        }),
    ];
    for (name, tone) in [
        ("linear", ToneMap::Linear),
        ("log", ToneMap::Log),
        ("equalized", ToneMap::Equalized),
    ] {
        cases.push(case(format!("density/site-{name}"), move || {
            site(Sketch::new(160, 120).width(1.5), 600, 17).density(tone)
        }));
        cases.push(case(format!("density/long-curves-{name}"), move || {
            long_curves(Sketch::new(160, 120).width(2.0), 100, 18).density(tone)
        }));
    }
    cases
}

/// Straight aisles, crossings and quarter turns, with eight segments per path, as on a real site.
pub fn site(sketch: Sketch, paths: usize, seed: u64) -> Sketch {
    let size = sketch.build().view.size();
    let mut lcg = Lcg::new(seed);
    (0..paths).fold(sketch, |sketch, _| {
        let mut heading = FRAC_PI_2 * lcg.below(4) as f64;
        // Aisle spacing: six pixels.
        let aisle = |position: f64| (position / 6.0).round() * 6.0 + 0.35;
        let mut at = (
            aisle(lcg.between(0.0, f64::from(size.width()))),
            aisle(lcg.between(0.0, f64::from(size.height()))),
        );
        let step = lcg.between(0.6, 2.5);
        let turn = [0.0, 0.0, FRAC_PI_2, -FRAC_PI_2][lcg.below(4)] / 4.0;
        let control: Vec<_> = (0..11)
            .map(|i| {
                let here = at;
                heading += if (3..7).contains(&i) { turn } else { 0.0 };
                at = (at.0 + step * heading.cos(), at.1 + step * heading.sin());
                here
            })
            .collect();
        sketch
            .curve(&control)
            .color(COLORS[lcg.below(COLORS.len())])
    })
}

/// Overlapping curves of eight segments across the picture.
pub fn long_curves(sketch: Sketch, paths: usize, seed: u64) -> Sketch {
    let size = sketch.build().view.size();
    let (width, height) = (f64::from(size.width()), f64::from(size.height()));
    let mut lcg = Lcg::new(seed);
    (0..paths).fold(sketch, |sketch, _| {
        let control: Vec<_> = (0..11)
            .map(|_| {
                (
                    lcg.between(-0.1, 1.1) * width,
                    lcg.between(-0.1, 1.1) * height,
                )
            })
            .collect();
        sketch
            .curve(&control)
            .color(COLORS[lcg.below(COLORS.len())])
    })
}

/// Curves of one segment, a few pixels long.
pub fn short_paths(sketch: Sketch, paths: usize, seed: u64) -> Sketch {
    let size = sketch.build().view.size();
    let (width, height) = (f64::from(size.width()), f64::from(size.height()));
    let mut lcg = Lcg::new(seed);
    (0..paths).fold(sketch, |sketch, _| {
        let (x, y) = (
            lcg.between(-4.0, width + 4.0),
            lcg.between(-4.0, height + 4.0),
        );
        let control = [0; 4].map(|_| (x + lcg.between(-8.0, 8.0), y + lcg.between(-8.0, 8.0)));
        sketch
            .curve(&control)
            .color(COLORS[lcg.below(COLORS.len())])
    })
}

/// Control points of a random walk with small turns.
fn wandering(points: usize, seed: u64) -> Vec<(f64, f64)> {
    let mut lcg = Lcg::new(seed);
    let (mut x, mut y, mut heading) = (80.0, 60.0, 0.0);
    (0..points)
        .map(|_| {
            // A pull toward the center that grows with the distance.
            let home = f64::atan2(60.0 - y, 80.0 - x);
            let pull = f64::hypot((x - 80.0) / 70.0, (y - 60.0) / 50.0)
                .powi(4)
                .min(1.0);
            let off = (home - heading + TAU / 2.0).rem_euclid(TAU) - TAU / 2.0;
            heading += lcg.between(-0.6, 0.6) + 0.5 * pull * off;
            (x, y) = (x + 4.0 * heading.cos(), y + 4.0 * heading.sin());
            (x, y)
        })
        .collect()
}
