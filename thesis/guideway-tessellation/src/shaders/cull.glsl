// Shared by both culling passes (thesis 4.2.3): their inputs, and the test of a path's bounds.
layout(local_size_x = WORKGROUP) in;

layout(std430, binding = PATHS) readonly buffer Paths { PathRecord paths[]; };
layout(std430, binding = COUNTERS) restrict buffer CountersBlock { Counters counters; };

bool is_visible(PathRecord path) {
    return all(lessThanEqual(path.min_m, visible_max_m))
        && all(greaterThanEqual(path.max_m, visible_min_m));
}
