// Pulls a control point of the vertex's patch from storage buffers, and converts it to pixels.
layout(std430, binding = PATCHES) readonly restrict buffer Patches { uint patches[]; };
layout(std430, binding = POINTS) readonly restrict buffer Points { vec2 points_m[]; };

void main() {
    uint vertex = uint(gl_VertexID);
    uint point = patches[vertex / PATCH_VERTICES] + vertex % PATCH_VERTICES;
    gl_Position = vec4(pixel_from_world(points_m[point]), 0.0, 1.0);
}
