// One thread a path: appends a draw command for each that is seen (thesis figure 4.2).
layout(std430, binding = COMMANDS) writeonly restrict buffer Commands { DrawElements commands[]; };

void main() {
    uint id = gl_GlobalInvocationID.x;
    if (id >= paths.length()) {
        return;
    }
    PathRecord path = paths[id];
    if (is_seen(path)) {
        uint place = atomicAdd(tally.drawn, 1u);
        commands[place] =
            DrawElements(CORNERS * path.segment_count, 1u, CORNERS * path.first_segment, 0u, 0u);
    }
}
