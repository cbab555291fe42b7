//! Collects the changes of an edit as patches of scene buffers, and sends them.

use std::collections::BTreeMap;

use guideway_scene::RenderError;

use super::scene_buffers::SceneBuffers;
use crate::device::{DeviceBuffer, Patch, Patcher};
use crate::tiles::device_context::DeviceContext;
use crate::tiles::layouts::{Cluster, Stroke};
use guideway_scene::cluster::DirtyClusters;

pub(crate) const STROKE_WORDS: usize = size_of::<Stroke>() / 4;
const CLUSTER_WORDS: usize = size_of::<Cluster>() / 4;

/// A buffer of a scene.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Target {
    /// The point buffer with this index.
    Points(usize),
    /// The cache of exact points.
    ExactPoints,
    Strokes,
    Clusters,
}

/// Changes of an edit.
#[derive(Default)]
pub(crate) struct EditPatches {
    /// Changed strokes.
    pub(crate) strokes: Vec<u32>,
    /// Changed cluster entries.
    pub(crate) clusters: DirtyClusters,
    /// Clusters with changed curves.
    pub(crate) dirty: DirtyClusters,
    /// Clusters with strokes that have come or gone.
    pub(crate) recounted: DirtyClusters,
    finished: BTreeMap<Target, Vec<Patch>>,
}

impl EditPatches {
    /// Adds a patch of a buffer that is complete.
    pub(crate) fn add_finished(&mut self, target: Target, patch: Patch) {
        self.finished.entry(target).or_default().push(patch);
    }

    /// Sends all patches. Returns the bytes sent.
    pub(crate) fn send(
        &self,
        buffers: &SceneBuffers,
        patcher: &mut Option<Patcher>,
        device: &mut DeviceContext,
    ) -> Result<u64, RenderError> {
        let (mut strokes, mut clusters) = (Patch::default(), Patch::default());
        for &stroke in &self.strokes {
            let flagged = buffers.flagged_stroke(stroke);
            strokes.set(stroke as usize * STROKE_WORDS, &flagged);
        }
        for cluster in self.clusters.iter() {
            clusters.set(cluster * CLUSTER_WORDS, &buffers.cluster_list[cluster]);
        }
        let lists = [(Target::Strokes, &strokes), (Target::Clusters, &clusters)];
        let finished = self.finished.iter();
        let finished = finished.flat_map(|(target, all)| all.iter().map(|patch| (*target, patch)));
        send_patches(lists.into_iter().chain(finished), buffers, patcher, device)
    }
}

/// Sends patches, those of one buffer together. Returns the bytes sent.
pub(super) fn send_patches<'a>(
    patches: impl Iterator<Item = (Target, &'a Patch)>,
    buffers: &SceneBuffers,
    patcher: &mut Option<Patcher>,
    device: &mut DeviceContext,
) -> Result<u64, RenderError> {
    let mut by_target = BTreeMap::<_, Vec<&Patch>>::new();
    let mut bytes = 0;
    for (target, patch) in patches {
        by_target.entry(target).or_default().push(patch);
        bytes += patch.bytes();
    }
    for (target, patches) in by_target {
        if let Some(buffer) = target.buffer(buffers) {
            let (patcher, target) = device.patch(patcher, buffer)?;
            patcher.apply(target, &patches)?;
        }
    }
    Ok(bytes)
}

impl Target {
    fn buffer(self, buffers: &SceneBuffers) -> Option<&DeviceBuffer> {
        Some(match self {
            Self::Points(index) => &buffers.point_buffers[index].points,
            Self::ExactPoints => &buffers.exact_points.as_ref()?.buffer.points,
            Self::Strokes => &buffers.strokes,
            Self::Clusters => &buffers.clusters,
        })
    }
}
