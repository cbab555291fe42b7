//! Flattens the visible clusters of a band that have no valid lines in the cache, within a memory
//! limit.

use std::ops::Range;
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};

use guideway_scene::RenderError;
use guideway_scene::cluster::ClusterIndex;
use rayon::prelude::*;

use crate::cpu::bin::cull::{VisibleCluster, VisibleClusters};
use crate::cpu::flatten::cluster_lines::FlattenScratch;
use crate::cpu::flatten::line_cache::{LineCache, LineState};
use crate::cpu::ground::frame_context::{FrameContext, LineCacheKey};
use crate::cpu::ground::gesture::ClusterPaths;
use crate::cpu::ground::per_thread::thread_slot;
use crate::cpu::ground::scene_hulls::prefetch_paths;

/// Why a band was not drawn.
pub(crate) enum DrawError {
    /// Lines or lists exceed the memory limit: lower bound of the bytes they need.
    OverBudget(u64),
    Failed(RenderError),
}

impl From<RenderError> for DrawError {
    fn from(error: RenderError) -> Self {
        Self::Failed(error)
    }
}

/// A band whose visible clusters are flattened.
#[derive(Clone, Copy)]
pub(crate) struct FlattenInput<'a> {
    pub(crate) ctx: &'a FrameContext<'a>,
    pub(crate) index: &'a ClusterIndex,
    pub(crate) visible: &'a VisibleClusters,
    /// Rows of tiles of the band.
    pub(crate) rows: &'a Range<usize>,
    /// Most bytes of all cached lines.
    pub(crate) limit_bytes: u64,
}

/// Flattens the visible clusters that have no valid lines, and lists their keys in `dirty`. Returns
/// the bytes of all cached lines.
pub(crate) fn flatten_visible(
    input: FlattenInput<'_>,
    cache: &mut LineCache,
    scratches: &[Mutex<FlattenScratch>],
    dirty: &mut Vec<u32>,
) -> Result<u64, DrawError> {
    let FlattenInput {
        ctx,
        index,
        visible,
        rows,
        limit_bytes,
    } = input;
    collect_dirty(input, cache, dirty);
    let total = AtomicU64::new(cache.bytes);
    let place = |key| visible.get(key).cluster as usize;
    let prefetch = |key| {
        let paths = index.rows_of(visible.get(key).cluster);
        prefetch_paths(ctx.scene, paths.iter().map(|&path| path as usize));
    };
    let all = &mut cache.lines[..];
    for_each_at(all, 0, dirty, (&place, &prefetch), &|key, lines| {
        let is_over = total.load(Ordering::Relaxed) > limit_bytes;
        let entry = visible.get(key);
        let Some(bounds) = index.bounds()[entry.cluster as usize] else {
            return;
        };
        if is_over || ctx.cancel.check().is_err() {
            return;
        }
        let mut scratch = thread_slot(scratches);
        let before = lines.bytes();
        let rows_of = index.rows_of(entry.cluster);
        let cluster = ClusterPaths::of(ctx.gesture, entry.cluster, rows_of, bounds.origin);
        lines.flatten(ctx, entry.is_oversized, cluster, rows, &mut scratch);
        total.fetch_add(lines.bytes().wrapping_sub(before), Ordering::Relaxed);
    });
    cache.bytes = total.into_inner();
    ctx.cancel.check()?;
    if cache.bytes > limit_bytes {
        return Err(DrawError::OverBudget(cache.bytes));
    }
    for &key in dirty.iter() {
        let entry = visible.get(key);
        let cluster = entry.cluster as usize;
        cache.states[cluster] = LineState {
            key: if entry.is_oversized {
                LineCacheKey::default()
            } else {
                ctx.cache_key()
            },
            drift_m: 0.0,
            counts: cache.lines[cluster].path_and_line_counts(),
        };
    }
    Ok(cache.bytes)
}

/// Lists the visible clusters that have to be flattened. Evicts the clusters out of view if cached
/// lines take more than half of the limit.
fn collect_dirty(input: FlattenInput<'_>, cache: &mut LineCache, dirty: &mut Vec<u32>) {
    let FlattenInput {
        ctx, visible, rows, ..
    } = input;
    if cache.bytes > input.limit_bytes / 2 {
        let mut is_kept = vec![false; cache.lines.len()];
        for entry in visible.iter().filter(|entry| entry.is_in(rows)) {
            is_kept[entry.cluster as usize] = true;
        }
        cache.evict(|cluster| is_kept[cluster as usize]);
    }
    dirty.clear();
    for (key, entry) in visible.with_keys() {
        if entry.is_in(rows) {
            let state = &mut cache.states[entry.cluster as usize];
            if entry.is_oversized || !state.is_valid(ctx) {
                dirty.push(key);
                // A frame that fails before it flattens them leaves them stale.
                state.invalidate();
            }
        }
    }
}

/// Counts the paths and lines that may touch the picture: each cluster in the band where it begins.
pub(crate) fn count_drawn(
    visible: &VisibleClusters,
    ctx: &FrameContext<'_>,
    cache: &LineCache,
    rows: &Range<usize>,
) -> [u64; 2] {
    let of_chunk = |chunk: &[VisibleCluster]| {
        let begin_here = chunk.iter();
        let begin_here = begin_here.filter(|visible| rows.contains(&visible.rows().start));
        let counts = begin_here.map(|visible| {
            let cluster = visible.cluster as usize;
            if visible.is_inside {
                cache.states[cluster].counts
            } else {
                cache.lines[cluster].visible_counts(ctx, visible.origin_px)
            }
        });
        counts.fold([0, 0], |sum, counts| {
            [0, 1].map(|i| sum[i] + u64::from(counts[i]))
        })
    };
    let counts = visible.par_chunks().map(of_chunk);
    counts.reduce(|| [0, 0], |a, b| [a[0] + b[0], a[1] + b[1]])
}

/// Calls `work` in parallel for each key with the element at its place in `all`. Places ascend with
/// the keys; the first element of `all` has the place `first`. Calls `prefetch` for a key while
/// `work` runs for the key before it.
fn for_each_at<T: Send, K: Copy + Sync>(
    all: &mut [T],
    first: usize,
    keys: &[K],
    (place, prefetch): (&(impl Fn(K) -> usize + Sync), &(impl Fn(K) + Sync)),
    work: &(impl Fn(K, &mut T) + Sync),
) {
    /// Keys per task: a cluster takes some 20 us to flatten.
    const TASK_LEN: usize = 8;
    if keys.len() <= TASK_LEN {
        if let Some(&key) = keys.first() {
            prefetch(key);
        }
        for (i, &key) in keys.iter().enumerate() {
            if let Some(&next) = keys.get(i + 1) {
                prefetch(next);
            }
            work(key, &mut all[place(key) - first]);
        }
        return;
    }
    let (left, right) = keys.split_at(keys.len() / 2);
    let middle = place(right[0]);
    let (before, behind) = all.split_at_mut(middle - first);
    rayon::join(
        || for_each_at(before, first, left, (place, prefetch), work),
        || for_each_at(behind, middle, right, (place, prefetch), work),
    );
}
