//! A scene and its buffers on the device.

use std::collections::BTreeSet;
use std::sync::Arc;
use std::time::Instant;

use guideway_scene::{RenderError, Scene, Stage, elapsed_ms};

use super::draw_ranks::DrawRanks;
use super::facts::SceneFacts;
use super::pack::{Packed, Packing};
use super::path_parts::parts_of;
use super::path_strokes::PathStrokes;
use super::rewrite::SparePatches;
use super::scene_buffers::SceneBuffers;
use super::shown_gesture::ShownGesture;
use crate::device::Patcher;
use crate::tiles::device_context::{DeviceContext, device_error};

/// A scene on the device.
pub(crate) struct UploadedScene {
    pub(crate) scene: Arc<Scene>,
    /// `None` if the scene draws nothing.
    pub(crate) buffers: Option<SceneBuffers>,
    pub(crate) facts: SceneFacts,
    pub(crate) packing: Packing,
    /// Paths of several strokes, shown or not: the device does not count them.
    pub(crate) multi_stroke_paths: BTreeSet<u32>,
    /// `None` until an edit or a near view needs it.
    pub(crate) path_strokes: Option<PathStrokes>,
    pub(crate) patcher: Option<Patcher>,
    pub(crate) spare_patches: SparePatches,
    /// The gesture that the buffers show.
    pub(crate) gesture: Option<ShownGesture>,
    /// True if an upload or an edit failed halfway, so that buffers may be inconsistent.
    pub(crate) is_incomplete: bool,
}

impl UploadedScene {
    /// A scene that is not uploaded yet.
    pub(crate) fn new(scene: Arc<Scene>) -> Self {
        Self {
            facts: SceneFacts::of(&scene),
            packing: Packing::of(&scene),
            multi_stroke_paths: BTreeSet::new(),
            path_strokes: None,
            patcher: None,
            spare_patches: SparePatches::default(),
            gesture: None,
            buffers: None,
            scene,
            is_incomplete: true,
        }
    }

    /// Uploads the scene in place of its earlier buffers. The caller first drops all bind groups
    /// and caches of these buffers.
    pub(crate) fn upload(
        &mut self,
        device: &mut DeviceContext,
        packing: Packing,
    ) -> Result<Vec<Stage>, RenderError> {
        (self.buffers, self.path_strokes, self.gesture) = (None, None, None);
        self.packing = packing;
        self.is_incomplete = true;
        self.facts = SceneFacts::of(&self.scene);
        let start = Instant::now();
        let ranks = DrawRanks::of(&self.scene);
        let parts = parts_of(&self.scene, &ranks, self.scene.draw_order());
        let several = parts.iter().filter(|part| !part.is_whole());
        self.multi_stroke_paths = several.map(|part| part.path).collect();
        let packed = Packed::of(&self.scene, parts, packing);
        let facts = &mut self.facts;
        for cluster in &packed.clusters {
            facts.reach_m = facts.reach_m.max(f64::from(cluster.reach_m()));
            facts.greatest_step_m = facts.greatest_step_m.max(cluster.step_m);
        }
        let packed_ms = elapsed_ms(start);
        let start = Instant::now();
        self.buffers =
            SceneBuffers::new(&device.gpu, &mut device.memory, &self.scene, packed, ranks)?;
        if let Some(buffers) = &self.buffers {
            self.facts.clusters = buffers.cluster_list.len() as u32;
            self.facts.styles = buffers.style_count;
        }
        self.write_dispatches(device)?;
        self.is_incomplete = false;
        Ok(vec![
            Stage::host("pack", packed_ms),
            Stage::host("upload", elapsed_ms(start)),
        ])
    }

    /// Writes the dispatch parameters of all point buffers.
    pub(crate) fn write_dispatches(&self, device: &DeviceContext) -> Result<(), RenderError> {
        let point_buffers = self
            .buffers
            .iter()
            .flat_map(SceneBuffers::all_point_buffers);
        for points in point_buffers {
            for (buffer, occlusion_pass) in points.dispatches.iter().zip(0..) {
                let dispatch = points.dispatch(occlusion_pass);
                let written = device.runner.write("the clusters", buffer, &dispatch);
                written.map_err(device_error)?;
            }
        }
        Ok(())
    }

    /// Number of strokes on the device.
    pub(crate) fn stroke_count(&self) -> u32 {
        let buffers = self.buffers.as_ref();
        buffers.map_or(0, |buffers| buffers.stroke_list.len() as u32)
    }
}
