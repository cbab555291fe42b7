// Blends the color over the background. Fully transparent pixels keep the background's color.
fn blend(covered: f32) -> u32 {
    let ink = unpack4x8unorm(view.color);
    let back = unpack4x8unorm(view.background);
    let opacity = mix(back.a, 1.0, covered);
    if opacity == 0.0 {
        return view.background;
    }
    let color = mix(back.rgb * back.a, ink.rgb, covered) / opacity;
    return pack4x8unorm(vec4f(color, opacity));
}
