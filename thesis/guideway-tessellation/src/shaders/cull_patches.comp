// Culling, one thread per path: appends the segments of each visible path to the patches of one
// draw.
layout(std430, binding = SEGMENTS) readonly restrict buffer Segments { uint segments[]; };
layout(std430, binding = PATCHES) writeonly restrict buffer Patches { uint patches[]; };

void main() {
    uint id = gl_GlobalInvocationID.x;
    if (id >= paths.length()) {
        return;
    }
    PathRecord path = paths[id];
    if (is_visible(path)) {
        atomicAdd(counters.drawn, 1u);
        uint vertices = PATCH_VERTICES * path.segment_count;
        uint slot = atomicAdd(counters.vertex_count, vertices) / PATCH_VERTICES;
        for (uint i = 0u; i < path.segment_count; ++i) {
            patches[slot + i] = segments[path.first_segment + i];
        }
    }
}
