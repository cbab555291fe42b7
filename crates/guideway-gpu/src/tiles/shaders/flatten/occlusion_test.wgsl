// Tests whether full tiles hide a stroke.

// import: flatten/bindings.wgsl
// import: shared/tile_range.wgsl

// Most tiles of a stroke's box to test.
const MAX_TESTED_TILES: u32 = 256u;

fn is_full(tile: u32) -> bool {
    count_reads(1u);
    return (atomicLoad(&tile_counts[tile]) & FULL) != 0u;
}

// Returns whether all tiles that a box grown by `reach_px` touches are full.
fn is_occluded(box: vec4f, reach_px: f32) -> bool {
    let rows = tile_rows(box, reach_px);
    let columns = clamp_columns(box.x - reach_px, box.z + reach_px);
    if (rows.y - rows.x) * (columns.y - columns.x) > MAX_TESTED_TILES {
        return false;
    }
    for (var row = rows.x; row < rows.y; row++) {
        for (var column = columns.x; column < columns.y; column++) {
            if !is_full(tile_index(row, column)) {
                return false;
            }
        }
    }
    return true;
}
