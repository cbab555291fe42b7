// Blends 8-bit RGBA colors (red in the lowest byte, straight alpha).

// import: shared/frame.wgsl

fn channels(color: u32) -> vec4f {
    return vec4f(
        f32(color & 255u),
        f32((color >> 8u) & 255u),
        f32((color >> 16u) & 255u),
        f32(color >> 24u),
    );
}

// Blends a premultiplied color sum over the background. `hidden` is the opacity of the sum.
fn over_background(colors: vec3f, hidden: f32) -> u32 {
    if hidden == 0.0 {
        return frame.background;
    }
    let below = channels(frame.background);
    let shines = max(1.0 - hidden, 0.0) * below.a / 255.0;
    let opacity = hidden + shines;
    let mixed = vec3u((colors + below.rgb * shines) / opacity + 0.5);
    return mixed.r | (mixed.g << 8u) | (mixed.b << 16u) | (u32(opacity * 255.0 + 0.5) << 24u);
}
