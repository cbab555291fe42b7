//! Sorts rows along a Hilbert curve, so that rows near each other in the plane are near each other
//! in the result.
//!
//! A most-significant-digit radix sort in two passes of 10 bits each: threads scatter the rows into
//! buckets by the highest bits of their keys, then each bucket is scattered again. A bucket of the
//! second pass covers a thousandth of the plane's side, so only large ones are sorted further.
//! Cost: O(n), two passes over the keys.

use guideway_spline::{Bounds, Point, hilbert};
use rayon::prelude::*;

/// Rows that one task scatters: large enough that buckets hold some rows each, small enough that all
/// threads have work.
const TASK_ROWS: usize = 1 << 16;
/// Bits of a key that one pass sorts by. Two passes leave 2^20 buckets over the plane.
const BUCKET_BITS: u32 = 10;
const BUCKETS: usize = 1 << BUCKET_BITS;
/// Buckets with at most this many keys stay unsorted: they fit in a fraction of one cluster.
const UNSORTED_LEN: usize = 16;
/// Buckets with at least this many keys are sorted by all threads.
const PARALLEL_LEN: usize = 1 << 15;

/// Returns the rows `0..count` in Hilbert order of their positions within `bounds`.
///
/// Rows without a position come last, in ascending order; without `bounds` all rows keep their
/// order. Rows at the same position keep their order while they are few (16).
pub fn hilbert_order(
    count: usize,
    bounds: Option<Bounds<f64>>,
    position: impl Fn(usize) -> Option<Point<f64>> + Sync,
) -> Vec<u32> {
    let Some(bounds) = bounds else {
        return (0..count as u32).collect();
    };
    let key = |row: usize| {
        let place = position(row).map_or(u32::MAX, |position| hilbert(position, bounds));
        u64::from(place) << u32::BITS | row as u64
    };
    let tasks = (0..count.div_ceil(TASK_ROWS)).into_par_iter();
    let tasks = tasks.map_init(Vec::<u64>::new, |keys, task| {
        keys.clear();
        keys.extend((task * TASK_ROWS..count.min((task + 1) * TASK_ROWS)).map(key));
        let mut buckets = RadixBuckets::default();
        buckets.scatter(keys, 0);
        buckets
    });
    merge_buckets(count, &tasks.collect::<Vec<_>>())
}

/// Joins the buckets of all tasks, sorts each by its second digit and returns the rows of their keys.
fn merge_buckets(count: usize, tasks: &[RadixBuckets]) -> Vec<u32> {
    let mut rows = vec![0; count];
    let mut left = &mut rows[..];
    let buckets = (0..BUCKETS).filter_map(|bucket| {
        let count = tasks.iter().map(|task| task.keys_of(bucket).len()).sum();
        let rows = left.split_off_mut(..count)?;
        (count > 0).then_some((bucket, rows))
    });
    let buckets: Vec<(usize, &mut [u32])> = buckets.collect();
    buckets.into_par_iter().for_each_init(
        <(Vec<u64>, RadixBuckets)>::default,
        |(keys, inner), (bucket, rows)| {
            keys.clear();
            for task in tasks {
                keys.extend_from_slice(task.keys_of(bucket));
            }
            inner.scatter(keys, 1);
            inner.sort_large();
            for (row, &key) in rows.iter_mut().zip(&inner.keys) {
                *row = key as u32;
            }
        },
    );
    rows
}

/// Keys grouped by one digit, each group in the order in which its keys came.
#[derive(Default)]
struct RadixBuckets {
    keys: Vec<u64>,
    /// End of each bucket in `keys`.
    ends: Vec<u32>,
}

