//! Lines of findings: finds the place of their elements in the text of the file, when they are
//! reported.

use std::cell::OnceCell;

use crate::{Diagnostics, Layout, LineIndex, Member, Origin};

/// Format of files that are tables, not texts.
const TABLE_FORMAT: &str = "Arrow";

impl Layout {
    /// Sets line and column of each finding about an element of this layout; in a layout from a
    /// file that is no text, the row in its table. Without such findings, it does not scan the
    /// text.
    pub fn locate(&self, found: &mut Diagnostics) {
        let lines = OnceCell::new();
        let kept = self.provenance.text.as_deref();
        let lines = || kept.map(|text| lines.get_or_init(|| LineIndex::new(text)));
        // Refused rows are not in the tables, so they would shift the count.
        let is_table = self.provenance.format == TABLE_FORMAT && self.refused.is_empty();
        for finding in found.iter_mut() {
            let place = &mut finding.place;
            let Some(Origin::Member(member)) = place.origin.filter(|_| place.line.is_none()) else {
                continue;
            };
            let (source, row) = match member {
                Member::Path(row) => (&self.paths.source, row),
                Member::Node(row) => (&self.nodes.source, row),
                Member::Station(row) => (&self.stations.source, row),
            };
            if let Some(position) = source.position(row as usize, lines()) {
                *place = std::mem::take(place).at(position);
            } else if is_table {
                place.row = Some(row + 1);
            }
        }
    }
}
