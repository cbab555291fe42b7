//! Control points of a range of clusters, as large as one binding allows.

use std::ops::Range;

use guideway_scene::RenderError;
use wgpu::BufferUsages;

use crate::device::{DeviceBuffer, Memory};
use crate::tiles::layouts::{Cluster, FlattenDispatch, PointFormat};

/// Occlusion passes: all clusters at once; or some first, and then the others.
const OCCLUSION_PASSES: usize = 3;

/// Bytes of the dispatch parameters of a point buffer.
pub(crate) const DISPATCH_BYTES: u64 = (OCCLUSION_PASSES * size_of::<FlattenDispatch>()) as u64;

/// Control points of one format.
pub(crate) struct PointBuffer {
    /// Dispatch parameters by occlusion pass.
    pub(crate) dispatches: [DeviceBuffer; OCCLUSION_PASSES],
    pub(crate) points: DeviceBuffer,
    pub(crate) format: PointFormat,
    /// The clusters of these points.
    pub(crate) clusters: Range<u32>,
    pub(crate) used_points: u32,
    pub(crate) distance: ViewDistance,
}

/// The views that are drawn from a point buffer.
#[derive(Clone, Copy)]
pub(crate) enum ViewDistance {
    /// Views too far for the rounding to show. `min_step_m`: the least step of its clusters.
    Far { min_step_m: f32 },
    /// Nearer views. `max_step_m`: the greatest step of its clusters.
    Near { max_step_m: f32 },
}

impl ViewDistance {
    /// Returns `true` if any cluster is drawn, in a view that shows steps above `max_step_m`.
    pub(crate) fn draws_any(self, max_step_m: f32) -> bool {
        match self {
            Self::Far { min_step_m } => min_step_m <= max_step_m,
            Self::Near {
                max_step_m: greatest_m,
            } => greatest_m > max_step_m,
        }
    }
}

impl PointBuffer {
    /// Wraps a buffer of points, none of them in use.
    pub(crate) fn new(
        memory: &mut Memory,
        points: DeviceBuffer,
        format: PointFormat,
        clusters: Range<u32>,
        distance: ViewDistance,
    ) -> Result<Self, RenderError> {
        let usage = BufferUsages::UNIFORM | BufferUsages::COPY_DST;
        let bytes = size_of::<FlattenDispatch>() as u64;
        let mut dispatch = || memory.zeros("the clusters", bytes, usage);
        Ok(Self {
            dispatches: [dispatch()?, dispatch()?, dispatch()?],
            points,
            format,
            clusters,
            used_points: 0,
            distance,
        })
    }

    /// Points that fit behind those in use.
    pub(crate) fn spare_points(&self) -> u32 {
        (self.points.bytes() / self.format.bytes(1)) as u32 - self.used_points
    }

    /// Parameters of the dispatch of an occlusion pass.
    pub(crate) fn dispatch(&self, occlusion_pass: u32) -> FlattenDispatch {
        FlattenDispatch {
            first_cluster: self.clusters.start,
            end_cluster: self.clusters.end,
            occlusion_pass,
            is_near: u32::from(matches!(self.distance, ViewDistance::Near { .. })),
        }
    }
}

/// Splits clusters into ranges of one point format that fit one binding each.
pub(crate) fn buffer_ranges(clusters: &[Cluster], max_bytes: u64) -> Vec<Range<u32>> {
    let mut ranges: Vec<Range<u32>> = Vec::new();
    let (mut bytes, mut format) = (0, PointFormat::Rounded);
    for (cluster, index) in clusters.iter().zip(0..) {
        let more = cluster.format().bytes(cluster.points);
        match ranges.last_mut() {
            Some(last) if format == cluster.format() && bytes + more <= max_bytes => {
                last.end = index + 1;
            }
            _ => {
                ranges.push(index..index + 1);
                (bytes, format) = (0, cluster.format());
            }
        }
        bytes += more;
    }
    ranges
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn splits_clusters_by_binding_size_and_format() {
        let of = |(points, step_m)| Cluster {
            points,
            step_m,
            ..bytemuck::Zeroable::zeroed()
        };
        let rounded = [5, 5, 6, 9, 1, 10].map(|points| of((points, 0.001)));
        assert_eq!(buffer_ranges(&rounded, 40), [0..2, 2..3, 3..5, 5..6]);
        let exact = [5, 5, 6].map(|points| of((points, 0.0)));
        assert_eq!(buffer_ranges(&exact, 40), [0..1, 1..2, 2..3]);
        let both = [(2, 0.001), (2, 0.0), (3, 0.0)].map(of);
        assert_eq!(buffer_ranges(&both, 40), [0..1, 1..3]);
        assert_eq!(buffer_ranges(&[], 40), []);
    }
}