impl RadixBuckets {
    /// Replaces all keys by `keys`, grouped by digit `digit` (0: the highest bits).
    fn scatter(&mut self, keys: &[u64], digit: u32) {
        let bucket = |key: u64| (key >> (u64::BITS - (digit + 1) * BUCKET_BITS)) as usize % BUCKETS;
        self.ends.clear();
        self.ends.resize(BUCKETS, 0);
        for &key in keys {
            self.ends[bucket(key)] += 1;
        }
        // Counts become starts; the loop below advances each start to its end.
        let mut start = 0;
        for end in &mut self.ends {
            start += std::mem::replace(end, start);
        }
        self.keys.resize(keys.len(), 0);
        for &key in keys {
            let place = &mut self.ends[bucket(key)];
            self.keys[*place as usize] = key;
            *place += 1;
        }
    }

    fn keys_of(&self, bucket: usize) -> &[u64] {
        let start = bucket.checked_sub(1).map_or(0, |before| self.ends[before]);
        &self.keys[start as usize..self.ends[bucket] as usize]
    }

    /// Sorts the buckets that hold more than a few keys.
    fn sort_large(&mut self) {
        let mut start = 0;
        for &end in &self.ends {
            let keys = &mut self.keys[start..end as usize];
            if keys.len() >= PARALLEL_LEN {
                keys.par_sort_unstable();
            } else if keys.len() > UNSORTED_LEN {
                keys.sort_unstable();
            }
            start = end as usize;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cluster::CLUSTER_LEN;

    /// Points anywhere in a square.
    fn scattered(count: usize, side: f64) -> Vec<Option<Point<f64>>> {
        let mut state = 9_u32;
        let mut next = || {
            state = state.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
            f64::from(state >> 8) / f64::from(1 << 24) * side
        };
        let points = (0..count).map(|_| Some(Point::new(next(), next())));
        points.collect()
    }

    fn sorted(points: &[Option<Point<f64>>]) -> Vec<u32> {
        let bounds = Bounds::of_points(points.iter().copied().flatten());
        hilbert_order(points.len(), bounds, |row| points[row])
    }

    /// Mean side of the bounding boxes of the clusters.
    fn mean_side(points: &[Option<Point<f64>>], rows: &[u32]) -> f64 {
        let clusters = rows.chunks(CLUSTER_LEN).map(|rows| {
            let points = rows.iter().filter_map(|&row| points[row as usize]);
            let size = Bounds::of_points(points).unwrap().size();
            (size.x + size.y) / 2.0
        });
        clusters.sum::<f64>() / rows.len().div_ceil(CLUSTER_LEN) as f64
    }

    #[test]
    fn neighbors_share_clusters_even_with_a_far_outlier() {
        let count = 100_000;
        for far in [1.0, 300.0] {
            let mut points = scattered(count, 1.0);
            points[7] = Some(Point::new(far, far));
            let rows = sorted(&points);
            let mut all = rows.clone();
            all.sort_unstable();
            assert!(all.into_iter().eq(0..count as u32));
            // The share of one cluster in the square has a side of 1/40.
            let is_near = |row: &u32| *row != 7;
            let near: Vec<u32> = rows.into_iter().filter(is_near).collect();
            let side = mean_side(&points, &near);
            assert!(side < 0.04, "{far}: {side}");
            let unsorted: Vec<u32> = (0..count as u32).filter(is_near).collect();
            assert!(mean_side(&points, &unsorted) > 0.9);
        }
    }

    #[test]
    fn rows_without_position_come_last_in_their_order() {
        let mut points = scattered(5_000, 1.0);
        for row in (0..5_000).step_by(7) {
            points[row] = None;
        }
        let rows = sorted(&points);
        let (with, without) = rows.split_at(5_000 - 5_000_usize.div_ceil(7));
        assert!(with.iter().all(|row| row % 7 != 0));
        assert!(without.iter().copied().eq((0..5_000).step_by(7)));
        let mut with = with.to_vec();
        with.sort_unstable();
        assert!(with.into_iter().eq((0..5_000).filter(|row| row % 7 != 0)));
    }

    #[test]
    fn rows_at_one_position_keep_their_order() {
        let points = vec![Some(Point::new(3.0, 4.0)); 100];
        assert!(sorted(&points).into_iter().eq(0..100));
        assert!(sorted(&[]).is_empty());
        assert!(sorted(&[None; 3]).into_iter().eq(0..3));
    }
}
