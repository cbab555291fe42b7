// Culling, one thread per path: appends a draw command per visible path (thesis, figure 4.2).
layout(std430, binding = COMMANDS) writeonly restrict buffer Commands { DrawElements commands[]; };

void main() {
    uint id = gl_GlobalInvocationID.x;
    if (id >= paths.length()) {
        return;
    }
    PathRecord path = paths[id];
    if (is_visible(path)) {
        uint slot = atomicAdd(counters.drawn, 1u);
        uint index_count = PATCH_VERTICES * path.segment_count;
        uint first_index = PATCH_VERTICES * path.first_segment;
        commands[slot] = DrawElements(index_count, 1u, first_index, 0u, 0u);
    }
}
