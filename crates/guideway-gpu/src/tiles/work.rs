//! What a frame takes, counted by shaders of its own.

use std::sync::Arc;

use guideway_scene::{Cancel, RenderError, Shading, Style, View, Work};

use super::params::Found;
use super::prepared::PreparedTiles;
use super::shot::Shot;

/// Sums over the windows of a picture.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Counted {
    tests: u64,
    atomics: u64,
    words_read: u64,
    words_written: u64,
}

impl Counted {
    /// Adds what a window took.
    pub(super) fn add(&mut self, found: &Found) {
        let of_device =
            |i: usize| u64::from(found.work[2 * i]) | u64::from(found.work[2 * i + 1]) << 32;
        self.tests += of_device(0);
        self.atomics += of_device(1);
        self.words_read += of_device(2);
        self.words_written += of_device(3);
    }
}

impl PreparedTiles {
    /// Counts the work of a frame with nothing kept. That of density is not counted.
    pub(super) fn counted(
        &mut self,
        view: &View,
        style: &Style,
        cancel: &Cancel,
    ) -> Result<Work, RenderError> {
        self.mend()?;
        let paint = self.facts.paint;
        if style.shading != Shading::Color || self.store.is_none() {
            return Ok(Work::default());
        }
        let counting = self
            .shared
            .counting_kernels
            .get_or_init(|| self.shared.kernels.counting(&self.shared.gpu).map(Arc::new));
        let counting = match counting {
            Ok(kernels) => Arc::clone(kernels),
            Err(what) => return Err(self.memory.trouble(what.clone())),
        };
        let scene = Arc::clone(&self.scene);
        let shot = Shot::new(view, style, &scene, self.facts)?;
        let strokes = self
            .store
            .as_ref()
            .map_or(0, |s| s.stroke_list.len() as u32);
        self.make_ready(view, strokes, shot.needs_ranks(paint))?;
        self.easel.kept = None;
        self.easel.unbind();
        let own = std::mem::replace(&mut self.kernels, counting);
        let keeps = std::mem::replace(&mut self.easel.keeps, false);
        // The first one learns what the view shows few of, as the last frame of another may not have.
        let drawn = self
            .draw_all(&shot, paint, cancel, |_, _| ())
            .and_then(|_| self.draw_all(&shot, paint, cancel, |_, _| ()));
        self.kernels = own;
        self.easel.keeps = keeps;
        self.easel.unbind();
        let counted = drawn?.work;
        let bytes = |words: u64| Some(words * size_of::<u32>() as u64);
        Ok(Work {
            tests: Some(counted.tests),
            atomics: Some(counted.atomics),
            bytes_read: bytes(counted.words_read),
            bytes_written: bytes(counted.words_written),
        })
    }
}
