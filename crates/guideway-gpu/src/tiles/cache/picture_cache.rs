//! A cached picture: the view that the pixel buffer shows, and how to get from there to a view that
//! differs by whole pixels or by few edited clusters.

use guideway_scene::{Style, View};
use guideway_spline::Bounds;

use crate::tiles::constants::TILE_PX;
use crate::tiles::frame::context::FrameContext;
use crate::tiles::frame::tile_buffers::TileBuffers;
use crate::tiles::frame::window::Window;
use crate::tiles::layouts::{Cluster, ScrollParams};

/// Greatest distance of a scrolled picture from whole pixels, over all scrolls since it was drawn.
const MAX_DRIFT_PX: f64 = 1.0 / 256.0;
/// Part of the tiles that edits may touch, at most, where the others are reused: a half.
const MAX_DIRTY_PART: usize = 2;

/// Describes a finished picture in the pixel buffer.
#[derive(Clone, Copy, PartialEq)]
pub(crate) struct CachedPicture {
    /// The view that the picture was drawn for, before it was scrolled.
    drawn: View,
    /// The view that the picture shows.
    shown: View,
    style: Style,
    /// Scroll from `drawn` to `shown`.
    scrolled_px: [i32; 2],
    dirty: DirtyArea,
}

/// Bounds of changed clusters, and the greatest width of their paths; `None` without a cluster.
#[derive(Clone, Copy, Default, PartialEq)]
pub(crate) struct DirtyArea(Option<(Bounds<f64>, Option<f32>)>);

impl DirtyArea {
    /// Adds a cluster.
    pub(crate) fn add(&mut self, cluster: &Cluster) {
        self.join(Self(Some((cluster.bounds(), cluster.width_m()))));
    }

    /// Adds another area.
    pub(crate) fn join(&mut self, other: Self) {
        self.0 = match (self.0, other.0) {
            (Some((all, widest_m)), Some((bounds, width_m))) => {
                let widest_m = widest_m.into_iter().chain(width_m).reduce(f32::max);
                Some((all.union(bounds), widest_m))
            }
            (all, other) => all.or(other),
        };
    }
}

/// The steps from a cached picture to the next.
pub(crate) struct PictureReuse {
    /// The cache after these steps.
    pub(crate) picture: CachedPicture,
    /// `None` if the view is the same.
    pub(crate) scroll: Option<ScrollParams>,
    /// Tiles that came into view or were edited.
    pub(crate) windows: Vec<Window>,
}

impl CachedPicture {
    pub(crate) fn new(view: &View, style: &Style) -> Self {
        Self {
            drawn: *view,
            shown: *view,
            style: *style,
            scrolled_px: [0, 0],
            dirty: DirtyArea::default(),
        }
    }

    /// Marks what clusters showed, and what they show now.
    pub(crate) fn mark_dirty(&mut self, area: DirtyArea) {
        self.dirty.join(area);
    }

    /// Plans the reuse of the picture for another view. `None` if nothing can be reused.
    pub(crate) fn reuse_for(
        &self,
        frame: &FrameContext<'_>,
        tiles: &TileBuffers,
    ) -> Option<PictureReuse> {
        let (old, view, size) = (&self.drawn, frame.view, frame.view.size());
        let has_same_scale = old.px_per_m() == view.px_per_m() && old.size() == size;
        if !has_same_scale || self.style != *frame.style || !tiles.is_whole() {
            return None;
        }
        let all_tiles = [tiles.columns, tiles.rows];
        let dirty = self
            .dirty
            .0
            .map(|(bounds, widest_m)| frame.touched_tiles(bounds, widest_m, all_tiles));
        let max_dirty = tiles.columns as usize * tiles.rows as usize / MAX_DIRTY_PART;
        if dirty.as_ref().is_some_and(|w| w.tiles() > max_dirty) {
            return None;
        }
        let (scrolled_px, scroll) = if self.shown == *view {
            // Without an edit, the same view is drawn again.
            dirty.as_ref()?;
            (self.scrolled_px, None)
        } else {
            let scrolled_px = self.scroll_px(view)?;
            let [right_px, down_px] = [0, 1].map(|axis| scrolled_px[axis] - self.scrolled_px[axis]);
            let scroll = ScrollParams {
                width_px: size.width(),
                height_px: size.height(),
                right_px,
                down_px,
            };
            (scrolled_px, Some(scroll))
        };
        let mut windows = scroll.map_or(Vec::new(), |scroll| {
            uncovered_windows([scroll.right_px, scroll.down_px], tiles)
        });
        windows.extend(dirty.filter(|window| window.tiles() > 0));
        Some(PictureReuse {
            picture: Self {
                shown: *view,
                scrolled_px,
                dirty: DirtyArea::default(),
                ..*self
            },
            scroll,
            windows,
        })
    }

    /// Scroll from the drawn view to a view of the same scale. `None` if it is not by whole pixels,
    /// if it changes nothing, or if no pixel stays visible.
    fn scroll_px(&self, view: &View) -> Option<[i32; 2]> {
        let offset_px = (view.center_m() - self.drawn.center_m()) * view.px_per_m();
        // The picture's y points down.
        let offset_px = [offset_px.x, -offset_px.y];
        let whole_px = offset_px.map(f64::round);
        let drift_px = [0, 1].map(|axis| (offset_px[axis] - whole_px[axis]).abs());
        let size_px = [view.size().width(), view.size().height()].map(f64::from);
        let step_px = [0, 1].map(|axis| whole_px[axis] - f64::from(self.scrolled_px[axis]));
        let overlaps = [0, 1].iter().all(|&axis| {
            drift_px[axis] <= MAX_DRIFT_PX
                && step_px[axis].abs() < size_px[axis]
                && whole_px[axis].abs() < f64::from(i32::MAX)
        });
        (overlaps && step_px != [0.0, 0.0]).then(|| whole_px.map(|px| px as i32))
    }
}

/// Tiles that a scrolled picture does not cover: whole rows, and the columns of the other rows.
fn uncovered_windows([right_px, down_px]: [i32; 2], tiles: &TileBuffers) -> Vec<Window> {
    let uncovered = |step_px: i32, size_px: u32, tiles: u32| {
        let covered_px = size_px - step_px.unsigned_abs();
        match step_px {
            0 => 0..0,
            1.. => covered_px / TILE_PX..tiles,
            _ => 0..step_px.unsigned_abs().div_ceil(TILE_PX).min(tiles),
        }
    };
    let rows = uncovered(down_px, tiles.size.height(), tiles.rows);
    let columns = uncovered(right_px, tiles.size.width(), tiles.columns);
    let other_rows = if rows.is_empty() {
        0..tiles.rows
    } else if rows.start == 0 {
        rows.end..tiles.rows
    } else {
        0..rows.start
    };
    let whole_rows = Window {
        columns: 0..tiles.columns,
        rows,
    };
    let side = Window {
        columns,
        rows: other_rows,
    };
    let has_tiles = |window: &Window| window.tiles() > 0;
    [whole_rows, side].into_iter().filter(has_tiles).collect()
}
