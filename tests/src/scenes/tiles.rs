//! Scenes of lines at the borders of 16, 32 and 64 pixel tiles, where a method may divide its work.

use super::scene_case::{SceneCase, case};
use crate::sketch::Sketch;

pub(super) fn cases() -> Vec<SceneCase> {
    let mut cases = Vec::new();
    for tile in [16, 32, 64] {
        let at = f64::from(tile);
        cases.push(case(format!("tiles/along-borders-of-{tile}"), move || {
            Sketch::new(136, 136)
                .width(3.0)
                .line((6.0, at), (130.0, at))
                .line((at, 6.0), (at, 130.0))
                .line((6.0, 136.0 - at), (130.0, 136.0 - at))
        }));
        cases.push(case(
            format!("tiles/edge-touches-borders-of-{tile}"),
            move || {
                // Two pixels wide, so that the edge of the stroke is on the border.
                Sketch::new(136, 136)
                    .line((6.0, 136.0 - at + 1.0), (130.0, 136.0 - at + 1.0))
                    .line((at - 1.0, 6.0), (at - 1.0, 130.0))
            },
        ));
        cases.push(case(
            format!("tiles/through-corners-of-{tile}"),
            move || {
                Sketch::new(136, 136)
                    .width(1.0)
                    .line((0.0, 136.0), (136.0, 0.0))
                    .line((at, 136.0), (0.0, 136.0 - at))
                    .line((2.0 * at, 136.0), (0.0, 136.0 - 2.0 * at))
            },
        ));
        cases.push(case(
            format!("tiles/dots-on-corners-of-{tile}"),
            move || {
                (0..9).fold(Sketch::new(136, 136), |sketch, i| {
                    let x = at * f64::from(i % 3);
                    let y = 136.0 - at * f64::from(i / 3);
                    sketch.curve(&[(x, y); 4]).own_width(5.0 + f64::from(i))
                })
            },
        ));
        cases.push(case(
            format!("tiles/ends-on-borders-of-{tile}"),
            move || {
                (0..10).fold(Sketch::new(136, 136), |sketch, i| {
                    let y = 8.0 + 12.7 * f64::from(i);
                    sketch.line((at, y), (if i % 2 == 0 { 2.0 * at } else { 0.0 }, y + 2.0))
                })
            },
        ));
    }
    cases.push(case("tiles/one-path-through-all", || {
        let control: Vec<_> = (0..40)
            .map(|i| {
                let x = if i % 4 < 2 { 4.0 } else { 140.0 };
                (x, 3.5 * f64::from(i))
            })
            .collect();
        Sketch::new(144, 136).curve(&control).width(1.3)
    }));
    cases.push(case("tiles/one-crowded-the-rest-empty", || {
        (0..300).fold(Sketch::new(136, 136).width(1.0), |sketch, i| {
            let (x, y) = (f64::from(i % 17), f64::from(i / 17));
            sketch
                .line(
                    (66.0 + 0.7 * x, 70.0 + 0.7 * y),
                    (68.0 + 0.6 * x, 73.0 + 0.6 * y),
                )
                .color(0x1040_80ff + ((i as u32 * 37 % 200) << 24))
        })
    }));
    cases
}
