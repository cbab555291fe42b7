//! Rows in an order in which near ones are near each other.

use guideway_layout::Hulls;
use guideway_spline::hilbert;
use rayon::prelude::*;

/// Rows that are put into drawers at once.
const PART: usize = 1 << 16;
/// Bits that say which drawer a key is for.
const DRAWER_BITS: u32 = 10;
const DRAWERS: usize = 1 << DRAWER_BITS;
/// So few keys in one of the drawers within others are not sorted: they lie beside each other however they follow.
const FEW: usize = 16;
/// So many keys are sorted by all threads.
const MANY: usize = 1 << 15;

/// All rows, along a curve that fills the plane.
///
/// By the highest bits of their places they are put into drawers, and by as many more into others within: what is left lies within
/// a thousandth of the plane's side, and is sorted only where it is much.
pub(super) fn sorted_rows(hulls: &Hulls) -> Vec<u32> {
    let Some(all) = hulls.all() else {
        return (0..hulls.len() as u32).collect();
    };
    let key = |row: usize| {
        let hull = hulls.of([row]);
        let place = hull.map_or(u32::MAX, |hull| hilbert(hull.center(), all));
        u64::from(place) << u32::BITS | row as u64
    };
    let count = hulls.len();
    let parts = (0..count.div_ceil(PART)).into_par_iter();
    let parts = parts.map_init(Vec::<u64>::new, |keys, part| {
        keys.clear();
        keys.extend((part * PART..count.min((part + 1) * PART)).map(key));
        let mut drawers = Drawers::default();
        drawers.put(keys, 0);
        drawers
    });
    let parts: Vec<Drawers> = parts.collect();
    let mut rows = vec![0; count];
    let mut left = &mut rows[..];
    let drawers = (0..DRAWERS).filter_map(|drawer| {
        let count = parts.iter().map(|part| part.of(drawer).len()).sum();
        let rows = left.split_off_mut(..count)?;
        (count > 0).then_some((drawer, rows))
    });
    let drawers: Vec<(usize, &mut [u32])> = drawers.collect();
    let work = drawers.into_par_iter();
    work.for_each_init(
        <(Vec<u64>, Drawers)>::default,
        |(keys, within), (drawer, rows)| {
            keys.clear();
            for part in &parts {
                keys.extend_from_slice(part.of(drawer));
            }
            within.put(keys, 1);
            within.sort();
            for (row, &key) in rows.iter_mut().zip(&within.keys) {
                *row = key as u32;
            }
        },
    );
    rows
}

/// Keys, those of a drawer next to each other and in the order in which they came.
#[derive(Default)]
struct Drawers {
    keys: Vec<u64>,
    /// Where each drawer ends.
    ends: Vec<u32>,
}

impl Drawers {
    /// Takes keys in place of all others, by their highest bits, or those behind as many for so many levels.
    fn put(&mut self, keys: &[u64], level: u32) {
        let drawer = |key: u64| (key >> (u64::BITS - (level + 1) * DRAWER_BITS)) as usize % DRAWERS;
        self.ends.clear();
        self.ends.resize(DRAWERS, 0);
        for &key in keys {
            self.ends[drawer(key)] += 1;
        }
        // Where each begins: by the end, that will be where it ends.
        let mut start = 0;
        for end in &mut self.ends {
            start += std::mem::replace(end, start);
        }
        self.keys.resize(keys.len(), 0);
        for &key in keys {
            let place = &mut self.ends[drawer(key)];
            self.keys[*place as usize] = key;
            *place += 1;
        }
    }

    fn of(&self, drawer: usize) -> &[u64] {
        let start = drawer.checked_sub(1).map_or(0, |before| self.ends[before]);
        &self.keys[start as usize..self.ends[drawer] as usize]
    }

    /// Sorts what is in each drawer, if it is much.
    fn sort(&mut self) {
        let mut start = 0;
        for &end in &self.ends {
            let keys = &mut self.keys[start..end as usize];
            if keys.len() >= MANY {
                keys.par_sort_unstable();
            } else if keys.len() > FEW {
                keys.sort_unstable();
            }
            start = end as usize;
        }
    }
}

#[cfg(test)]
mod tests {
    use guideway_spline::{Bounds, Point};

    use super::*;
    use crate::cpu::cluster::CLUSTER_PATHS;

    /// Boxes of points anywhere in a square.
    fn scattered(count: usize, side: f32) -> Vec<Bounds<f32>> {
        let mut state = 9_u32;
        let mut next = || {
            state = state.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
            (state >> 8) as f32 / (1 << 24) as f32 * side
        };
        let points = (0..count).map(|_| Point::new(next(), next()));
        points.map(|p| Bounds { min: p, max: p }).collect()
    }

    /// The sides of the boxes of clusters, on the mean.
    fn mean_side(boxes: &[Bounds<f32>], rows: &[u32]) -> f32 {
        let clusters = rows.chunks(CLUSTER_PATHS).map(|rows| {
            let boxes = rows.iter().map(|&row| boxes[row as usize]);
            let size = boxes.reduce(Bounds::union).unwrap().size();
            (size.x + size.y) / 2.0
        });
        clusters.sum::<f32>() / rows.len().div_ceil(CLUSTER_PATHS) as f32
    }

    #[test]
    fn each_row_is_there_once_beside_near_ones_however_far_one_is_from_all() {
        let count = 100_000;
        for far in [1.0, 300.0] {
            let mut boxes = scattered(count, 1.0);
            let at = Point::new(far, far);
            boxes[7] = Bounds { min: at, max: at };
            let rows = sorted_rows(&boxes.clone().into());
            let mut all = rows.clone();
            all.sort_unstable();
            assert!(all.into_iter().eq(0..count as u32));
            // A cluster's share of the square has a side of a fortieth.
            let is_near = |row: &u32| *row != 7;
            let near: Vec<u32> = rows.into_iter().filter(is_near).collect();
            let side = mean_side(&boxes, &near);
            assert!(side < 0.04, "{far}: {side}");
            // In the order of the file it is nothing like that.
            let unsorted: Vec<u32> = (0..count as u32).filter(is_near).collect();
            assert!(mean_side(&boxes, &unsorted) > 0.9);
        }
    }

    #[test]
    fn rows_without_points_come_behind_all_others_in_their_order() {
        let [min, max] = [f32::INFINITY, f32::NEG_INFINITY].map(|v| Point::new(v, v));
        let mut boxes = scattered(5_000, 1.0);
        for row in (0..5_000).step_by(7) {
            boxes[row] = Bounds { min, max };
        }
        let rows = sorted_rows(&boxes.into());
        let (with, without) = rows.split_at(5_000 - 5_000_usize.div_ceil(7));
        assert!(with.iter().all(|row| row % 7 != 0));
        assert!(without.iter().copied().eq((0..5_000).step_by(7)));
        let mut with = with.to_vec();
        with.sort_unstable();
        assert!(with.into_iter().eq((0..5_000).filter(|row| row % 7 != 0)));
    }

    #[test]
    fn what_lies_in_one_place_keeps_its_order() {
        let at = Point::new(3.0, 4.0);
        let boxes = vec![Bounds { min: at, max: at }; 100];
        assert!(sorted_rows(&boxes.into()).into_iter().eq(0..100));
        let none: Vec<Bounds<f64>> = Vec::new();
        assert!(sorted_rows(&none.into()).is_empty());
    }
}
