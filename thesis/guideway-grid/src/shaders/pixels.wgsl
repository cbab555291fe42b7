// Draws the picture (thesis, 4.3.6): one thread per pixel tests all lines of its cell.

// Side of a tile, the pixels of one workgroup.
override TILE_PX: u32;
// Stops testing a pixel once it is fully covered.
override EARLY_EXIT: bool;
// Counts distance tests and cell look-ups.
override COUNT: bool;

@group(0) @binding(2) var<storage, read> starts: array<u32>;
@group(0) @binding(3) var<storage, read> counts: array<u32>;
@group(0) @binding(4) var<storage, read> lists_m: array<vec4f>;
// Between passes the state of each pixel; after the last pass its color.
@group(0) @binding(5) var<storage, read_write> pixels: array<u32>;
// Distance tests and cell look-ups per pixel.
@group(0) @binding(6) var<storage, read_write> work: array<vec2u>;

@compute @workgroup_size(TILE_PX, TILE_PX)
fn main(
    @builtin(workgroup_id) workgroup: vec3u,
    @builtin(num_workgroups) workgroups: vec3u,
    @builtin(local_invocation_id) thread: vec3u,
) {
    let tile = view.first_tile + workgroup.y * workgroups.x + workgroup.x;
    if tile >= view.end_tile {
        return;
    }
    let tiles_across = (view.width_px + TILE_PX - 1u) / TILE_PX;
    let pixel = vec2u(tile % tiles_across, tile / tiles_across) * TILE_PX + thread.xy;
    if pixel.x >= view.width_px || pixel.y >= view.rows {
        return;
    }
    let index = pixel.y * view.width_px + pixel.x;
    var state = EMPTY;
    if view.is_first_pass == 0u {
        state = pixels[index];
    }
    var tests = 0u;
    var lookups = 0u;

    let center_px = vec2f(f32(pixel.x), f32(view.first_row + pixel.y)) + 0.5;
    let offset_m = (center_px - view.half_size_px) * view.m_per_px;
    let point_m = view.center_m + vec2f(offset_m.x, -offset_m.y);
    if all(point_m >= view.box_low_m) && all(point_m <= view.box_high_m) {
        let low = cell_of(point_m - view.excess_m);
        let high = cell_of(point_m + view.excess_m);
        let end_row = low.y + min(high.y - low.y + 1u, view.end_cell_row);
        for (var y = low.y + view.first_cell_row; y < end_row; y++) {
            for (var x = low.x; x <= high.x; x++) {
                let cell = y * CELLS + x;
                let end = starts[cell] + min(counts[cell], view.end_line);
                lookups += 1u;
                for (var i = starts[cell] + view.first_line; i < end; i++) {
                    if EARLY_EXIT && is_full(state) {
                        break;
                    }
                    state = cover(state, point_m, lists_m[i]);
                    tests += 1u;
                }
            }
        }
    }

    if COUNT {
        let before = select(work[index], vec2u(0u), view.is_first_pass == 1u);
        work[index] = before + vec2u(tests, lookups);
    }
    pixels[index] = state;
    if view.is_last_pass == 1u {
        pixels[index] = blend(coverage(state));
    }
}
