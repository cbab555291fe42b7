//! Counts of the colors and widths of paths, which edits keep up to date in time proportional to
//! the changed paths.

use guideway_layout::rows_ascend;
use rayon::prelude::*;

use super::model::{PathState, Scene};
use crate::color::Rgba;

/// Rows of a task.
const TASK_ROWS: usize = 1 << 13;

/// Counts of the styles of all paths.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StyleCensus {
    /// The color of some shown path; black without one.
    color: Rgba,
    counts: StyleCounts,
}

/// Counts of the styles of some paths.
#[derive(Clone, Copy, Debug, Default)]
struct StyleCounts {
    /// Paths with a translucent color, shown or not.
    translucent: usize,
    /// Shown paths with the color of the census.
    alike: usize,
    /// Shown paths with a width of their own.
    own_widths: usize,
    /// Greatest of these widths, in meters, and the number of shown paths that have it.
    widest: Option<(f32, usize)>,
}

impl StyleCensus {
    /// Looks at all paths.
    pub(super) fn of(scene: &Scene) -> Self {
        let rows = 0..scene.row_count() as u32;
        let is_shown = |row: &u32| scene.state(*row) == PathState::Shown;
        let first = rows.clone().find(is_shown);
        let color = first.map_or(Rgba::BLACK, |row| scene.color(row));
        let tasks = rows.into_par_iter().with_min_len(TASK_ROWS);
        let counts = tasks.fold(StyleCounts::default, |counts, row| {
            counts.with(scene, row, color)
        });
        Self {
            color,
            counts: counts.reduce(StyleCounts::default, StyleCounts::join),
        }
    }

    /// The color of all shown paths, of which there are `shown`.
    pub(super) fn common_color(&self, shown: usize) -> Option<Rgba> {
        match shown {
            0 => Some(Rgba::BLACK),
            _ => (self.counts.alike == shown).then_some(self.color),
        }
    }

    /// Greatest own width of the shown paths, in meters.
    pub(super) fn widest_m(&self) -> Option<f32> {
        self.counts.widest.map(|(width_m, _)| width_m)
    }

    /// Returns `true` if no path is translucent.
    pub(super) fn is_opaque(&self) -> bool {
        self.counts.translucent == 0
    }

    /// The census after some paths have changed. `None` if a look at all paths has to find it.
    fn after(&self, before: StyleCounts, after: StyleCounts) -> Option<Self> {
        let mut rest = StyleCounts {
            translucent: self.counts.translucent - before.translucent,
            alike: self.counts.alike - before.alike,
            own_widths: self.counts.own_widths - before.own_widths,
            widest: self.counts.widest,
        };
        if let (Some((widest_m, count)), Some((before_m, changed))) =
            (&mut rest.widest, before.widest)
            && *widest_m == before_m
        {
            *count -= changed;
        }
        let counts = rest.join(after);
        let lacks_widest = counts.own_widths > 0 && counts.widest.is_none_or(|(_, n)| n == 0);
        (counts.alike > 0 && !lacks_widest).then_some(Self {
            counts: StyleCounts {
                widest: counts.widest.filter(|_| counts.own_widths > 0),
                ..counts
            },
            ..*self
        })
    }
}

impl StyleCounts {
    /// Counts the paths of some items.
    fn of<I: Sync>(
        scene: &Scene,
        items: &[I],
        row: &(impl Fn(&I) -> u32 + Sync),
        color: Rgba,
    ) -> Self {
        let tasks = items.par_chunks(TASK_ROWS).map(|items| {
            let rows = items.iter().map(row);
            rows.fold(Self::default(), |counts, row| {
                counts.with(scene, row, color)
            })
        });
        tasks.reduce(Self::default, Self::join)
    }

    fn with(mut self, scene: &Scene, row: u32, color: Rgba) -> Self {
        let own = scene.color(row);
        self.translucent += usize::from(!own.is_opaque());
        if scene.state(row) == PathState::Shown {
            self.alike += usize::from(own == color);
            if let Some(width_m) = scene.width_m(row) {
                self.own_widths += 1;
                self.widest = wider(self.widest, Some((width_m, 1)));
            }
        }
        self
    }

    fn join(self, other: Self) -> Self {
        Self {
            translucent: self.translucent + other.translucent,
            alike: self.alike + other.alike,
            own_widths: self.own_widths + other.own_widths,
            widest: wider(self.widest, other.widest),
        }
    }
}

/// The greater of two widths, with the number of paths that have it.
fn wider(a: Option<(f32, usize)>, b: Option<(f32, usize)>) -> Option<(f32, usize)> {
    match (a, b) {
        (Some((a_m, n)), Some((b_m, m))) if a_m == b_m => Some((a_m, n + m)),
        (Some((a_m, _)), Some((b_m, _))) => {
            if a_m > b_m {
                a
            } else {
                b
            }
        }
        (a, b) => a.or(b),
    }
}

impl Scene {
    /// Runs a change of the styles or states of some paths, and updates the census.
    pub(crate) fn track_styles<I: Sync>(
        &mut self,
        items: &[I],
        row: &(impl Fn(&I) -> u32 + Sync),
        change: impl FnOnce(&mut Self),
    ) {
        let known = self.census.take();
        let known = known.filter(|_| rows_ascend(items, row));
        let before = known.map(|known| StyleCounts::of(self, items, row, known.color));
        change(self);
        if let (Some(known), Some(before)) = (known, before) {
            let after = StyleCounts::of(self, items, row, known.color);
            if let Some(census) = known.after(before, after) {
                self.census = census.into();
            }
        }
    }

    /// Adds new rows to the census.
    pub(super) fn count_new_styles(&mut self, new: &[u32]) {
        if let Some(known) = self.census.take() {
            let counts = StyleCounts::of(self, new, &|row| *row, known.color);
            if let Some(census) = known.after(StyleCounts::default(), counts) {
                self.census = census.into();
            }
        }
    }
}
