//! Counts of the colors and widths of paths, which edits keep up to date in time proportional to
//! the changed paths.

use rayon::prelude::*;

use crate::color::Rgba;

/// Rows of a task.
const TASK_ROWS: usize = 1 << 13;

/// The style and visibility of a path.
pub(super) struct PathAppearance {
    pub(super) color: Rgba,
    pub(super) width_m: Option<f32>,
    pub(super) is_shown: bool,
}

/// Counts of the styles of all paths.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StyleCensus {
    /// The color of some shown path; black without one.
    color: Rgba,
    counts: StyleCounts,
}

/// The least or greatest width, in meters, and the number of shown paths that have it.
type Extreme = Option<(f32, usize)>;

/// Counts of the styles of some paths.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct StyleCounts {
    /// Paths with a translucent color, shown or not.
    translucent: usize,
    /// Shown paths with the color of the census.
    alike: usize,
    /// Shown paths with a width of their own.
    own_widths: usize,
    /// Least and greatest of these widths.
    narrowest: Extreme,
    widest: Extreme,
}

impl StyleCensus {
    /// Looks at `rows` paths.
    pub(super) fn of(rows: usize, appearance: &(impl Fn(u32) -> PathAppearance + Sync)) -> Self {
        let rows = 0..rows as u32;
        let mut shown = rows.clone().map(appearance).filter(|path| path.is_shown);
        let color = shown.next().map_or(Rgba::BLACK, |path| path.color);
        let tasks = rows.into_par_iter().with_min_len(TASK_ROWS);
        let counts = tasks.fold(StyleCounts::default, |counts, row| {
            counts.with(appearance(row), color)
        });
        Self {
            color,
            counts: counts.reduce(StyleCounts::default, StyleCounts::join),
        }
    }

    /// Counts the paths of some items, for [`Self::after`].
    pub(super) fn counts_of<I: Sync>(
        &self,
        items: &[I],
        row: &(impl Fn(&I) -> u32 + Sync),
        appearance: &(impl Fn(u32) -> PathAppearance + Sync),
    ) -> StyleCounts {
        let of_task = |items: &[I]| {
            let rows = items.iter().map(row);
            rows.fold(StyleCounts::default(), |counts, row| {
                counts.with(appearance(row), self.color)
            })
        };
        if items.len() <= TASK_ROWS {
            return of_task(items);
        }
        let tasks = items.par_chunks(TASK_ROWS).map(of_task);
        tasks.reduce(StyleCounts::default, StyleCounts::join)
    }

    /// The color of all shown paths, of which there are `shown`.
    pub(super) fn common_color(&self, shown: usize) -> Option<Rgba> {
        match shown {
            0 => Some(Rgba::BLACK),
            _ => (self.counts.alike == shown).then_some(self.color),
        }
    }

    /// Least and greatest own width of the shown paths, in meters.
    pub(super) fn own_widths_m(&self) -> Option<(f32, f32)> {
        let StyleCounts {
            narrowest, widest, ..
        } = self.counts;
        Some((narrowest?.0, widest?.0))
    }

    /// Returns `true` if no path is translucent.
    pub(super) fn is_opaque(&self) -> bool {
        self.counts.translucent == 0
    }

    /// The census after some paths have changed. `None` if a look at all paths has to find it.
    pub(super) fn after(&self, before: StyleCounts, after: StyleCounts) -> Option<Self> {
        let rest = StyleCounts {
            translucent: self.counts.translucent - before.translucent,
            alike: self.counts.alike - before.alike,
            own_widths: self.counts.own_widths - before.own_widths,
            narrowest: without(self.counts.narrowest, before.narrowest),
            widest: without(self.counts.widest, before.widest),
        };
        let counts = rest.join(after);
        let has_widths = counts.own_widths > 0;
        let lacks = |width: Extreme| has_widths && width.is_none_or(|(_, paths)| paths == 0);
        let is_known = counts.alike > 0 && !lacks(counts.narrowest) && !lacks(counts.widest);
        is_known.then_some(Self {
            counts: StyleCounts {
                narrowest: counts.narrowest.filter(|_| has_widths),
                widest: counts.widest.filter(|_| has_widths),
                ..counts
            },
            ..*self
        })
    }
}

impl StyleCounts {
    fn with(mut self, path: PathAppearance, color: Rgba) -> Self {
        self.translucent += usize::from(!path.color.is_opaque());
        if path.is_shown {
            self.alike += usize::from(path.color == color);
            if let Some(width_m) = path.width_m {
                self.own_widths += 1;
                let own = Some((width_m, 1));
                self.narrowest = extreme(self.narrowest, own, |a, b| a < b);
                self.widest = extreme(self.widest, own, |a, b| a > b);
            }
        }
        self
    }

    fn join(self, other: Self) -> Self {
        Self {
            translucent: self.translucent + other.translucent,
            alike: self.alike + other.alike,
            own_widths: self.own_widths + other.own_widths,
            narrowest: extreme(self.narrowest, other.narrowest, |a, b| a < b),
            widest: extreme(self.widest, other.widest, |a, b| a > b),
        }
    }
}

/// The extreme of two, where `is_beyond` tells the greater one from the less.
fn extreme(a: Extreme, b: Extreme, is_beyond: impl Fn(f32, f32) -> bool) -> Extreme {
    match (a, b) {
        (Some((a_m, n)), Some((b_m, m))) if a_m == b_m => Some((a_m, n + m)),
        (Some((a_m, _)), Some((b_m, _))) => {
            let is_a = is_beyond(a_m, b_m);
            if is_a { a } else { b }
        }
        (a, b) => a.or(b),
    }
}

/// An extreme without the paths that had it before an edit.
fn without(all: Extreme, before: Extreme) -> Extreme {
    let changed = before.filter(|(before_m, _)| all.is_some_and(|(all_m, _)| all_m == *before_m));
    let changed = changed.map_or(0, |(_, paths)| paths);
    all.map(|(width_m, paths)| (width_m, paths - changed))
}
