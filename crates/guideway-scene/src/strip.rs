//! Strips: whole rows of a view, rendered one after the other for pictures larger than memory.

use std::ops::Range;

use guideway_spline::Point;

use crate::{FrameSize, RenderError, View};

/// Consecutive whole rows of a view.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Strip {
    view: View,
    first_row: u32,
    size: FrameSize,
}

impl Strip {
    /// Strips start at multiples of this many rows: a multiple of the tile size of every method.
    pub const STEP: u32 = 64;

    /// The strip that covers a whole view.
    pub fn whole(view: &View) -> Self {
        Self {
            view: *view,
            first_row: 0,
            size: view.size(),
        }
    }

    /// The strip that shows the world where `by_m` moves it.
    ///
    /// # Errors
    /// [`RenderError::View`] when the center of the view would be too far from the origin.
    pub fn with_world_moved(&self, by_m: Point<f64>) -> Result<Self, RenderError> {
        let view = &self.view;
        let view = View::new(view.size(), view.center_m() - by_m, view.px_per_m())?;
        Ok(Self { view, ..*self })
    }

    /// The whole view.
    pub fn view(&self) -> &View {
        &self.view
    }

    /// The rows it covers, counted from the top of the view.
    pub fn rows(&self) -> Range<u32> {
        self.first_row..self.first_row + self.size.height()
    }

    /// Size in pixels.
    pub fn size(&self) -> FrameSize {
        self.size
    }

    /// Returns `true` if it covers the whole view.
    pub fn is_whole(&self) -> bool {
        self.size == self.view.size()
    }
}

impl View {
    /// Splits the view into strips from the top. Each has at most `max_pixels` pixels, or
    /// [`Strip::STEP`] rows if those have more.
    pub fn strips(&self, max_pixels: usize) -> impl ExactSizeIterator<Item = Strip> + use<> {
        let view = *self;
        let (width, height) = (view.size().width(), view.size().height());
        let rows = (max_pixels / width as usize).min(height as usize) as u32;
        let rows = match rows < height {
            true => (rows / Strip::STEP).max(1) * Strip::STEP,
            false => height,
        };
        (0..height.div_ceil(rows)).map(move |number| Strip {
            view,
            first_row: number * rows,
            size: view.size().with_height(rows.min(height - number * rows)),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_moved_world_moves_the_picture() {
        let size = FrameSize::new(100, 200).unwrap();
        let view = View::new(size, Point::new(7.0, 3.0), 4.0).unwrap();
        let by_m = Point::new(10.0, -2.0);
        let at_m = Point::new(1.0, 5.0);
        for strip in view.strips(6_400) {
            let moved = strip.with_world_moved(by_m).unwrap();
            assert_eq!((moved.rows(), moved.size()), (strip.rows(), strip.size()));
            let there = view.pixel_from_world(at_m + by_m);
            assert_eq!(moved.view().pixel_from_world(at_m), there);
        }
        let far = Strip::whole(&view).with_world_moved(Point::new(2e12, 0.0));
        assert!(matches!(far, Err(RenderError::View { .. })));
    }

    #[test]
    fn strips_cover_the_view_within_the_pixel_limit() {
        for (width, height) in [(1, 1), (100, 64), (100, 200), (7, 65_535), (65_535, 129)] {
            let size = FrameSize::new(width, height).unwrap();
            let view = View::new(size, Point::new(0.0, 0.0), 1.0).unwrap();
            for max_pixels in [0, 1, 6_400, 12_900, 1 << 24, usize::MAX] {
                let mut next = 0;
                for strip in view.strips(max_pixels) {
                    let rows = strip.rows();
                    assert_eq!((rows.start, rows.start % Strip::STEP), (next, 0));
                    assert!(strip.size().pixels() <= max_pixels || rows.len() <= 64);
                    assert_eq!(strip.size().width(), width);
                    assert_eq!(strip.is_whole(), rows == (0..height));
                    next = rows.end;
                }
                assert_eq!(next, height);
            }
            assert!(view.strips(size.pixels()).eq([Strip::whole(&view)]));
        }
    }
}
