// What lies under full tiles.

// Most tiles of a stroke's box that are looked at.
const MOST_LOOKS: u32 = 256u;

fn is_full(tile: u32) -> bool {
    reads(1u);
    return (atomicLoad(&counts[tile]) & FULL) != 0u;
}

// Whether all tiles that a box reaches into are full.
fn is_hidden(box: vec4f, reach_px: f32) -> bool {
    let rows = rows_of(box, reach_px);
    let columns = columns_between(box.x - reach_px, box.z + reach_px);
    if (rows.y - rows.x) * (columns.y - columns.x) > MOST_LOOKS {
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
