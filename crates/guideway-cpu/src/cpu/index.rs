use guideway_scene::{Rgba, Scene};
use rayon::prelude::*;

use super::cluster::{CLUSTER_PATHS, Cluster, hull_bounds, sorted_rows};
use super::shot::{Widths, widths};

/// The rows of a scene in clusters, and what holds for all of them.
pub(super) struct Index {
    /// Rows of paths, those of a cluster next to each other.
    pub(super) paths: Vec<u32>,
    pub(super) clusters: Vec<Cluster>,
    /// Cluster of each row; made for the first edit.
    cluster_of: Vec<u32>,
    /// Draw rank of each row; none if it is its row.
    pub(super) ranks: Option<Vec<u32>>,
    pub(super) widths: Widths,
    /// The colour of all paths, if it is one and opaque.
    pub(super) solid: Option<Rgba>,
}

impl Index {
    pub(super) fn new(scene: &Scene) -> Self {
        let mut index = Self {
            paths: sorted_rows(scene),
            clusters: Vec::new(),
            cluster_of: Vec::new(),
            ranks: None,
            widths: None,
            solid: None,
        };
        let bound = |paths| Cluster {
            bounds: hull_bounds(scene.layout(), paths),
            ..Cluster::default()
        };
        index.clusters = index.paths.par_chunks(CLUSTER_PATHS).map(bound).collect();
        index.order_anew(scene);
        index
    }

    /// After ranks, colours or widths have changed.
    pub(super) fn order_anew(&mut self, scene: &Scene) {
        let order = scene.draw_order();
        self.ranks = (!order.is_sorted()).then(|| {
            let mut ranks = vec![0; scene.row_count()];
            for (&path, rank) in order.iter().zip(0..) {
                ranks[path as usize] = rank;
            }
            ranks
        });
        self.widths = widths(scene);
        self.solid = scene.common_color().filter(|color| color.is_opaque());
    }

    pub(super) fn bytes(&self) -> u64 {
        let ranks = self.ranks.as_ref().map_or(0, Vec::capacity);
        let rows = self.paths.capacity() + self.cluster_of.capacity() + ranks;
        (rows * size_of::<u32>() + self.clusters.capacity() * size_of::<Cluster>()) as u64
    }

    /// Makes anew what depends on the curves and the states of some paths.
    pub(super) fn touch(&mut self, scene: &Scene, paths: &[u32]) {
        if self.cluster_of.is_empty() {
            self.cluster_of.resize(self.paths.len(), 0);
            for (&path, place) in self.paths.iter().zip(0_usize..) {
                self.cluster_of[path as usize] = (place / CLUSTER_PATHS) as u32;
            }
        }
        for &path in paths {
            let cluster = self.cluster_of[path as usize];
            self.clusters[cluster as usize].is_stale = true;
        }
        let clusters = self.clusters.par_iter_mut();
        clusters
            .zip(self.paths.par_chunks(CLUSTER_PATHS))
            .for_each(|(cluster, paths)| {
                if cluster.is_stale {
                    cluster.bounds = hull_bounds(scene.layout(), paths);
                }
            });
    }

    /// Puts rows behind the last into clusters of their own.
    pub(super) fn append(&mut self, scene: &Scene) {
        let first = self.paths.len() as u32;
        self.paths.extend(first..scene.row_count() as u32);
        let clusters = self.paths.len().div_ceil(CLUSTER_PATHS);
        self.clusters.resize_with(clusters, Cluster::default);
        if !self.cluster_of.is_empty() {
            let places = self.cluster_of.len()..self.paths.len();
            self.cluster_of
                .extend(places.map(|place| (place / CLUSTER_PATHS) as u32));
        }
        let rows: Vec<u32> = (first..self.paths.len() as u32).collect();
        self.touch(scene, &rows);
    }
}
