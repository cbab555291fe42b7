// One pixel of the picture: its parameters, its walk over the structure, and its color.

// Side of a tile, the pixels of one workgroup.
override TILE_PX: u32;
// Counts distance tests and bytes read.
override COUNT: bool;

const DONE: u32 = 0xffffffffu;

struct View {
    // Center of the picture, in meters from the local origin.
    center_m: vec2f,
    half_size_px: vec2f,
    // Lower left corner and side of the quadtree's root.
    origin_m: vec2f,
    side_m: f32,
    // Distance from a pixel's center to the farthest line that changes it.
    reach_m: f32,
    m_per_px: f32,
    px_per_m: f32,
    radius_m: f32,
    // Colors in the byte order of a picture: red first.
    color: u32,
    background: u32,
    // The band of pixel rows.
    width_px: u32,
    first_row: u32,
    rows: u32,
    // Range of the band's tiles, row by row.
    first_tile: u32,
    end_tile: u32,
    leaves: u32,
    // Loop iterations after which a walk stops, to be resumed by the next dispatch.
    limit: u32,
    max_level: u32,
    is_first_chunk: u32,
    is_last_chunk: u32,
    // The walks of this chunk begin.
    is_start: u32,
}

@group(0) @binding(0) var<uniform> view: View;
// Per pixel: two words at which its walk resumes, then distance tests and bytes read so far.
@group(0) @binding(7) var<storage, read_write> progress: array<vec4u>;
// Is not 0 when a walk has to be resumed; then the segments per level of the quadtree.
@group(0) @binding(8) var<storage, read_write> counters: array<atomic<u32>>;

fn pixel_of(tile: u32, thread: vec2u) -> Pixel {
    let tiles_across = (view.width_px + TILE_PX - 1u) / TILE_PX;
    let at = vec2u(tile % tiles_across, tile / tiles_across) * TILE_PX + thread;
    var pixel: Pixel;
    pixel.point_m = point_of(at);
    pixel.is_inside = at.x < view.width_px && at.y < view.rows;
    pixel.index = at.y * view.width_px + at.x;
    pixel.thread = thread.y * TILE_PX + thread.x;
    pixel.covered_segments = 0u;
    pixel.floor = 0u;
    pixel.tests = 0u;
    pixel.bytes = 0u;
    return pixel;
}

fn point_of(at: vec2u) -> vec2f {
    let center_px = vec2f(f32(at.x), f32(view.first_row + at.y)) + 0.5;
    let offset_m = (center_px - view.half_size_px) * view.m_per_px;
    return view.center_m + vec2f(offset_m.x, -offset_m.y);
}

// Walks on from the place in `progress[first]`; the lines that matter lie in the box of the window.
fn draw(pixel: ptr<function, Pixel>, first: u32, low_m: vec2f, high_m: vec2f) {
    var resume = vec2u(0u);
    if view.is_start == 0u {
        resume = progress[first].xy;
    }
    if resume.x == DONE {
        return;
    }
    if (*pixel).is_inside {
        load(pixel, view.is_first_chunk == 1u && view.is_start == 1u);
    }
    // Lines outside the window may be tested too, so it may be larger than needed.
    let margin_m = 1e-3 * view.reach_m;
    resume = walk(pixel, low_m - view.reach_m - margin_m, high_m + view.reach_m + margin_m, resume);
    synchronize();
    if !(*pixel).is_inside {
        return;
    }
    let index = (*pixel).index;
    var work = vec2u(0u);
    if COUNT {
        if view.is_first_chunk == 0u || view.is_start == 0u {
            work = progress[index].zw;
        }
        work += vec2u((*pixel).tests, (*pixel).bytes);
    }
    progress[index] = vec4u(resume, work);
    if resume.x != DONE {
        atomicStore(&counters[0], 1u);
    }
    if resume.x == DONE && view.is_last_chunk == 1u {
        pixels[index] = color_of(pixel);
    } else {
        save(pixel);
    }
}
