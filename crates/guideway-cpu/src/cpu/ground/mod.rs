//! Shared by all stages: constants of a tile, the sample pattern, the frame context, damage, SIMD
//! dispatch and per-thread slots. Nothing here imports a stage.

pub(super) mod damage;
pub(super) mod fixed_steps;
pub(super) mod frame_context;
pub(super) mod gesture;
pub(super) mod per_thread;
pub(super) mod samples;
pub(super) mod scene_hulls;
pub(super) mod simd;
pub(super) mod snapped_view;
pub(super) mod tile;
