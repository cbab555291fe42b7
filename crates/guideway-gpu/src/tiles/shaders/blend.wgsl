// Colors of 8 bits, red lowest, over each other with straight alpha.

fn channels(color: u32) -> vec4f {
    return vec4f(
        f32(color & 255u),
        f32((color >> 8u) & 255u),
        f32((color >> 16u) & 255u),
        f32(color >> 24u),
    );
}

// What a pixel shows: colors summed by their share of it, with how much of it they hide, over the background.
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
