//! [`ShownGesture`]: the gesture that the buffers of a scene show, and what restores them.

use std::ops::Range;

use guideway_scene::{Gesture, GesturePaths};
use guideway_spline::{Affine, Bounds};

use super::facts::SceneFacts;
use crate::tiles::cache::picture_cache::DirtyArea;
use crate::tiles::layouts::Cluster;

/// The gesture that the buffers of a scene show, and how they were before.
pub(crate) struct ShownGesture {
    pub(super) paths: GesturePaths,
    pub(super) by: Affine,
    pub(super) is_selected: Vec<bool>,
    /// Mapped clusters without the map, ascending.
    pub(super) at_rest: Vec<(usize, Cluster)>,
    /// The area in which the mapped clusters are shown.
    pub(super) shown_area: DirtyArea,
    /// Strokes that are drawn from clusters of the gesture instead.
    pub(super) hidden: Vec<u32>,
    /// Number of clusters, strokes and point buffers of the scene.
    pub(super) clusters: usize,
    pub(super) strokes: usize,
    pub(super) point_buffers: usize,
    pub(super) facts: SceneFacts,
}

impl ShownGesture {
    /// Returns `true` if a gesture is this one, with any map.
    pub(crate) fn is_of(&self, gesture: &Gesture) -> bool {
        self.paths.are_of(gesture)
    }

    /// Returns `true` if the map does more than move paths.
    pub(crate) fn turns(&self) -> bool {
        self.by.as_translation().is_none()
    }

    /// Indices of the mapped clusters.
    pub(crate) fn mapped_clusters(&self) -> impl Iterator<Item = usize> {
        self.at_rest.iter().map(|(index, _)| *index)
    }

    /// The area in which the mapped clusters are shown.
    pub(crate) fn shown_area(&self) -> DirtyArea {
        self.shown_area
    }

    /// A mapped cluster without the map.
    pub(crate) fn at_rest(&self, index: usize) -> Option<&Cluster> {
        let found = self
            .at_rest
            .binary_search_by_key(&index, |(index, _)| *index);
        Some(&self.at_rest[found.ok()?].1)
    }

    /// A box that holds the control points of a path as they are shown.
    pub(crate) fn shown_hull(&self, path: u32, hull: Bounds<f64>) -> Bounds<f64> {
        match self.is_selected.get(path as usize) {
            Some(true) => {
                let corners = hull.corners().map(|p| self.by.apply(p));
                Bounds::of_points(corners).unwrap_or(hull)
            }
            _ => hull,
        }
    }

    /// The range of clusters that holds all mapped ones.
    pub(super) fn mapped_range(&self) -> Range<usize> {
        let ends = (self.at_rest.first(), self.at_rest.last());
        match ends {
            (Some((first, _)), Some((last, _))) => *first..last + 1,
            _ => 0..0,
        }
    }
}
