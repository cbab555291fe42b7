//! The gesture that is shown: which clusters its map moves, and which paths are drawn from clusters
//! of the gesture instead of their own. A translation of all paths moves the view instead.

use guideway_scene::cluster::ClusterBounds;
use guideway_scene::{GesturePaths, PathState, Scene};
use guideway_spline::{Affine, Point};

/// A gesture, and the clusters without it.
pub(crate) struct ShownGesture {
    pub(crate) paths: GesturePaths,
    /// The map of the clusters.
    pub(crate) by: Affine,
    /// A translation of the whole picture, in meters, beside the map.
    pub(crate) shift_m: Point<f64>,
    /// True if no path rests.
    pub(crate) moves_all: bool,
    /// Mapped clusters without the map, ascending.
    pub(crate) at_rest: Vec<(u32, ClusterBounds)>,
    /// True for paths that the gesture draws from clusters of its own; empty without any.
    pub(crate) is_split: Vec<bool>,
    /// Clusters of the scene that do not draw such paths.
    pub(crate) thinned: Vec<u32>,
    /// Number of clusters of the scene; those of the gesture are behind them.
    pub(crate) clusters: usize,
}

impl ShownGesture {
    /// Heap bytes held.
    pub(crate) fn bytes(&self) -> u64 {
        let at_rest = self.at_rest.capacity() * size_of::<(u32, ClusterBounds)>();
        let thinned = self.thinned.capacity() * size_of::<u32>();
        (at_rest + thinned + self.is_split.capacity()) as u64
    }

    /// The parts of a map that the view and the clusters take: the view translates all paths.
    pub(crate) fn split(&self, by: Affine) -> (Point<f64>, Affine) {
        match by.as_translation().filter(|_| self.moves_all) {
            Some(shift_m) => (shift_m, Affine::IDENTITY),
            None => (Point::default(), by),
        }
    }

    /// Returns `true` if all clusters are where the scene has them.
    pub(crate) fn is_at_rest(&self) -> bool {
        self.moves_all && self.by == Affine::IDENTITY
    }

    /// Returns `true` if the map moves a cluster.
    pub(crate) fn moves(&self, cluster: u32) -> bool {
        self.at_rest(cluster).is_some()
    }

    /// A cluster without the map, if the map moves it.
    fn at_rest(&self, cluster: u32) -> Option<ClusterBounds> {
        let found = self.at_rest.binary_search_by_key(&cluster, |(at, _)| *at);
        found.ok().map(|index| self.at_rest[index].1)
    }

    /// The map of a cluster.
    pub(crate) fn map_of(&self, cluster: u32) -> Option<Affine> {
        self.at_rest(cluster).map(|_| self.by)
    }
}

/// The paths of a cluster as a frame shows them.
#[derive(Clone, Copy)]
pub(crate) struct ClusterPaths<'a> {
    pub(crate) rows: &'a [u32],
    /// Origin of the control points where the scene has them.
    pub(crate) origin_m: Point<f64>,
    /// The map of the control points, if a gesture moves them.
    pub(crate) by: Option<Affine>,
    /// Paths that the gesture draws elsewhere.
    is_split: &'a [bool],
}

impl<'a> ClusterPaths<'a> {
    /// The paths of a cluster whose origin is shown at `origin_m`.
    pub(crate) fn of(
        gesture: Option<&'a ShownGesture>,
        cluster: u32,
        rows: &'a [u32],
        origin_m: Point<f64>,
    ) -> Self {
        let paths = Self {
            rows,
            origin_m,
            by: None,
            is_split: &[],
        };
        let Some(gesture) = gesture else {
            return paths;
        };
        let at_rest = gesture.at_rest(cluster);
        Self {
            origin_m: at_rest.map_or(origin_m, |bounds| bounds.origin),
            by: at_rest.map(|_| gesture.by),
            is_split: match (cluster as usize) < gesture.clusters {
                true => &gesture.is_split,
                false => &[],
            },
            ..paths
        }
    }

    /// Returns `true` if the cluster draws a path.
    pub(crate) fn draws(&self, scene: &Scene, path: u32) -> bool {
        let is_split = self.is_split.get(path as usize) == Some(&true);
        scene.state(path) == PathState::Shown && !is_split
    }
}
