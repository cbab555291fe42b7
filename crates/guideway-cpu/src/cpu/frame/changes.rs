//! Changes of a prepared scene: edits, colors and gestures. Caches forget what they show.

use std::sync::Arc;

use guideway_scene::cluster::PendingEdit;
use guideway_scene::{Coloring, Edit, EditOutcome, Gesture, GesturePaths, RenderError};
use guideway_spline::Bounds;

use super::clusters::{PreparedClusters, StyleSummary};
use super::memory::{fixed_bytes, over_budget};
use super::state::{CpuPrepared, install};
use crate::cpu::ground::gesture::ShownGesture;
use crate::cpu::raster::resting_coverage::RestingCoverage;

impl CpuPrepared {
    /// Applies an edit to the scene, and updates the clusters and the caches.
    pub(super) fn apply_edit(&mut self, edit: &Edit) -> Result<EditOutcome, RenderError> {
        self.end_gesture();
        let Self {
            scene,
            budget,
            pool,
            clusters,
            picture,
            full_pixels,
            tones,
            ..
        } = self;
        let begin = |paths: &[u32]| -> Vec<PendingEdit> {
            // The scene rejects an edit of paths that it does not have.
            let last = paths.iter().copied().max();
            if last.is_some_and(|path| path as usize >= scene.row_count()) {
                return Vec::new();
            }
            install(pool.as_ref(), || clusters.begin_edit(scene, paths))
        };
        let pending = match edit {
            Edit::Transform { paths, .. } | Edit::Reshape { paths, .. } => begin(paths),
            Edit::SetStates(_) => begin(&edit.paths().collect::<Vec<u32>>()),
            Edit::Restyle(_) | Edit::Insert(_) | Edit::Tables(_) => Vec::new(),
        };
        let scene_now = Arc::make_mut(scene);
        install(pool.as_ref(), || scene_now.edit(edit)).map_err(RenderError::Edit)?;
        if matches!(edit, Edit::Tables(_)) {
            return Ok(EditOutcome::InPlace { moved_bytes: 0 });
        }
        *tones = None;
        full_pixels.forget();
        let fixed = fixed_bytes(scene, budget);
        if fixed > budget.memory_bytes {
            return Err(over_budget("the index of the paths", fixed, budget));
        }
        let before = (clusters.style.solid, clusters.style.own_widths);
        let changes = install(pool.as_ref(), || {
            if !matches!(edit, Edit::Transform { .. } | Edit::Reshape { .. }) {
                clusters.style = StyleSummary::of(scene);
            }
            match edit {
                Edit::Transform { by, .. } => clusters.apply_edit(scene, &pending, Some(*by)),
                Edit::Reshape { .. } | Edit::SetStates(_) => {
                    clusters.apply_edit(scene, &pending, None)
                }
                Edit::Restyle(_) => clusters.bounds_of(&edit.paths().collect::<Vec<_>>()),
                Edit::Insert(_) => clusters.append(scene),
                Edit::Tables(_) => Vec::new(),
            }
        });
        if let Some(picture) = picture {
            // One color is drawn by another rasterizer than several.
            if before == (clusters.style.solid, clusters.style.own_widths) {
                picture.add_changes(&changes);
            } else {
                picture.forget();
            }
        }
        Ok(EditOutcome::InPlace { moved_bytes: 0 })
    }

    /// Takes other colors, if they suit the scene.
    pub(super) fn take_colors(&mut self, coloring: &Coloring) -> EditOutcome {
        if !self.scene.accepts(coloring) {
            return EditOutcome::NotInPlace;
        }
        self.end_gesture();
        let scene = Arc::make_mut(&mut self.scene);
        self.clusters.style = install(self.pool.as_ref(), || {
            scene.recolor(coloring);
            StyleSummary::of(scene)
        });
        self.full_pixels.forget();
        if let Some(picture) = &mut self.picture {
            picture.forget();
        }
        EditOutcome::InPlace { moved_bytes: 0 }
    }

    /// Shows a gesture, or the scene without one.
    pub(super) fn map_gesture(
        &mut self,
        gesture: Option<&Gesture>,
    ) -> Result<EditOutcome, RenderError> {
        let shown = self.gesture.as_ref();
        let is_shown =
            gesture.is_some_and(|new| shown.is_some_and(|shown| shown.paths.are_of(new)));
        if !is_shown {
            self.end_gesture();
        }
        if let Some(gesture) = gesture {
            let shown = match self.gesture.take() {
                Some(shown) => shown,
                None => self.begin_gesture(gesture)?,
            };
            let checked = shown.paths.check(gesture.by);
            let shown = self.gesture.insert(shown);
            if let Err(error) = checked {
                self.end_gesture();
                return Err(RenderError::Edit(error));
            }
            let clusters = &mut self.clusters;
            let changes = install(self.pool.as_ref(), || {
                clusters.map_gesture(shown, gesture.by)
            });
            self.take_changes(&changes);
        }
        Ok(EditOutcome::InPlace { moved_bytes: 0 })
    }

    /// Splits the paths of a gesture off from others.
    fn begin_gesture(&mut self, gesture: &Gesture) -> Result<ShownGesture, RenderError> {
        let scene = &*self.scene;
        let paths = GesturePaths::begin(scene, gesture).map_err(RenderError::Edit)?;
        // At most, each path gets into a cluster of the gesture.
        let copies = PreparedClusters::planned_bytes(gesture.paths.len());
        let needed = fixed_bytes(scene, &self.budget) + copies + scene.row_count() as u64;
        if needed > self.budget.memory_bytes {
            return Err(over_budget(
                "the paths of the gesture",
                needed,
                &self.budget,
            ));
        }
        let clusters = &mut self.clusters;
        let begin = || clusters.begin_gesture(scene, paths, &gesture.paths);
        let shown = install(self.pool.as_ref(), begin);
        self.take_changes(&self.clusters.boxes_of(&shown.thinned));
        Ok(shown)
    }

    /// Shows the scene without a gesture.
    fn end_gesture(&mut self) {
        if let Some(gesture) = self.gesture.take() {
            let clusters = &mut self.clusters;
            let changes = install(self.pool.as_ref(), || clusters.end_gesture(gesture));
            self.take_changes(&changes);
            self.resting = RestingCoverage::default();
        }
    }

    /// Forgets what the caches have of places where paths were or are.
    fn take_changes(&mut self, changes: &[Bounds<f64>]) {
        if changes.is_empty() {
            return;
        }
        self.tones = None;
        self.full_pixels.forget();
        if let Some(picture) = &mut self.picture {
            picture.add_changes(changes);
        }
    }
}
