//! [`Part`]: the record batches of a table that a read of an area needs.

use guideway_layout::Layout;
use guideway_spline::Bounds;

use super::column_names::PATHS_VERSION;
use super::container::{Container, Message};
use super::schema::{ColumnRoles, Role};
use crate::input::Input;
use crate::source::{BYTES_READ, FILE_BYTES, Source};

/// A read of the record batches in an area only.
pub(super) struct Part {
    area: Bounds<f64>,
    bytes: u64,
    bytes_read: u64,
}

impl Part {
    /// The part of a table that a read needs; `None` for all of it.
    ///
    /// A table with elements beside the paths is read whole, because they refer to paths by number,
    /// and so is one whose ranks may be missing: they are numbers of paths too. So is one without a
    /// batch in the area, which could not say where its paths are.
    pub(super) fn of(
        source: Source<'_>,
        input: &Input<'_>,
        container: &Container,
        columns: &ColumnRoles,
    ) -> Option<Self> {
        let area = source.options.area?;
        let has_ranks = columns
            .get(Role::Rank)
            .is_none_or(|rank| !container.schema.field(rank).is_nullable());
        let batches = container.messages.iter();
        let batches = batches.filter_map(|message| Some((message, message.extent?)));
        let meets_any = batches.clone().any(|(_, extent)| extent.meets(area));
        if columns.version != PATHS_VERSION || !has_ranks || !meets_any {
            return None;
        }
        let beyond = batches.filter(|(_, extent)| !extent.meets(area));
        let skipped: u64 = beyond.map(|(message, _)| message.bytes()).sum();
        let bytes = input.len() as u64;
        (skipped > 0).then_some(Self {
            area,
            bytes,
            bytes_read: bytes.saturating_sub(skipped),
        })
    }

    /// Returns `true` if a message is a record batch beyond the area.
    pub(super) fn skips(&self, message: &Message) -> bool {
        message
            .extent
            .is_some_and(|extent| !extent.meets(self.area))
    }

    /// Adds what was read to the provenance of the layout.
    pub(super) fn count(&self, layout: &mut Layout) {
        let counts = [(BYTES_READ, self.bytes_read), (FILE_BYTES, self.bytes)];
        let counts = counts.map(|(name, count)| (name.to_owned(), count));
        layout.provenance.counts.extend(counts);
    }
}
