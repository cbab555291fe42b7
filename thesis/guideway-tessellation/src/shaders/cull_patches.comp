// One thread a path: appends the segments of each that is seen to the patches of one draw.
layout(std430, binding = SEGMENTS) readonly restrict buffer Segments { uint segments[]; };
layout(std430, binding = PATCHES) writeonly restrict buffer Patches { uint patches[]; };

void main() {
    uint id = gl_GlobalInvocationID.x;
    if (id >= paths.length()) {
        return;
    }
    PathRecord path = paths[id];
    if (is_seen(path)) {
        atomicAdd(tally.drawn, 1u);
        uint place = atomicAdd(tally.vertex_count, CORNERS * path.segment_count) / CORNERS;
        for (uint i = 0u; i < path.segment_count; ++i) {
            patches[place + i] = segments[path.first_segment + i];
        }
    }
}
