//! Finds crowds: pictures in which the number of paths per pixel says more than their colors.

use std::ops::Range;
use std::sync::Arc;

use guideway_formats::Progress;
use guideway_scene::{Cancel, Frame, FrameSize, Method, RenderError, Report, Rgba, Shading, Style};

use crate::{ComposeError, Picture};

/// Least number of paths that are a crowd.
const MANY_PATHS: u64 = 10_000;

/// Pixels of a picture that show more than the background.
#[derive(Default)]
pub(crate) struct Covered {
    pixels: u64,
    /// The box around them; `None` without any.
    columns: Option<Range<usize>>,
    rows: Option<Range<usize>>,
    /// Rows that were looked at.
    seen: usize,
}

impl Covered {
    /// Adds the next rows of the picture.
    pub(crate) fn add(&mut self, frame: &Frame, background: Rgba) {
        let bare = background.to_u32().to_be_bytes();
        let width = frame.size().width() as usize;
        for row in frame.pixels().chunks_exact(width) {
            let is_covered = |pixel: &[u8; 4]| *pixel != bare;
            if let Some(first) = row.iter().position(is_covered) {
                let last = row.iter().rposition(is_covered).unwrap_or(first);
                let pixels = row[first..=last].iter().filter(|pixel| is_covered(pixel));
                self.pixels += pixels.count() as u64;
                widen(&mut self.columns, first..last + 1);
                widen(&mut self.rows, self.seen..self.seen + 1);
            }
            self.seen += 1;
        }
    }

    /// Returns `true` if this many paths are a crowd: they cover more than half of the box around
    /// them.
    fn is_crowd(&self, paths: u64) -> bool {
        let sides = [&self.columns, &self.rows].map(|range| range.as_ref().map_or(0, Range::len));
        paths >= MANY_PATHS && self.pixels * 2 > sides[0] as u64 * sides[1] as u64
    }

    /// Suggests density shading for a crowd.
    pub(crate) fn density_hint(&self, report: &Report, style: &Style) -> Option<String> {
        let is_crowd = self.is_crowd(report.drawn) && style.shading == Shading::Color;
        let note = "paths cover most of the picture; `--shade density` shows how many overlap";
        is_crowd.then(|| note.to_owned())
    }
}

/// Extends a range by another one.
fn widen(range: &mut Option<Range<usize>>, by: Range<usize>) {
    *range = Some(match range.take() {
        Some(range) => range.start.min(by.start)..range.end.max(by.end),
        None => by,
    });
}

impl Picture {
    /// Returns `true` if many paths cover more than half of the box around them, so that their
    /// density says more than their colors. Renders the paths alone, if there are many.
    ///
    /// # Errors
    /// See [`Picture::render`].
    pub fn is_crowded(
        &self,
        method: &dyn Method,
        progress: &dyn Progress,
    ) -> Result<bool, ComposeError> {
        if (self.scene.draw_order().len() as u64) < MANY_PATHS {
            return Ok(false);
        }
        let style = Style {
            shading: Shading::Color,
            ..self.style
        };
        let view = self.view()?;
        let mut prepared = method.prepare(Arc::clone(&self.scene), &self.budget)?;
        let mut frame = Frame::new(FrameSize::new(1, 1)?);
        let (mut drawn, mut covered) = (0, Covered::default());
        for strip in view.strips(prepared.strip_pixels()) {
            if progress.cancelled() {
                return Err(RenderError::Cancelled.into());
            }
            let report = prepared.render_strip(&strip, &style, &Cancel::default(), &mut frame)?;
            drawn += report.drawn;
            covered.add(&frame, style.background);
        }
        Ok(covered.is_crowd(drawn))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Covered pixels of a picture of 20 rows in two parts.
    fn covered(is_covered: impl Fn(usize, usize) -> bool) -> Covered {
        let mut covered = Covered::default();
        for first in [0, 10] {
            let mut frame = Frame::new(FrameSize::new(20, 10).unwrap());
            for (i, pixel) in frame.pixels_mut().iter_mut().enumerate() {
                let is_covered = is_covered(i % 20, first + i / 20);
                *pixel = if is_covered { [0, 0, 0, 255] } else { [255; 4] };
            }
            covered.add(&frame, Rgba::WHITE);
        }
        covered
    }

    #[test]
    fn a_crowd_covers_more_than_half_of_the_box_around_it() {
        let is_inside = |x: usize, y: usize| (4..14).contains(&x) && (8..13).contains(&y);
        let block = covered(is_inside);
        assert!(block.is_crowd(MANY_PATHS), "margins do not count");
        assert!(!block.is_crowd(MANY_PATHS - 1));
        let sparse = covered(|x, y| is_inside(x, y) && (x + y) % 2 == 0);
        assert!(!sparse.is_crowd(MANY_PATHS));
        assert!(!covered(|_, _| false).is_crowd(MANY_PATHS));
    }
}
