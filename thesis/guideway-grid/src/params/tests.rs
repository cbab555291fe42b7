//! Compares the reflection of every shader with the Rust constants.

use naga::TypeInner;

use super::*;
use guideway_gpu::testing::reflection::{assert_bindings, assert_layout, members, parse};

const SHADERS: &[&Source] = &[
    &SAMPLE,
    &COUNT,
    &PREFIX_NAIVE,
    &SCAN_BLOCKS,
    &SCAN_SUMS,
    &ADD_SUMS,
    &BIN,
    &PIXELS_NEAREST,
    &PIXELS_SAMPLES,
];

#[test]
fn every_shader_has_the_bindings_of_its_source() {
    for source in SHADERS {
        assert_bindings(source);
    }
}

#[test]
fn uniforms_have_the_same_layout_in_rust_and_wgsl() {
    let items = members!(Items: first, end, first_part, end_part);
    assert_layout(SHADERS, "Items", &items);
    let grid = members!(GridParams: origin_m, cells_per_m, reach_m);
    assert_layout(SHADERS, "Grid", &grid);
    let view = members!(ViewParams: center_m, half_size_px, box_low_m, box_high_m, excess_m,
        m_per_px, px_per_m, radius_m, color, background, width_px, first_row, rows,
        first_tile, end_tile, first_cell_row, end_cell_row, first_line, end_line,
        is_first_pass, is_last_pass);
    assert_layout(SHADERS, "View", &view);
}

#[test]
fn lines_have_the_stride_of_line_bytes() {
    for source in [&SAMPLE, &COUNT, &BIN] {
        let module = parse(source);
        let lines = module
            .global_variables
            .iter()
            .find(|(_, v)| v.name.as_deref() == Some("lines_m"));
        let (_, lines) = lines.expect("lines");
        let TypeInner::Array { stride, .. } = module.types[lines.ty].inner else {
            panic!("lines are an array");
        };
        assert_eq!(u64::from(stride), LINE_BYTES);
    }
}
