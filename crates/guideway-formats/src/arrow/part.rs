//! [`Part`]: the record batches of a table that a read of an area needs.

use guideway_layout::Layout;
use guideway_spline::Bounds;

use super::column_names::PATHS_VERSION;
use super::container::{Container, Message};
use super::extents::Extent;
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
    /// A table of paths whose ranks may be missing is read whole: such ranks are numbers of paths.
    /// A network that states extents has all ranks, or none. A table without a batch in the area
    /// is read whole too: its part could not say where its paths are.
    pub(super) fn of(
        source: Source<'_>,
        input: &Input<'_>,
        container: &Container,
        columns: &ColumnRoles,
    ) -> Option<Self> {
        let area = source.options.area?;
        let batches = container.messages.iter();
        let batches = batches.filter_map(|message| Some((message, message.extent?)));
        let is_known = match columns.version {
            PATHS_VERSION => columns
                .get(Role::Rank)
                .is_none_or(|rank| !container.schema.field(rank).is_nullable()),
            // Elements refer to paths and nodes by number.
            _ => batches.clone().all(|(_, extent)| extent.begun.is_some()),
        };
        let has_paths = |extent: Extent| extent.begun.is_none_or(|[paths, _]| paths > 0);
        let meets_any = batches
            .clone()
            .any(|(_, extent)| has_paths(extent) && extent.meets(area));
        if !is_known || !meets_any {
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
