//! Most points are rounded to 16 bits. What is seen from so near that it would show gets exact ones.

use std::collections::BTreeSet;
use std::sync::Arc;

use guideway_render::{RenderError, Style, View};

use super::edit::Where;
use super::pack::most_step_m;
use super::params::Cluster;
use super::prepared::PreparedTiles;
use super::shot::Shot;

/// Farthest that a control point may be off for being rounded, in pixels along an axis.
const MOST_OFF_PX: f64 = 1.0 / 128.0;

/// Whether rounding to such steps would show in a view.
fn shows(step_m: f64, view: &View) -> bool {
    0.5 * step_m * view.px_per_m() > MOST_OFF_PX
}

impl PreparedTiles {
    /// Has exact points of what a view shows, where those that are there are too coarse for it. Nothing is drawn before.
    pub(super) fn come_near(&mut self, view: &View, style: &Style) -> Result<(), RenderError> {
        if self.is_torn {
            self.bring(most_step_m(&self.scene))?;
        }
        if !shows(self.facts.step_m, view) {
            return Ok(());
        }
        let rows: Vec<u32> = self.coarse_rows(view, style)?.into_iter().collect();
        if rows.is_empty() || self.send_curves(&rows, Where::Behind)?.is_some() {
            return Ok(());
        }
        // So much has been seen from near that little is saved any more.
        self.bring(0.0)
    }

    /// Paths that may be seen and whose points are too coarse.
    fn coarse_rows(&self, view: &View, style: &Style) -> Result<BTreeSet<u32>, RenderError> {
        let Some(store) = &self.store else {
            return Ok(BTreeSet::new());
        };
        let scene = Arc::clone(&self.scene);
        let shot = Shot::new(view, style, &scene, self.facts)?;
        let is_coarse_and_seen = |cluster: &&Cluster| {
            let width_m = (cluster.widest_m >= 0.0).then_some(cluster.widest_m);
            shows(f64::from(cluster.step_m), view) && shot.is_seen(cluster.bounds(), width_m)
        };
        let coarse = store.cluster_list.iter().filter(is_coarse_and_seen);
        let strokes = coarse.flat_map(|cluster| {
            let first = cluster.first_stroke as usize;
            &store.stroke_list[first..first + cluster.strokes as usize]
        });
        let drawn = strokes.filter(|stroke| stroke.is_drawn());
        Ok(drawn.map(|stroke| store.ranks.row(stroke.rank)).collect())
    }
}
