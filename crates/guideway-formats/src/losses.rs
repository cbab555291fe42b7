//! What a written file does not have of its layout.

use std::fmt;

use guideway_layout::{Attributes, Direction, Layout, PathRef};

/// Something of a layout that a written file does not have, or has otherwise.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Loss {
    /// What it is, such as `stations` or `column maxSpeed`.
    pub what: String,
    /// How many of them.
    pub count: u64,
    /// What of them is lost, or what stands for them.
    pub detail: String,
}

impl fmt::Display for Loss {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {}", self.count, self.detail)
    }
}

/// Everything that a written file does not have of its layout; empty if it has all.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Losses(Vec<Loss>);

impl Losses {
    /// All losses.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = &Loss> {
        self.0.iter()
    }

    /// Whether nothing is lost.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Notes a loss, if there is any of it.
    pub(crate) fn add(&mut self, what: impl Into<String>, count: usize, detail: impl Into<String>) {
        if count > 0 {
            self.0.push(Loss {
                what: what.into(),
                count: count as u64,
                detail: detail.into(),
            });
        }
    }

    /// What no format but this project's own model has room for, and what not even that has of the file that was read.
    pub(crate) fn of(layout: &Layout) -> Self {
        let mut losses = Self::of_model(layout, layout.refused.len());
        let detail = "layouts, nodes, edges and stations of LIF: what is said of them beside, such as actions and descriptions";
        losses.add("LIF", crate::lif::count_beside(layout), detail);
        losses
    }

    /// The same where the rest of the file is kept, but for so many of the paths that are refused.
    pub(crate) fn of_model(layout: &Layout, refused: usize) -> Self {
        let mut losses = Self::default();
        losses.add("refused paths", refused, "paths that cannot be drawn");
        let empty = layout.paths.iter().filter(|p| p.runs().len() == 0);
        losses.add("paths", empty.count(), "paths without a curve");
        losses
    }

    /// Notes the widths, for a format without.
    pub(crate) fn add_widths(&mut self, layout: &Layout) {
        let own = layout.paths.width_m().unwrap_or_default();
        let count = own.iter().filter(|w| w.is_finite()).count();
        self.add("widths", count, "widths of paths");
    }

    /// Notes the colors, for a format without.
    pub(crate) fn add_colors(&mut self, layout: &Layout) {
        let own = layout.paths.color_rgba().unwrap_or_default();
        let count = own.iter().filter(|&&c| c != 0).count();
        self.add("colors", count, "colors of paths");
    }

    /// Notes the draw ranks, for a format without.
    pub(crate) fn add_ranks(&mut self, layout: &Layout) {
        let count = layout.paths.rank().map_or(0, <[i32]>::len);
        self.add("draw ranks", count, "draw ranks of paths");
    }

    /// Notes the nodes and all that refers to them, for a format of curves alone.
    pub(crate) fn add_network(&mut self, layout: &Layout) {
        self.add("nodes", layout.nodes.len(), "nodes");
        self.add_stations(layout);
        let is_both = |p: &PathRef<'_>| p.direction() == Direction::Both;
        let both = layout.paths.iter().filter(is_both).count();
        self.add("directions", both, "two-way paths: which ways lead along");
        let types = layout.paths.vehicle_types();
        let limited = (0..layout.paths.len()).filter(|&row| types.of(row).len() > 0);
        let detail = "paths for certain vehicle types: for which";
        self.add("vehicle types", limited.count(), detail);
    }

    /// Notes the stations, for a format without.
    pub(crate) fn add_stations(&mut self, layout: &Layout) {
        self.add("stations", layout.stations.len(), "stations");
    }

    /// Notes the columns of a table that a format has no room for.
    pub(crate) fn add_columns(
        &mut self,
        attributes: &Attributes,
        of: &str,
        is_held: impl Fn(&str) -> bool,
    ) {
        for column in attributes.iter().filter(|c| !is_held(&c.name)) {
            let rows = 0..column.values.len();
            let values = rows.filter(|&row| column.values.get(row).is_some());
            let what = format!("column {}", column.name);
            self.add(what, values.count(), format!("values of {of}"));
        }
    }
}
