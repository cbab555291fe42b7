//! Scenes of odd picture sizes, backgrounds, empty views, levels and refused paths.

use super::scene_case::{SceneCase, case};
use crate::sketch::Sketch;

pub(super) fn cases() -> Vec<SceneCase> {
    let mut cases = Vec::new();
    for (width, height) in [
        (1, 1),
        (1, 96),
        (96, 1),
        (3, 257),
        (257, 3),
        (2, 2),
        (15, 17),
        (33, 31),
        (65, 63),
        (127, 129),
    ] {
        cases.push(case(format!("sizes/{width}x{height}"), move || {
            diagonals(width, height)
        }));
    }
    for (name, rgba) in [
        ("dark", 0x1018_20ff),
        ("bright", 0xffe0_40ff),
        ("transparent", 0x0000_0000),
        ("transparent-white", 0xffff_ff00),
        ("translucent", 0x2080_4060),
    ] {
        cases.push(case(format!("background/{name}"), move || {
            diagonals(64, 48).common_color(0xc040_10ff).background(rgba)
        }));
    }
    cases.extend([
        case("nothing/empty-layout", || Sketch::new(64, 48)),
        case("nothing/empty-layout-of-density", || {
            Sketch::new(64, 48).density(guideway_scene::density::ToneMap::Log)
        }),
        case("nothing/everything-outside", || {
            Sketch::new(64, 48)
                .line((-40.0, -40.0), (-4.0, -4.0))
                .line((70.0, 10.0), (80.0, 40.0))
                .line((10.0, 51.0), (60.0, 53.0))
        }),
        case("nothing/around-the-view", || {
            // The box intersects the view, but the path does not.
            Sketch::new(64, 48).polyline(&[(-30.0, 24.0), (32.0, 110.0), (100.0, 24.0)])
        }),
        case("nothing/outside-by-a-hair", || {
            Sketch::new(64, 48)
                .line((10.0, -1.01), (54.0, -1.01))
                .line((65.01, 4.0), (65.01, 44.0))
        }),
        case("nothing/path-without-runs", || {
            Sketch::new(64, 48).runs(&[]).line((8.0, 8.0), (56.0, 40.0))
        }),
        case("edges/inside-by-a-hair", || {
            Sketch::new(64, 48)
                .line((10.0, -0.6), (54.0, -0.6))
                .line((64.6, 4.0), (64.6, 44.0))
        }),
        case("edges/along-all-four", || {
            Sketch::new(64, 48).width(3.0).polyline(&[
                (0.0, 0.0),
                (64.0, 0.0),
                (64.0, 48.0),
                (0.0, 48.0),
                (0.0, 0.0),
            ])
        }),
        case("edges/half-outside", || {
            Sketch::new(64, 48)
                .line((-20.0, 10.0), (30.0, 20.0))
                .line((40.0, 20.0), (90.0, 60.0))
                .line((20.0, 40.0), (26.0, 90.0))
        }),
        case("edges/leaves-and-comes-back", || {
            Sketch::new(64, 48)
                .curve(&[
                    (0.0, -50.0),
                    (8.0, 30.0),
                    (30.0, 90.0),
                    (52.0, 30.0),
                    (60.0, -50.0),
                ])
                .width(3.0)
        }),
        case("levels/one-of-two", || two_levels().only_level("upper")),
        case("levels/all", two_levels),
        case("levels/none-on-it", || {
            Sketch::new(64, 48)
                .line((8.0, 8.0), (56.0, 40.0))
                .level(0)
                .only_level("upper")
        }),
        case("refused/beside-drawn-ones", || diagonals(64, 48).refused(3)),
        case("refused/all-of-them", || Sketch::new(64, 48).refused(2)),
    ]);
    cases
}

fn two_levels() -> Sketch {
    Sketch::new(64, 48)
        .width(5.0)
        .line((8.0, 8.0), (56.0, 40.0))
        .color(0x2040_d0ff)
        .level(0)
        .line((8.0, 40.0), (56.0, 8.0))
        .color(0xd020_20ff)
        .level(1)
        .line((8.0, 24.0), (56.0, 24.0))
}

fn diagonals(width: u32, height: u32) -> Sketch {
    let (right, top) = (f64::from(width), f64::from(height));
    Sketch::new(width, height)
        .width(1.7)
        .line((0.0, 0.2), (right, top - 0.3))
        .curve(&[
            (-right, top),
            (0.2 * right, 0.8 * top),
            (0.7 * right, 0.3 * top),
            (2.0 * right, 0.0),
        ])
}
