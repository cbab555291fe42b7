//! A cache of exact points of clusters whose points are rounded, for views so near that the
//! rounding would show.

use guideway_scene::RenderError;
use wgpu::BufferUsages;

use super::point_buffer::{PointBuffer, ViewDistance};
use crate::device::Memory;
use crate::tiles::layouts::{Cluster, PointFormat};

/// Name of the buffer in errors.
pub(crate) const EXACT_POINTS: &str = "exact control points of what is seen from near";

/// Exact points of near clusters, as far as capacity allows.
pub(crate) struct ExactPoints {
    pub(crate) buffer: PointBuffer,
    /// First point of each cluster; 0 if it has none here. The buffer begins with the same words,
    /// two in the place of a point.
    pub(crate) first_points: Vec<u32>,
}

impl ExactPoints {
    /// Creates a cache for `points` points of these clusters.
    pub(crate) fn new(
        memory: &mut Memory,
        clusters: &[Cluster],
        points: u32,
    ) -> Result<Self, RenderError> {
        let usage = BufferUsages::STORAGE | BufferUsages::COPY_DST;
        let bytes = Self::buffer_bytes(clusters.len(), points);
        let buffer = memory.zeros(EXACT_POINTS, bytes, usage)?;
        let distance = ViewDistance::Near {
            max_step_m: clusters.iter().map(|c| c.step_m).fold(0.0, f32::max),
        };
        let all = 0..clusters.len() as u32;
        let mut buffer = PointBuffer::new(memory, buffer, PointFormat::Exact, all, distance)?;
        buffer.used_points = table_points(clusters.len());
        Ok(Self {
            buffer,
            first_points: vec![0; clusters.len()],
        })
    }

    /// The first point of a cluster, if its points are here.
    pub(crate) fn first_point(&self, cluster: u32) -> Option<u32> {
        let first = self.first_points.get(cluster as usize).copied();
        first.filter(|&first| first > 0)
    }

    /// Bytes of a cache for `points` points of `clusters` clusters.
    pub(crate) fn buffer_bytes(clusters: usize, points: u32) -> u64 {
        PointFormat::Exact.bytes(table_points(clusters)) + PointFormat::Exact.bytes(points)
    }
}

/// Points that the table of first points takes the place of.
fn table_points(clusters: usize) -> u32 {
    clusters.div_ceil(2) as u32
}
