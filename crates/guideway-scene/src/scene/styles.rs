//! Colors and widths that shown paths have in common, by a census that edits keep up to date.

use guideway_layout::rows_ascend;

use super::census::{PathAppearance, StyleCensus, StyleCounts};
use super::coloring::Colors;
use super::error::NoOpaqueColor;
use super::model::Scene;
use super::path_state::PathState;
use crate::color::Rgba;

impl Scene {
    /// Returns `true` if all shown paths have one color, and none a width of its own.
    pub fn is_plain(&self) -> bool {
        self.common_color().is_some() && self.widest_m().is_none()
    }

    /// The opaque color shared by all shown paths; black without paths.
    ///
    /// # Errors
    /// When paths differ in color or are translucent.
    pub fn opaque_color(&self) -> Result<Rgba, NoOpaqueColor> {
        match self.common_color() {
            None => Err(NoOpaqueColor::Several),
            Some(color) if !color.is_opaque() => Err(NoOpaqueColor::Translucent),
            Some(color) => Ok(color),
        }
    }

    /// The color shared by all shown paths, if there is one; black without paths.
    pub fn common_color(&self) -> Option<Rgba> {
        match &self.coloring.colors {
            Colors::One(_) if self.shown_count == 0 => Some(Rgba::BLACK),
            Colors::One(color) => Some(*color),
            Colors::Each(_) => self.census().common_color(self.shown_count),
        }
    }

    /// Least and greatest own width of the shown paths, in meters; `None` if none has its own.
    pub fn own_widths_m(&self) -> Option<(f32, f32)> {
        self.layout.paths.width_m()?;
        self.census().own_widths_m()
    }

    /// Greatest own width of the shown paths, in meters; `None` if none has its own.
    pub fn widest_m(&self) -> Option<f32> {
        self.own_widths_m().map(|(_, widest_m)| widest_m)
    }

    /// Returns `true` if all paths are opaque.
    pub fn is_opaque(&self) -> bool {
        match &self.coloring.colors {
            Colors::One(color) => color.is_opaque(),
            Colors::Each(_) => self.census().is_opaque(),
        }
    }

    /// The style and visibility of a path.
    fn appearance(&self, path: u32) -> PathAppearance {
        PathAppearance {
            color: self.color(path),
            width_m: self.width_m(path),
            is_shown: self.state(path) == PathState::Shown,
        }
    }

    /// Counts of styles. The first call after edits that leave it unknown looks at all paths.
    fn census(&self) -> &StyleCensus {
        self.census
            .get_or_init(|| StyleCensus::of(self.row_count(), &|row| self.appearance(row)))
    }

    /// Runs a change of the styles or states of some paths, and updates the census.
    pub(crate) fn track_styles<I: Sync>(
        &mut self,
        items: &[I],
        row: &(impl Fn(&I) -> u32 + Sync),
        change: impl FnOnce(&mut Self),
    ) {
        let known = self.census.take();
        let known = known.filter(|_| rows_ascend(items, row));
        let before = known.map(|known| known.counts_of(items, row, &|path| self.appearance(path)));
        change(self);
        if let (Some(known), Some(before)) = (known, before) {
            let after = known.counts_of(items, row, &|path| self.appearance(path));
            if let Some(census) = known.after(before, after) {
                self.census = census.into();
            }
        }
    }

    /// Adds new rows to the census.
    pub(super) fn count_new_styles(&mut self, new: &[u32]) {
        if let Some(known) = self.census.take() {
            let counts = known.counts_of(new, &|row| *row, &|path| self.appearance(path));
            if let Some(census) = known.after(StyleCounts::default(), counts) {
                self.census = census.into();
            }
        }
    }
}
