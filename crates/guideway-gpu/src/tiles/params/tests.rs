//! Every shader against what this side takes it for.

use super::*;
use crate::device::Source;
use crate::testing::reflection::{assert_binds_what_it_is_given, assert_laid_out, members};
use crate::tiles::shaders::*;

const SHADERS: &[&Source] = &[
    &CULL,
    &STRIKE,
    &FLATTEN[0],
    &FLATTEN[1],
    &FLATTEN_IN_STEP[0],
    &FLATTEN_IN_STEP[1],
    &SHIFT,
    &RECOUNT,
    &LIST_KEPT,
    &STARTS,
    &SHARE,
    &SCATTER,
    &COVERS.alone[0],
    &COVERS.alone[1],
    &COVERS.shared[0],
    &COVERS.shared[1],
    &COVERS_APART.alone[0],
    &COVERS_APART.alone[1],
    &COVERS_APART.shared[0],
    &COVERS_APART.shared[1],
    &COVERS_IN_STEP[0],
    &COVERS_IN_STEP[1],
    &SORT[0],
    &SORT[1],
    &OPAQUE[0],
    &OPAQUE[1],
    &OPAQUE_TEAMS,
    &LAYERS[0],
    &LAYERS[1],
];

#[test]
fn every_shader_binds_what_it_is_given() {
    for source in SHADERS {
        assert_binds_what_it_is_given(source);
    }
}

#[test]
fn structures_are_laid_out_alike() {
    let frame = members!(FrameParams: center_high_m, center_low_m, reach_px, made_low_px, made_high_px,
        drawn_low_px, drawn_high_px, line_origin_px, level_px_per_m, level_px_a_px, px_a_level_px, px_per_m, radius_px, least_radius_px, most_radius_px, tolerance_px, clusters, styles, width_px, height_px, first_column,
        columns, first_row, rows, pixels_row, line_room, reference_room, color, background, most_step_m,
        has_ranks, first_line, keeps_lines, touched, kept_lines, threads_a_line, list_room, steps_a_px, px_a_step);
    assert_laid_out(SHADERS, "Frame", &frame);
    assert_laid_out(
        SHADERS,
        "Chunk",
        &members!(ChunkParams: first_cluster, end_cluster, round, is_near),
    );
    let cluster = members!(Cluster: origin_high_m, origin_low_m, low_m, high_m, widest_m, step_m, first_point,
        points, first_stroke, strokes);
    assert_laid_out(SHADERS, "Cluster", &cluster);
    let shift = members!(ShiftParams: width_px, height_px, right_px, down_px);
    assert_laid_out(SHADERS, "Shift", &shift);
    assert_laid_out(SHADERS, "Stroke", &members!(Stroke: extent, rank));
    assert_laid_out(SHADERS, "Style", &members!(PathStyle: color, width_m));
    let found = members!(Found: rounded, exact, lines, references, drawn, longest, full_tiles, rounds, missing,
        shared_tiles, parts, longest_alone, work);
    assert_laid_out(SHADERS, "Counters", &found);
    assert_laid_out(SHADERS, "Place", &members!(Place: seen, block));
}

#[test]
#[should_panic(expected = "Stroke of flatten")]
fn another_layout_is_noticed() {
    let stroke = members!(Stroke: extent);
    assert_laid_out(SHADERS, "Stroke", &stroke);
}

#[test]
fn each_four_rows_of_samples_have_every_column_once() {
    for group in 0..4 {
        let mut columns: Vec<_> = (4 * group..4 * group + 4)
            .map(|row| COLUMNS >> (2 * row) & 3)
            .collect();
        columns.sort_unstable();
        assert_eq!(columns, [0, 1, 2, 3]);
    }
}

#[test]
fn rows_of_a_pixel_have_as_many_samples_as_is_said() {
    for samples in [Samples::Coarse, Samples::Fine] {
        let said = format!("const SAMPLES_A_ROW: u32 = {}u;", samples.a_row());
        for sources in [
            &COVERS.alone,
            &COVERS.shared,
            &COVERS_APART.alone,
            &COVERS_APART.shared,
            &COVERS_IN_STEP,
            &OPAQUE,
            &LAYERS,
        ] {
            assert!(sources[samples as usize].wgsl.starts_with(&said), "{said}");
        }
    }
    let said = format!("const SAMPLES_A_ROW: u32 = {}u;", Samples::Coarse.a_row());
    assert!(OPAQUE_TEAMS.wgsl.starts_with(&said), "{said}");
}

#[test]
fn lines_have_as_many_words_as_there_is_room_for() {
    let said = format!("const LINE_WORDS: u32 = {LINE_WORDS}u;");
    assert!(SCATTER.wgsl.contains(&said), "{said}");
}

#[test]
fn opaque_tiles_have_as_many_threads_as_is_said() {
    let said = format!("const TILE_THREADS: u32 = {TILE_THREADS}u;");
    for source in [&OPAQUE[0], &OPAQUE_TEAMS] {
        assert!(source.wgsl.contains(&said), "{said}");
    }
}

#[test]
fn as_many_threads_are_in_step_as_is_said() {
    let blocks = TILE_PX * SAMPLE_ROWS / PROCESSOR_LANES;
    let said_lanes = format!("const LANES: u32 = {PROCESSOR_LANES}u;");
    for said in [
        said_lanes.clone(),
        format!("const BLOCKS: u32 = {blocks}u;"),
        format!("const BLOCKS_A_PIXEL: u32 = {}u;", blocks / TILE_PX),
    ] {
        assert!(COVERS_IN_STEP[0].wgsl.contains(&said), "{said}");
    }
    let parts = CLUSTER_STROKES / PROCESSOR_LANES;
    for said in [
        said_lanes,
        format!("const PARTS_BITS: u32 = {}u;", parts.ilog2()),
        format!("const MOST_PIECES: u32 = {STROKE_SEGMENTS}u;"),
    ] {
        assert!(FLATTEN_IN_STEP[0].wgsl.contains(&said), "{said}");
    }
}

#[test]
fn as_many_tiles_may_be_shared_as_there_is_room_for() {
    for said in [
        format!("const SHARED_TILES: u32 = {SHARED_TILES}u;"),
        format!("const SHARED_PARTS: u32 = {SHARED_PARTS}u;"),
    ] {
        assert!(SHARE.wgsl.contains(&said), "{said}");
    }
}

#[test]
fn clusters_have_as_many_words_as_is_counted() {
    let words = size_of::<Cluster>() / size_of::<u32>();
    let said = format!("const CLUSTER_WORDS: u32 = {words}u;");
    assert!(CULL.wgsl.contains(&said), "{said}");
}
