//! Compares every shader with the Rust side: bindings, structures and constants.

use std::path::Path;

use super::constants::*;
use super::layouts::*;
use super::shaders::{self, SortedLists, Team};
use crate::device::Source;
use crate::testing::reflection::{assert_bindings, assert_layout, members};

/// Every variant of every entry point.
pub(super) fn sources() -> Vec<Source> {
    let mut sources = vec![
        shaders::CULL.source(),
        shaders::flatten(PointFormat::Rounded),
        shaders::flatten(PointFormat::Exact),
        shaders::INVALIDATE_LINES.source(),
        shaders::COUNT_CACHED.source(),
        shaders::BIN_CACHED.source(),
        shaders::SCROLL.source(),
        shaders::PRESENT.source(),
        shaders::TILE_OFFSETS.source(),
        shaders::SPLIT_TILES.source(),
        shaders::BIN_LINES.source(),
        shaders::sort_lists(SortedLists::Short),
        shaders::sort_lists(SortedLists::Long),
    ];
    for samples in [Samples::Coarse, Samples::Fine] {
        for team in [Team::Subgroup, Team::Workgroup] {
            sources.push(shaders::cover_tiles(samples, team));
            sources.push(shaders::cover_split_tiles(samples, team));
            sources.push(shaders::opaque(samples, team));
        }
        sources.push(shaders::layers(samples));
    }
    sources
}

#[test]
#[ignore = "writes files for web/tests/shaders.mjs"]
fn write_every_shader() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../target/web/shaders");
    std::fs::create_dir_all(&folder).unwrap();
    for (index, source) in sources().iter().enumerate() {
        let name = format!("{index:02} {}.wgsl", source.name);
        std::fs::write(folder.join(name), &*source.wgsl).unwrap();
    }
}

#[test]
fn every_shader_has_the_bindings_of_its_source() {
    for source in &sources() {
        assert_bindings(source);
    }
}

#[test]
fn every_shader_file_has_a_header_and_at_most_one_entry_point() {
    let entries = shaders::FILES.iter().filter(|(file, text)| {
        assert!(text.starts_with("// "), "{file}");
        assert!(text.lines().count() <= 200, "{file}");
        let count = text.matches("@compute").count();
        assert!(count <= 1, "{file}");
        count == 1
    });
    let mut entries: Vec<_> = entries.map(|(file, _)| *file).collect();
    let mut listed = shaders::ENTRIES.to_vec();
    entries.sort_unstable();
    listed.sort_unstable();
    assert_eq!(entries, listed);
}

#[test]
fn structures_have_the_same_layout() {
    let sources = sources();
    let sources: Vec<_> = sources.iter().collect();
    let frame = members!(FrameParams: center_high_m, center_low_m, lod_reach_px,
        flatten_low_px, flatten_high_px, window_low_px, window_high_px, lod_origin_px, map_x,
        map_y, lod_px_per_m, lod_px_per_px, px_per_lod_px, px_per_m, radius_px, min_radius_px,
        max_radius_px, tolerance_px, clusters, styles, width_px, height_px, first_column,
        columns, first_row, rows, first_pixel_row, line_capacity, reference_capacity, color,
        background, max_step_m, has_ranks, first_line, caches_lines, dirty_clusters,
        cached_lines, threads_per_line, list_capacity, steps_per_px, px_per_step);
    assert_layout(&sources, "Frame", &frame);
    let dispatch = members!(FlattenDispatch: first_cluster, end_cluster, occlusion_pass, is_near);
    assert_layout(&sources, "FlattenDispatch", &dispatch);
    let cluster = members!(Cluster: origin_high_m, origin_low_m, low_m, high_m, widest_m, step_m,
        first_point, points, first_stroke, strokes, stored_step_m, is_mapped);
    assert_layout(&sources, "Cluster", &cluster);
    let scroll = members!(ScrollParams: width_px, height_px, right_px, down_px);
    assert_layout(&sources, "Scroll", &scroll);
    let part = members!(PresentParams: width_px, first_pixel, pixels, unused);
    assert_layout(&sources, "Part", &part);
    assert_layout(&sources, "Stroke", &members!(Stroke: extent, rank));
    assert_layout(&sources, "Style", &members!(PathStyle: color, width_m));
    let counters = members!(FrameCounters: rounded_clusters, exact_clusters, lines, references,
        drawn_paths, longest_list, full_tiles, max_loops, missing_clusters, split_tiles,
        split_parts, longest_unsplit, work);
    assert_layout(&sources, "Counters", &counters);
    assert_layout(
        &sources,
        "ClusterSlot",
        &members!(ClusterSlot: visible, block),
    );
}

#[test]
#[should_panic(expected = "Stroke of flatten")]
fn rejects_a_different_layout() {
    let stroke = members!(Stroke: extent);
    assert_layout(&[&shaders::flatten(PointFormat::Exact)], "Stroke", &stroke);
}

#[test]
fn each_four_sample_rows_have_every_first_column() {
    for group in 0..4 {
        let mut columns: Vec<_> = (4 * group..4 * group + 4)
            .map(|row| FIRST_COLUMNS >> (2 * row) & 3)
            .collect();
        columns.sort_unstable();
        assert_eq!(columns, [0, 1, 2, 3]);
    }
}

#[track_caller]
fn assert_constant(source: &Source, name: &str, value: u32) {
    let expected = format!("const {name}: u32 = {value}u;");
    assert!(source.wgsl.contains(&expected), "{expected}");
}

#[test]
fn shaders_declare_the_constants_of_this_side() {
    let team = Team::Subgroup;
    for samples in [Samples::Coarse, Samples::Fine] {
        for source in [
            shaders::cover_tiles(samples, team),
            shaders::opaque(samples, team),
            shaders::layers(samples),
        ] {
            assert_constant(&source, "SAMPLES_PER_ROW", samples.per_row());
        }
        assert_constant(
            &shaders::opaque(samples, team),
            "TILE_THREADS",
            TILE_THREADS,
        );
    }
    assert_constant(
        &shaders::BIN_LINES.source(),
        "LINE_WORDS",
        LINE_WORDS as u32,
    );
    assert_constant(
        &shaders::SPLIT_TILES.source(),
        "MAX_SPLIT_TILES",
        MAX_SPLIT_TILES,
    );
    assert_constant(
        &shaders::SPLIT_TILES.source(),
        "MAX_SPLIT_PARTS",
        MAX_SPLIT_PARTS,
    );
    for format in [PointFormat::Rounded, PointFormat::Exact] {
        let source = shaders::flatten(format);
        for (name, flag) in [
            ("WHOLE_PATH", WHOLE_PATH),
            ("HIDDEN_STROKE", HIDDEN_STROKE),
            ("PATH_START", PATH_START),
            ("PATH_END", PATH_END),
        ] {
            let expected = format!("const {name}: u32 = {flag:#010x}u;");
            assert!(source.wgsl.contains(&expected), "{expected}");
        }
        let expected = format!("const MAX_SEGMENTS: u32 = {MAX_SEGMENTS:#x}u;");
        assert!(source.wgsl.contains(&expected), "{expected}");
    }
    let cluster_words = size_of::<Cluster>() / size_of::<u32>();
    assert_constant(
        &shaders::CULL.source(),
        "CLUSTER_WORDS",
        cluster_words as u32,
    );
}
