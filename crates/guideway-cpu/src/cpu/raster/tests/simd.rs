//! Pictures of every level of vector instructions.

use std::sync::Arc;

use guideway_scene::{Budget, Style};

use crate::cpu::frame::state::CpuPrepared;
use crate::cpu::ground::simd::SimdLevel;
use crate::cpu::testing::*;

#[test]
fn vector_instructions_change_no_bit() {
    let of_colors = colored(wandering(1000, 30, 2.0, ORIGIN), |i| [255, 255, 200][i % 3]);
    let plain = scene(wandering(1000, 30, 2.0, ORIGIN));
    for (scene, style) in [
        (&of_colors, wide_px(1.5)),
        (&plain, wide_px(2.5)),
        (&plain, Style::default()),
    ] {
        for px_per_m in [0.8, 40.0] {
            let pictures = [SimdLevel::Baseline, SimdLevel::Eight, SimdLevel::Widest].map(|simd| {
                let mut prepared = CpuPrepared::new(Arc::clone(scene), &Budget::default()).unwrap();
                prepared.set_simd(simd);
                draw_with(&mut prepared, &view(ORIGIN, px_per_m), &style).0
            });
            assert!(pictures.iter().all(|picture| *picture == pictures[0]));
        }
    }
}
