//! Follows moved curves in place.
//!
//! Input: an edit, and the edited scene. Output: new control points on the device, and trees
//! that fit them.

use guideway_grid::per_pixel::LocalScene;
use guideway_scene::{Edit, RenderError, Scene};

use crate::chunk::{BuiltChunk, Root};
use crate::pack::Place;
use crate::step::Builder;

/// Growth of a tree's cost by edits at which it is built again. Chosen: a walk then visits a third
/// more nodes than at first.
const WORN_OUT: f64 = 4.0 / 3.0;

/// Chunk, first control point and row of a moved path.
pub(super) type Moved = (u32, u32, u32);

/// The drawn paths that an edit moves, in ascending order; `None` if it does more than move them,
/// or not in place.
pub(super) fn moved_paths(scene: &Scene, edit: &Edit, places: &[Place]) -> Option<Vec<Moved>> {
    let (paths, curves) = match edit {
        Edit::Transform { paths, .. } => (paths, None),
        Edit::Reshape { paths, curves, .. } => (paths, Some(curves)),
        _ => return None,
    };
    let old = scene.layout().paths.geometry();
    let mut moved = Vec::with_capacity(paths.len());
    for (number, &path) in paths.iter().enumerate() {
        match places.get(path as usize)? {
            Place::At(chunk, first) => moved.push((*chunk, *first, path)),
            Place::Nowhere => {}
            Place::Split => return None,
        }
        if let Some(new) = curves {
            let has_curve = number < new.path_count();
            let old = old.runs(path as usize).map(|run| run.len());
            if !has_curve || !old.eq(new.runs(number).map(|run| run.len())) {
                return None;
            }
        }
    }
    moved.sort_unstable();
    Some(moved)
}

/// Moves control points of chunks.
pub(super) struct Mover<'a> {
    pub(super) builder: Builder<'a>,
    pub(super) local: &'a mut LocalScene,
    pub(super) chunks: &'a mut [BuiltChunk],
}

impl Mover<'_> {
    /// Uploads the control points of moved paths, in ascending order, and updates the trees of
    /// their chunks. Returns the bytes sent.
    ///
    /// # Errors
    /// When the device or the budget has too little memory, or the device fails.
    pub(super) fn move_points(
        &mut self,
        edited: &Scene,
        moved: &[Moved],
    ) -> Result<u64, RenderError> {
        let mut moved_bytes = 0;
        for of_chunk in moved.chunk_by(|a, b| a.0 == b.0) {
            let number = of_chunk[0].0 as usize;
            let mut adjacent: (u32, Vec<[f32; 2]>) = (0, Vec::new());
            for &(_, first, path) in of_chunk {
                if first != adjacent.0 + adjacent.1.len() as u32 {
                    moved_bytes += self.send(number, &adjacent)?;
                    adjacent = (first, Vec::new());
                }
                for run in edited.layout().paths.get(path as usize).runs() {
                    let start = adjacent.1.len();
                    let points = (0..run.len()).map(|point| run.get(point));
                    let local = points.map(|point| self.local.local_from_world(point));
                    adjacent.1.extend(local);
                    for segment in adjacent.1[start..].array_windows() {
                        self.local.include_segment(segment);
                    }
                }
            }
            moved_bytes += self.send(number, &adjacent)?;
            self.follow(number)?;
        }
        Ok(moved_bytes)
    }

    fn send(
        &self,
        chunk: usize,
        (first, points_m): &(u32, Vec<[f32; 2]>),
    ) -> Result<u64, RenderError> {
        if !points_m.is_empty() {
            let written = self.chunks[chunk]
                .0
                .write_points(self.builder.runner, *first, points_m);
            written.map_err(|error| self.builder.memory.device_error(&error))?;
        }
        Ok(size_of_val(points_m.as_slice()) as u64)
    }

    /// Fits the tree of a chunk to its moved points, or builds it anew once it is worn out.
    fn follow(&mut self, number: usize) -> Result<(), RenderError> {
        let root = Root::of(self.local, 0.0);
        let (chunk, built) = &mut self.chunks[number];
        self.builder.fit(chunk)?;
        let quality = self.builder.quality(chunk, false)?;
        if let (Some(now), Some(then)) = (quality, *built)
            && now.cost > WORN_OUT * then.cost
        {
            self.builder.rebuild(chunk, root)?;
            *built = self.builder.quality(chunk, true)?;
        }
        Ok(())
    }
}
