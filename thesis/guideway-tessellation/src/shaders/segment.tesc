// Computes the number of lines per segment (thesis 4.2.1).
layout(vertices = PATCH_VERTICES) out;

void main() {
    gl_out[gl_InvocationID].gl_Position = gl_in[gl_InvocationID].gl_Position;
    if (gl_InvocationID != 0) {
        return;
    }
    vec2 p0 = gl_in[0].gl_Position.xy;
    vec2 p1 = gl_in[1].gl_Position.xy;
    vec2 p2 = gl_in[2].gl_Position.xy;
    vec2 p3 = gl_in[3].gl_Position.xy;

    float length_px = 0.0;
    vec2 start = bspline(p0, p1, p2, p3, 0.0);
    for (uint i = 1u; i < LENGTH_SAMPLES; ++i) {
        vec2 end = bspline(p0, p1, p2, p3, float(i) / float(LENGTH_SAMPLES - 1u));
        length_px += distance(start, end);
        start = end;
    }
    float lines = clamp(length_px / PX_PER_LINE, MIN_LINES, MAX_LINES);

    // Long bends need more lines than one isoline has, so further isolines continue the first.
    // derived: n lines are within bend / (8 n n) of the curve, because its second derivative is at
    // most the larger second difference of its control points.
    float bend_px = max(distance(p0 + p2, 2.0 * p1), distance(p1 + p3, 2.0 * p2));
    lines = max(lines, sqrt(bend_px / (8.0 * FLATNESS_PX)));
    float isolines = min(ceil(lines / MAX_LINES), MAX_LINES);
    gl_TessLevelOuter[0] = isolines;
    gl_TessLevelOuter[1] = min(lines / isolines, MAX_LINES);
}
