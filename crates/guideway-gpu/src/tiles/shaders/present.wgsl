// Writes pixels of a picture to a texture, with premultiplied alpha.
//
// Bindings: part, pixels -> picture. One thread per pixel.

override THREADS: u32;

struct Part {
    width_px: u32,
    // Index in the picture of the first pixel of the buffer, and the number of pixels.
    first_pixel: u32,
    pixels: u32,
    unused: u32,
}

@group(0) @binding(0) var<uniform> part: Part;
@group(0) @binding(1) var<storage, read> pixels: array<u32>;
@group(0) @binding(2) var picture: texture_storage_2d<rgba8unorm, write>;

// Rounds color * alpha / 255 to the nearest integer.
fn premultiplied(color: u32, alpha: u32) -> u32 {
    return (color * alpha + 127u) / 255u;
}

@compute @workgroup_size(THREADS)
fn main(
    @builtin(workgroup_id) id: vec3u,
    @builtin(num_workgroups) count: vec3u,
    @builtin(local_invocation_index) thread: u32,
) {
    let index = (id.y * count.x + id.x) * THREADS + thread;
    if index >= part.pixels {
        return;
    }
    let pixel = pixels[index];
    let alpha = pixel >> 24u;
    let color = vec4u(
        premultiplied(pixel & 255u, alpha),
        premultiplied((pixel >> 8u) & 255u, alpha),
        premultiplied((pixel >> 16u) & 255u, alpha),
        alpha,
    );
    let place = part.first_pixel + index;
    let at = vec2u(place % part.width_px, place / part.width_px);
    textureStore(picture, at, vec4f(color) / 255.0);
}
