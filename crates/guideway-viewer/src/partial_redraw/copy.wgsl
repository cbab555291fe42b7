// Copies the picture of the window to the screen, pixel for pixel.

@group(0) @binding(0) var picture: texture_2d<f32>;

// A triangle that covers the window.
@vertex
fn corner(@builtin(vertex_index) index: u32) -> @builtin(position) vec4<f32> {
    let x = select(-1.0, 3.0, index == 1u);
    let y = select(-1.0, 3.0, index == 2u);
    return vec4<f32>(x, y, 0.0, 1.0);
}

@fragment
fn copy(@builtin(position) pixel: vec4<f32>) -> @location(0) vec4<f32> {
    return textureLoad(picture, vec2<i32>(pixel.xy), 0);
}
