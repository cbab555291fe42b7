//! Decides the length from which tile lists are split among workgroups.

use super::constants::{LONG_LIST_PART, LOOPS_PER_LINE, MIN_UNSPLIT_LIST};
use super::layouts::FrameCounters;
use crate::device::Gpu;

/// Limits of the longest list that one workgroup covers where lists can be split.
pub(crate) fn unsplit_limits(gpu: &Gpu) -> [u32; 2] {
    let max = gpu.loops_per_thread() / LOOPS_PER_LINE;
    match gpu.options().max_unsplit_list {
        Some(limit) => [limit.min(max); 2],
        None => [MIN_UNSPLIT_LIST.min(max), max],
    }
}

/// Returns `true` if one list takes a workgroup longer than all lists take the device.
pub(crate) fn has_long_list(gpu: &Gpu, counters: &FrameCounters) -> bool {
    let [min, max] = unsplit_limits(gpu);
    counters.longest_list > (counters.references / LONG_LIST_PART).clamp(min, max)
}
