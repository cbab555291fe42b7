use std::ops::Range;

use guideway_spline::{Bounds, Point, hilbert};
use rayon::prelude::*;

/// PathSet of one cluster.
const CLUSTER: usize = 64;

/// A box a row, found by where it is. Neighbors lie in clusters, so that a question looks at few rows; a change
/// costs no more than the clusters that it touches, and however much changes, a question never takes longer than a
/// look at every box.
///
/// A tree of boxes (rstar 0.14) finds a few of a million in less than a microsecond, and this in 13. But to build it took
/// 0.4 s and not 0.1, it holds twice as much, a question for most of them took 21 ms and not 1.3, and moving a tenth of
/// them 94 ms and not 1.1: edits and whole views are what an editor waits for.
#[derive(Clone, Debug, Default)]
pub(super) struct Boxes {
    /// Along Hilbert's curve at first; rows added later lie behind.
    boxes: Vec<Bounds<f64>>,
    /// Row of each box.
    rows: Vec<u32>,
    /// Place in the two lists above of each row.
    places: Vec<u32>,
    clusters: Vec<Bounds<f64>>,
}

/// The box of what is nowhere: it meets none.
const NOWHERE: Bounds<f64> = Bounds {
    min: Point::new(f64::INFINITY, f64::INFINITY),
    max: Point::new(f64::NEG_INFINITY, f64::NEG_INFINITY),
};

impl Boxes {
    /// One box a row, from row 0 on.
    pub(super) fn new(boxes: Vec<Option<Bounds<f64>>>) -> Self {
        let by_row = boxes.into_iter().map(|b| b.unwrap_or(NOWHERE));
        let by_row: Vec<Bounds<f64>> = by_row.collect();
        let all = by_row.iter().copied().fold(NOWHERE, Bounds::union);
        let mut order: Vec<(u32, u32)> = by_row
            .par_iter()
            .zip(0..by_row.len() as u32)
            .map(|(b, row)| (hilbert(b.center(), all), row))
            .collect();
        order.par_sort_unstable();
        let rows: Vec<u32> = order.into_iter().map(|(_, row)| row).collect();
        let mut places = vec![0; rows.len()];
        for (&row, place) in rows.iter().zip(0..) {
            places[row as usize] = place;
        }
        let mut new = Self {
            boxes: rows.iter().map(|&row| by_row[row as usize]).collect(),
            rows,
            places,
            clusters: Vec::new(),
        };
        new.gather(0..new.cluster_count());
        new
    }

    /// Gives rows other boxes. A row beyond the last one is a new one: they come without a gap.
    pub(super) fn set(&mut self, boxes: impl Iterator<Item = (u32, Option<Bounds<f64>>)>) {
        let mut touched = vec![false; self.clusters.len()];
        for (row, bounds) in boxes {
            let place = match self.places.get(row as usize) {
                Some(&place) => place as usize,
                None => {
                    self.places.push(self.boxes.len() as u32);
                    self.rows.push(row);
                    self.boxes.push(NOWHERE);
                    touched.resize(self.cluster_count(), true);
                    self.boxes.len() - 1
                }
            };
            self.boxes[place] = bounds.unwrap_or(NOWHERE);
            touched[place / CLUSTER] = true;
        }
        for (cluster, _) in touched.iter().enumerate().filter(|(_, is_so)| **is_so) {
            self.gather(cluster..cluster + 1);
        }
    }

    /// The box of a row; none if it has none.
    pub(super) fn get(&self, row: u32) -> Option<Bounds<f64>> {
        let place = *self.places.get(row as usize)?;
        Some(self.boxes[place as usize]).filter(|bounds| bounds.min.x <= bounds.max.x)
    }

    /// PathSet whose box meets `bounds`, with it, in no order.
    pub(super) fn meeting(&self, bounds: Bounds<f64>) -> impl Iterator<Item = (u32, Bounds<f64>)> {
        let clusters = self.clusters.iter().enumerate();
        let met = clusters.filter(move |(_, cluster)| cluster.intersects(bounds));
        met.flat_map(|(cluster, _)| self.places_of(cluster))
            .map(|place| (self.rows[place], self.boxes[place]))
            .filter(move |(_, b)| b.intersects(bounds))
    }

    fn cluster_count(&self) -> usize {
        self.boxes.len().div_ceil(CLUSTER)
    }

    fn places_of(&self, cluster: usize) -> Range<usize> {
        let first = cluster * CLUSTER;
        first..(first + CLUSTER).min(self.boxes.len())
    }

    /// Finds the boxes of clusters from those of their rows.
    fn gather(&mut self, clusters: Range<usize>) {
        self.clusters.resize(self.cluster_count(), NOWHERE);
        for cluster in clusters {
            let boxes = &self.boxes[self.places_of(cluster)];
            self.clusters[cluster] = boxes.iter().copied().fold(NOWHERE, Bounds::union);
        }
    }
}
