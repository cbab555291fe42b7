//! Control points that a shader sees at once, and the clusters that they belong to.

use std::ops::Range;

use guideway_scene::RenderError;
use wgpu::BufferUsages;

use super::params::{ChunkParams, Cluster, Points};
use crate::device::{DeviceBuffer, Memory};

const WORD_BYTES: u64 = size_of::<u32>() as u64;
/// All clusters at once; and those of a first round, and the others after it.
const ROUNDS: usize = 3;

/// Bytes of what shaders are told of a chunk.
pub(super) const PARAMS_BYTES: u64 = (ROUNDS * size_of::<ChunkParams>()) as u64;

/// Control points that are held alike.
pub(super) struct Chunk {
    /// For each of [`ROUNDS`].
    pub(super) params: [DeviceBuffer; ROUNDS],
    pub(super) points: DeviceBuffer,
    pub(super) held: Points,
    /// Whose points they are.
    pub(super) clusters: Range<u32>,
    pub(super) used_points: u32,
    pub(super) drawn: Drawn,
}

/// Which clusters are drawn from the points of a chunk.
#[derive(Clone, Copy)]
pub(super) enum Drawn {
    /// Those that a view does not come too near to: not if even this, the least of their steps, is too large for it.
    Far { least_step_m: f32 },
    /// The others: none as long as this, the greatest of their steps, is not.
    Near { greatest_step_m: f32 },
}

impl Drawn {
    /// Whether there is any where steps up to that are not too large.
    pub(super) fn is_any(self, most_step_m: f32) -> bool {
        match self {
            Self::Far { least_step_m } => least_step_m <= most_step_m,
            Self::Near { greatest_step_m } => greatest_step_m > most_step_m,
        }
    }
}

impl Chunk {
    /// Points of which none is used.
    pub(super) fn new(
        memory: &mut Memory,
        points: DeviceBuffer,
        held: Points,
        clusters: Range<u32>,
        drawn: Drawn,
    ) -> Result<Self, RenderError> {
        let usage = BufferUsages::UNIFORM | BufferUsages::COPY_DST;
        let mut one = || memory.zeros("the clusters", size_of::<ChunkParams>() as u64, usage);
        Ok(Self {
            params: [one()?, one()?, one()?],
            points,
            held,
            clusters,
            used_points: 0,
            drawn,
        })
    }

    /// Points that there is room for.
    pub(super) fn room(&self) -> u32 {
        (self.points.bytes() / bytes_of(self.held, 1)) as u32
    }

    pub(super) fn spare_points(&self) -> u32 {
        self.room() - self.used_points
    }

    pub(super) fn params_of(&self, round: u32) -> ChunkParams {
        ChunkParams {
            first_cluster: self.clusters.start,
            end_cluster: self.clusters.end,
            round,
            is_near: u32::from(matches!(self.drawn, Drawn::Near { .. })),
        }
    }
}

/// Bytes of so many points.
pub(super) fn bytes_of(held: Points, points: u32) -> u64 {
    u64::from(points) * held.words() as u64 * WORD_BYTES
}

/// Cuts clusters where their points are too many for one buffer, or held otherwise.
pub(super) fn ranges(clusters: &[Cluster], most_bytes: u64) -> Vec<Range<u32>> {
    let mut ranges: Vec<Range<u32>> = Vec::new();
    let (mut bytes, mut held) = (0, Points::Rounded);
    for (cluster, index) in clusters.iter().zip(0..) {
        let more = bytes_of(cluster.held(), cluster.points);
        match ranges.last_mut() {
            Some(last) if held == cluster.held() && bytes + more <= most_bytes => {
                last.end = index + 1;
            }
            _ => {
                ranges.push(index..index + 1);
                (bytes, held) = (0, cluster.held());
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
    fn clusters_are_cut_where_a_buffer_is_full_or_points_are_held_otherwise() {
        let of = |(points, step_m)| Cluster {
            points,
            step_m,
            ..bytemuck::Zeroable::zeroed()
        };
        let rounded = [5, 5, 6, 9, 1, 10].map(|points| of((points, 0.001)));
        assert_eq!(ranges(&rounded, 40), [0..2, 2..3, 3..5, 5..6]);
        let exact = [5, 5, 6].map(|points| of((points, 0.0)));
        assert_eq!(ranges(&exact, 40), [0..1, 1..2, 2..3]);
        let both = [(2, 0.001), (2, 0.0), (3, 0.0)].map(of);
        assert_eq!(ranges(&both, 40), [0..1, 1..3]);
        assert_eq!(ranges(&[], 40), []);
    }
}
