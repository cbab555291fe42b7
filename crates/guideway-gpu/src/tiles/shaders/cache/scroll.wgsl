// Scrolls a picture by whole pixels.
//
// Bindings: scroll, old_pixels -> pixels. One thread per pixel.

override THREADS: u32;

struct Scroll {
    width_px: u32,
    height_px: u32,
    // Offset from a pixel of the new picture to the same place in the old one.
    right_px: i32,
    down_px: i32,
}

@group(0) @binding(0) var<uniform> scroll: Scroll;
@group(0) @binding(1) var<storage, read> old_pixels: array<u32>;
@group(0) @binding(2) var<storage, read_write> pixels: array<u32>;

@compute @workgroup_size(THREADS)
fn main(
    @builtin(workgroup_id) id: vec3u,
    @builtin(num_workgroups) count: vec3u,
    @builtin(local_invocation_index) thread: u32,
) {
    let index = (id.y * count.x + id.x) * THREADS + thread;
    if index >= scroll.width_px * scroll.height_px {
        return;
    }
    let x = i32(index % scroll.width_px) + scroll.right_px;
    let y = i32(index / scroll.width_px) + scroll.down_px;
    if x >= 0 && x < i32(scroll.width_px) && y >= 0 && y < i32(scroll.height_px) {
        pixels[index] = old_pixels[u32(y) * scroll.width_px + u32(x)];
    }
}
