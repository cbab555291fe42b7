//! Pictures by vectors of any width.

use super::*;
use crate::cpu::vectors::LaneWidth;

#[test]
fn vector_instructions_do_not_show() {
    let scene = colored(wandering(1000, 30, 2.0, ORIGIN), |i| [255, 255, 200][i % 3]);
    let plain = self::scene(wandering(1000, 30, 2.0, ORIGIN));
    for (scene, style) in [
        (&scene, wide_px(1.5)),
        (&plain, wide_px(2.5)),
        (&plain, Style::default()),
    ] {
        for px_per_m in [0.8, 40.0] {
            let pictures =
                [LaneWidth::Baseline, LaneWidth::Eight, LaneWidth::Widest].map(|lane_width| {
                    let mut prepared =
                        CpuPrepared::new(Arc::clone(scene), &Budget::default()).unwrap();
                    prepared.lane_width = lane_width;
                    draw_with(&mut prepared, &view(ORIGIN, px_per_m), &style).0
                });
            assert!(pictures.iter().all(|picture| *picture == pictures[0]));
        }
    }
}
