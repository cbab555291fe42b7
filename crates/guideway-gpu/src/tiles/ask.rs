//! Which paths are where: under each pixel of a small view, or anywhere in it.

use guideway_scene::{Cancel, NO_PATH, RenderError, Style, View};
use wgpu::BufferUsages;

use super::draw::Drawing;
use super::paint::Paint;
use super::prepared::PreparedTiles;
use super::shot::Shot;
use super::window::Window;
use crate::device::FETCHED;

/// Strokes that there is room for at first.
const FIRST_STROKES: u32 = 4096;

impl PreparedTiles {
    /// See [`guideway_scene::Prepared::top_paths`].
    pub(super) fn tops(
        &mut self,
        view: &View,
        style: &Style,
        cancel: &Cancel,
    ) -> Result<Vec<u32>, RenderError> {
        self.mend()?;
        let mut tops = vec![0; view.size().pixels()];
        self.probing(view, style, |tiles, shot| {
            tiles.draw_all(shot, Paint::Ids, cancel, |pixels, bytes| {
                for (top, word) in tops[pixels].iter_mut().zip(bytes.as_chunks().0) {
                    *top = u32::from_le_bytes(*word);
                }
            })?;
            Ok(())
        })?;
        let path_of = |top: u32| {
            let store = self.store.as_ref();
            let rank = top.checked_sub(1);
            rank.zip(store)
                .map_or(NO_PATH, |(rank, store)| store.ranks.row(rank))
        };
        Ok(tops.into_iter().map(path_of).collect())
    }

    /// See [`guideway_scene::Prepared::paths_in`].
    pub(super) fn touching(
        &mut self,
        view: &View,
        style: &Style,
        cancel: &Cancel,
    ) -> Result<Vec<u32>, RenderError> {
        self.mend()?;
        let Some(store) = &self.store else {
            return Ok(Vec::new());
        };
        let words = store.ranks.count(&self.scene).div_ceil(32).max(1);
        let bytes = (words * size_of::<u32>()) as u64;
        let usage = BufferUsages::STORAGE | BufferUsages::COPY_SRC;
        let what = "marks of paths";
        self.marks = Some(self.memory.zeros(what, bytes, usage)?);
        let marked = self.probing(view, style, |tiles, shot| {
            // What was bound before had other marks.
            tiles.easel.bound = None;
            let all = tiles.easel.canvas.iter().map(|canvas| Window {
                columns: 0..canvas.columns,
                rows: 0..canvas.rows,
            });
            let mut drawing = Drawing::default();
            let drawn =
                tiles.draw_windows(shot, Paint::Touch, all.collect(), 0, cancel, &mut drawing);
            tiles.easel.bound = None;
            drawn
        });
        let marks = self.marks.take();
        marked?;
        let fetched = self.memory.zeros(what, bytes, FETCHED)?;
        let mut paths = Vec::new();
        if let (Some(marks), Some(store)) = (marks, &self.store) {
            let taken = self.runner.fetch(what, &marks, &fetched, bytes, |bytes| {
                for (word, first) in bytes.as_chunks().0.iter().zip((0..).step_by(32)) {
                    let word = u32::from_le_bytes(*word);
                    let marked = (0..32).filter(|bit| word >> bit & 1 != 0);
                    paths.extend(marked.map(|bit| store.ranks.row(first + bit)));
                }
            });
            taken.map_err(|what| self.memory.trouble(what))?;
        }
        paths.sort_unstable();
        Ok(paths)
    }

    /// Does something with the easel for questions in place of that of pictures.
    fn probing(
        &mut self,
        view: &View,
        style: &Style,
        work: impl FnOnce(&mut Self, &Shot<'_>) -> Result<(), RenderError>,
    ) -> Result<(), RenderError> {
        if self.store.is_none() {
            return Ok(());
        }
        let scene = std::sync::Arc::clone(&self.scene);
        let shot = Shot::new(view, style, &scene, self.facts)?;
        std::mem::swap(&mut self.easel, &mut self.probe);
        let done = self
            .make_ready(view, FIRST_STROKES, true)
            .and_then(|()| work(self, &shot));
        std::mem::swap(&mut self.easel, &mut self.probe);
        done
    }
}
