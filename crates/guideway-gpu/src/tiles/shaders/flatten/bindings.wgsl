// Bindings of the flatten kernel, but for the control points.

// import: shared/frame.wgsl
// import: shared/counters.wgsl
// import: shared/style.wgsl
// import: shared/line.wgsl
// import: flatten/cluster.wgsl
// import: flatten/stroke.wgsl

// The clusters whose control points the bound buffer holds. Rust: `FlattenDispatch`.
struct FlattenDispatch {
    first_cluster: u32,
    end_cluster: u32,
    // 0: all clusters. 1: every fourth, to fill tiles. 2: the others, where tiles are not full.
    occlusion_pass: u32,
    // 1: clusters too near for their rounded points. 0: all others.
    is_near: u32,
}

// Every FIRST_PASS_STRIDE-th cluster belongs to occlusion pass 1.
const FIRST_PASS_STRIDE: u32 = 4u;

@group(0) @binding(1) var<uniform> dispatch: FlattenDispatch;
@group(0) @binding(3) var<storage, read> strokes: array<Stroke>;
@group(0) @binding(4) var<storage, read> clusters: array<Cluster>;
@group(0) @binding(5) var<storage, read> styles: array<Style>;
@group(0) @binding(6) var<storage, read_write> counters: CounterBuffer;
@group(0) @binding(7) var<storage, read_write> lines: array<u32>;
@group(0) @binding(8) var<storage, read_write> line_ranks: array<u32>;
@group(0) @binding(9) var<storage, read_write> tile_counts: array<atomic<u32>>;
