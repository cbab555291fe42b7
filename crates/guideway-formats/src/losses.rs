//! Losses of a conversion: the parts of a layout that a written file does not hold, with their
//! counts.

use std::borrow::Cow;
use std::fmt;

use guideway_layout::{Attributes, Layout, Value};

/// A part of a layout that a written file lacks or represents differently.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Loss {
    /// Name of the part, such as `stations` or `column maxSpeed`.
    pub what: String,
    /// Number of elements.
    pub count: u64,
    /// Description of the loss, or of the substitute in the file.
    pub detail: String,
}

impl fmt::Display for Loss {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {}", self.count, self.noun())
    }
}

impl Loss {
    /// The description after the count: with the noun in the singular for one element.
    pub fn noun(&self) -> Cow<'_, str> {
        // The noun is the first word that ends in s: `values of paths`, `one-way paths: ...`.
        let mut words = self
            .detail
            .split_inclusive(|c: char| !c.is_alphanumeric() && c != '-');
        let is_noun = |word: &&str| {
            let word = word.trim_end_matches(|c: char| !c.is_alphanumeric());
            word.ends_with('s') && !word.ends_with("ss")
        };
        let Some(noun) = words.find(is_noun).filter(|_| self.count == 1) else {
            return Cow::Borrowed(&self.detail);
        };
        let noun = noun.trim_end_matches(|c: char| !c.is_alphanumeric());
        let one = match noun.strip_suffix("ies") {
            Some(stem) => format!("{stem}y"),
            None => noun[..noun.len() - 1].to_owned(),
        };
        Cow::Owned(self.detail.replacen(noun, &one, 1))
    }
}

/// All losses of a conversion; empty if the file holds the whole layout.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Losses(Vec<Loss>);

impl Losses {
    /// Iterates over all losses.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = &Loss> {
        self.0.iter()
    }

    /// Returns whether nothing is lost.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Adds a loss, unless its count is zero.
    pub(crate) fn add(&mut self, what: impl Into<String>, count: usize, detail: impl Into<String>) {
        if count > 0 {
            self.0.push(Loss {
                what: what.into(),
                count: count as u64,
                detail: detail.into(),
            });
        }
    }

    /// Lists the paths that no format holds: those without a curve, and `refused` refused paths.
    pub(crate) fn of_paths(layout: &Layout, refused: usize) -> Self {
        let mut losses = Self::default();
        losses.add("refused paths", refused, "paths that cannot be drawn");
        let empty = layout.paths.iter().filter(|p| p.runs().len() == 0);
        losses.add("paths", empty.count(), "paths without a curve");
        losses
    }

    /// Adds the path widths, for a format without widths.
    pub(crate) fn add_widths(&mut self, layout: &Layout) {
        let widths = layout.paths.width_m().unwrap_or_default();
        let count = widths.iter().filter(|w| w.is_finite()).count();
        self.add("widths", count, "widths of paths");
    }

    /// Adds the path colors, for a format without colors.
    pub(crate) fn add_colors(&mut self, layout: &Layout) {
        let colors = layout.paths.color_rgba().unwrap_or_default();
        let count = colors.iter().filter(|&&c| c != 0).count();
        self.add("colors", count, "colors of paths");
    }

    /// Adds the draw ranks, for a format without draw ranks.
    pub(crate) fn add_ranks(&mut self, layout: &Layout) {
        let ranks = layout.paths.rank().unwrap_or_default();
        let count = ranks.iter().filter(|&&rank| rank != 0).count();
        self.add("draw ranks", count, "draw ranks of paths");
    }

    /// Adds the blocks, for a format without blocks.
    pub(crate) fn add_blocks(&mut self, layout: &Layout) {
        self.add("blocks", layout.blocks.len(), "blocks");
    }

    /// Adds the stations, for a format without stations.
    pub(crate) fn add_stations(&mut self, layout: &Layout) {
        self.add("stations", layout.stations.len(), "stations");
    }

    /// Adds the values of a column of paths that a reader of the file replaces. `written` is the
    /// value that it gets for a row.
    pub(crate) fn add_replaced<'a>(
        &mut self,
        layout: &Layout,
        name: &str,
        written: impl Fn(usize) -> Option<&'a str>,
    ) {
        let rows = 0..layout.paths.len();
        let changed = rows.filter(|&row| {
            let value = layout.paths.attributes.value(row, name);
            value.is_some() && value != written(row).map(Value::Text)
        });
        let detail = "values of paths: written in another form";
        self.add(format!("column {name}"), changed.count(), detail);
    }

    /// Adds the columns of a table that a format does not hold. `of` names the rows, such as
    /// `paths`.
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

/// The losses that a writer of all but the model itself starts its list with: refused paths and
/// paths without a curve.
pub(crate) fn common_losses(layout: &Layout) -> Losses {
    Losses::of_paths(layout, layout.refused.len())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_element_is_singular() {
        let said = |count, detail: &str| {
            let loss = Loss {
                what: String::new(),
                count,
                detail: detail.to_owned(),
            };
            loss.to_string()
        };
        for (detail, one) in [
            ("values of paths", "1 value of paths"),
            (
                "one-way paths: a drawing has no directions",
                "1 one-way path: a drawing has no directions",
            ),
            ("draw ranks of paths", "1 draw rank of paths"),
            ("properties of the layout", "1 property of the layout"),
            ("blocks", "1 block"),
            ("access", "1 access"),
        ] {
            assert_eq!(said(1, detail), one);
            assert_eq!(said(2, detail), format!("2 {detail}"));
        }
    }
}
