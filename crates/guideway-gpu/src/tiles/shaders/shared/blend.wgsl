// Blends 8-bit RGBA colors (red in the lowest byte, straight alpha), in whole numbers.

// import: shared/frame.wgsl

// Steps of a pixel in sums: a full one of the color 255 has 255 * PIXEL_STEPS.
const PIXEL_STEPS: u32 = 4096u;
const FULL_PIXEL: u32 = 255u * PIXEL_STEPS;

fn channels(color: u32) -> vec4u {
    return (vec4u(color) >> vec4u(0u, 8u, 16u, 24u)) & vec4u(255u);
}

// Red, green and blue of a color and a full opacity, as one sample adds them.
fn opaque_channels(color: u32) -> vec4u {
    return vec4u(channels(color).rgb, 255u);
}

// Blends the sums of a pixel, premultiplied colors and opacity, over the background.
fn over_background(sums: vec4u) -> u32 {
    if sums.a == 0u {
        return frame.background;
    }
    let below = channels(frame.background);
    let shines = ((FULL_PIXEL - min(sums.a, FULL_PIXEL)) * below.a + 127u) / 255u;
    let colors = sums.rgb + (below.rgb * shines + 127u) / 255u;
    let opacity = sums.a + shines;
    var mixed = (colors + PIXEL_STEPS / 2u) / PIXEL_STEPS;
    if opacity != FULL_PIXEL {
        mixed = (colors * 255u + opacity / 2u) / opacity;
    }
    mixed = min(mixed, vec3u(255u));
    let alpha = min((opacity + PIXEL_STEPS / 2u) / PIXEL_STEPS, 255u);
    return mixed.r | (mixed.g << 8u) | (mixed.b << 16u) | (alpha << 24u);
}
