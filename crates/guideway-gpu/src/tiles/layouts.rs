//! Structures in device memory. `layout_tests` compares them with the shaders.

use bytemuck::{Pod, Zeroable};

use super::constants::{HIDDEN_STROKE, MAX_SEGMENTS, SEGMENTS_BIT, WHOLE_PATH};

/// Parameters of a frame. WGSL: `Frame` of `shared/frame.wgsl`, which documents each field.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct FrameParams {
    pub(crate) center_high_m: [f32; 2],
    pub(crate) center_low_m: [f32; 2],
    pub(crate) lod_reach_px: [f32; 2],
    pub(crate) flatten_low_px: [f32; 2],
    pub(crate) flatten_high_px: [f32; 2],
    pub(crate) window_low_px: [f32; 2],
    pub(crate) window_high_px: [f32; 2],
    pub(crate) lod_origin_px: [f32; 2],
    pub(crate) map_x: [f32; 2],
    pub(crate) map_y: [f32; 2],
    pub(crate) lod_px_per_m: f32,
    pub(crate) lod_px_per_px: f32,
    pub(crate) px_per_lod_px: f32,
    pub(crate) px_per_m: f32,
    pub(crate) radius_px: f32,
    pub(crate) min_radius_px: f32,
    pub(crate) max_radius_px: f32,
    pub(crate) tolerance_px: f32,
    pub(crate) clusters: u32,
    pub(crate) styles: u32,
    pub(crate) width_px: u32,
    pub(crate) height_px: u32,
    pub(crate) first_column: u32,
    pub(crate) columns: u32,
    pub(crate) first_row: u32,
    pub(crate) rows: u32,
    pub(crate) first_pixel_row: u32,
    pub(crate) line_capacity: u32,
    pub(crate) reference_capacity: u32,
    pub(crate) color: u32,
    pub(crate) background: u32,
    pub(crate) max_step_m: f32,
    pub(crate) has_ranks: u32,
    pub(crate) first_line: u32,
    pub(crate) caches_lines: u32,
    pub(crate) dirty_clusters: u32,
    pub(crate) cached_lines: u32,
    pub(crate) threads_per_line: u32,
    pub(crate) list_capacity: u32,
    pub(crate) steps_per_px: f32,
    pub(crate) px_per_step: f32,
    pub(crate) padding: u32,
}

/// Parameters of one flatten dispatch. WGSL: `FlattenDispatch` of `flatten/bindings.wgsl`.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct FlattenDispatch {
    pub(crate) first_cluster: u32,
    pub(crate) end_cluster: u32,
    pub(crate) occlusion_pass: u32,
    pub(crate) is_near: u32,
}

/// Parameters of a scroll. WGSL: `Scroll` of `cache/scroll.wgsl`.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct ScrollParams {
    pub(crate) width_px: u32,
    pub(crate) height_px: u32,
    pub(crate) right_px: i32,
    pub(crate) down_px: i32,
}

/// Pixels that become part of a texture. WGSL: `Part` of `present.wgsl`.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct PresentParams {
    pub(crate) width_px: u32,
    pub(crate) first_pixel: u32,
    pub(crate) pixels: u32,
    pub(crate) unused: u32,
}

/// Neighboring strokes with a common origin. WGSL: `Cluster` of `flatten/cluster.wgsl`.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct Cluster {
    pub(crate) origin_high_m: [f32; 2],
    pub(crate) origin_low_m: [f32; 2],
    pub(crate) low_m: [f32; 2],
    pub(crate) high_m: [f32; 2],
    pub(crate) widest_m: f32,
    pub(crate) step_m: f32,
    pub(crate) first_point: u32,
    pub(crate) points: u32,
    pub(crate) first_stroke: u32,
    pub(crate) strokes: u32,
    pub(crate) stored_step_m: f32,
    pub(crate) is_mapped: u32,
}

/// Format of control points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum PointFormat {
    /// Multiples of the cluster's step, two 16-bit numbers per word.
    Rounded = 0,
    /// Two floats.
    Exact = 1,
}

impl PointFormat {
    /// Words per point.
    pub(crate) fn words(self) -> usize {
        match self {
            Self::Rounded => 1,
            Self::Exact => 2,
        }
    }

    /// Bytes of `points` points.
    pub(crate) fn bytes(self, points: u32) -> u64 {
        u64::from(points) * (self.words() * size_of::<u32>()) as u64
    }
}

/// Part of a path. WGSL: `Stroke` of `flatten/stroke.wgsl`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct Stroke {
    pub(crate) extent: u32,
    pub(crate) rank: u32,
}

impl Stroke {
    /// Index of the first control point within the cluster.
    pub(crate) fn first_point(self) -> u32 {
        self.extent & 0xffff
    }

    /// Returns `true` if the stroke has segments: its path is drawn unless it is hidden.
    pub(crate) fn is_drawn(self) -> bool {
        self.segments() > 0
    }

    /// Returns `true` if the stroke is a whole path.
    pub(crate) fn is_whole_path(self) -> bool {
        self.extent & WHOLE_PATH != 0
    }

    /// The stroke as the device has it.
    pub(crate) fn flagged(self, is_hidden: bool) -> Self {
        let flag = if is_hidden { HIDDEN_STROKE } else { 0 };
        Self {
            extent: self.extent | flag,
            ..self
        }
    }

    /// Number of control points, if the stroke has segments.
    pub(crate) fn points(self) -> u32 {
        self.segments() + 3
    }

    pub(crate) fn segments(self) -> u32 {
        self.extent >> SEGMENTS_BIT & MAX_SEGMENTS
    }
}

/// Color and width of a path. WGSL: `Style` of `shared/style.wgsl`.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct PathStyle {
    pub(crate) color: u32,
    pub(crate) width_m: f32,
}

/// Counters of a window. WGSL: `Counters` of `shared/counters.wgsl`, which documents each field.
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct FrameCounters {
    pub(crate) rounded_clusters: u32,
    pub(crate) exact_clusters: u32,
    pub(crate) lines: u32,
    pub(crate) references: u32,
    pub(crate) drawn_paths: u32,
    pub(crate) longest_list: u32,
    pub(crate) full_tiles: u32,
    pub(crate) max_loops: u32,
    pub(crate) missing_clusters: u32,
    pub(crate) split_tiles: u32,
    pub(crate) split_parts: u32,
    pub(crate) longest_unsplit: u32,
    /// Tests, atomics, words read and words written, low word first; of counting kernels only.
    pub(crate) work: [u32; 8],
}

/// Per-cluster slot behind the counters. WGSL: `ClusterSlot` of `shared/counters.wgsl`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct ClusterSlot {
    pub(crate) visible: u32,
    pub(crate) block: u32,
}
