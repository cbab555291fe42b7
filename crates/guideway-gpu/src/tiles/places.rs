//! Where on the device each path is.

use std::collections::HashMap;

use super::pack::moves_m;
use super::store::Store;

const NO_STROKE: u32 = u32::MAX;

/// Where the strokes of each path are, and what the boxes of clusters were when they were packed.
pub(super) struct Places {
    /// The stroke of each row, if it has one alone.
    first: Vec<u32>,
    /// Strokes of the other paths.
    more: HashMap<u32, Vec<u32>>,
    homes: Vec<[[f32; 2]; 2]>,
    pub(super) unused_points: usize,
}

impl Places {
    pub(super) fn of(store: &Store, rows: usize) -> Self {
        let mut places = Self {
            first: Vec::new(),
            more: HashMap::new(),
            homes: Vec::new(),
            unused_points: 0,
        };
        places.add(store, 0, 0, rows);
        places
    }

    /// Learns of strokes and clusters from these on.
    pub(super) fn add(
        &mut self,
        store: &Store,
        first_stroke: usize,
        first_cluster: usize,
        rows: usize,
    ) {
        self.first.resize(rows, NO_STROKE);
        for (stroke, index) in store.stroke_list.iter().zip(0..).skip(first_stroke) {
            let row = store.ranks.row(stroke.rank);
            let first = &mut self.first[row as usize];
            if *first == NO_STROKE {
                *first = index;
            } else {
                let more = self.more.entry(row).or_insert_with(|| vec![*first]);
                more.push(index);
            }
        }
        let clusters = store.cluster_list[first_cluster..].iter();
        self.homes.extend(clusters.map(|c| [c.low_m, c.high_m]));
    }

    pub(super) fn strokes(&self, row: u32) -> &[u32] {
        match self.more.get(&row) {
            Some(strokes) => strokes,
            None => match self.first.get(row as usize) {
                Some(first) if *first != NO_STROKE => std::slice::from_ref(first),
                _ => &[],
            },
        }
    }

    pub(super) fn forget(&mut self, store: &Store, row: u32) {
        let rooms = self
            .strokes(row)
            .iter()
            .map(|&stroke| room_of(store, stroke) as usize);
        self.unused_points += rooms.sum::<usize>();
        self.more.remove(&row);
        if let Some(first) = self.first.get_mut(row as usize) {
            *first = NO_STROKE;
        }
    }

    /// Whether a cluster's points may go there.
    pub(super) fn is_home(&self, cluster: usize, [x, y]: [f32; 2]) -> bool {
        let [low, high] = self.homes[cluster];
        let near = |v: f32, axis: usize| {
            let room = moves_m(f64::from(high[axis] - low[axis])) as f32;
            v >= low[axis] - room && v <= high[axis] + room
        };
        near(x, 0) && near(y, 1)
    }
}

/// The cluster of a stroke.
pub(super) fn cluster_of(store: &Store, stroke: u32) -> usize {
    let behind = store
        .cluster_list
        .partition_point(|c| c.first_stroke <= stroke);
    behind - 1
}

/// Points that a stroke has room for.
pub(super) fn room_of(store: &Store, stroke: u32) -> u32 {
    let cluster = &store.cluster_list[cluster_of(store, stroke)];
    let first = store.stroke_list[stroke as usize].first_point();
    let next = stroke + 1;
    let end = if next < cluster.first_stroke + cluster.strokes {
        store.stroke_list[next as usize].first_point()
    } else {
        cluster.points
    };
    end - first
}
