// Computes a point of a segment (thesis 4.2.2), rounded to the subpixel grid.
layout(isolines, equal_spacing) in;

void main() {
    float isolines = gl_TessLevelOuter[0];
    float t = (round(gl_TessCoord.y * isolines) + gl_TessCoord.x) / isolines;
    precise vec2 pixel = bspline(
        gl_in[0].gl_Position.xy, gl_in[1].gl_Position.xy,
        gl_in[2].gl_Position.xy, gl_in[3].gl_Position.xy, t
    );
    pixel = round(pixel * STEPS_PER_PX) / STEPS_PER_PX;
    gl_Position = vec4((pixel - viewport_px) * clip_per_px, 0.0, 1.0);
}
