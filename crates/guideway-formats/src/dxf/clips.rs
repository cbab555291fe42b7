//! Clips: finds the references to blocks that a boundary clips (XCLIP), in the OBJECTS section.
//!
//! ```text
//! INSERT <-- owner -- dictionary <-- owner -- dictionary ACAD_FILTER <-- owner -- SPATIAL_FILTER
//! ```

use std::collections::{HashMap, HashSet};

use super::records::{Record, RecordReader};
use crate::Problem;

/// Owners between a boundary and the reference that it clips.
const OWNERS: usize = 3;

/// The boundaries that clip references to blocks.
#[derive(Default)]
pub(super) struct Clips<'b> {
    /// Handles of the references.
    clipped: HashSet<&'b [u8]>,
    /// Number of boundaries whose reference is not stated.
    pub(super) lost: u64,
}

impl<'b> Clips<'b> {
    /// Reads the OBJECTS section.
    ///
    /// # Errors
    /// When a pair is malformed, or a limit is exceeded.
    pub(super) fn read(
        &mut self,
        records: &mut RecordReader<'b>,
        record: &mut Record<'b>,
    ) -> Result<(), Problem> {
        let mut owners: HashMap<&[u8], &[u8]> = HashMap::new();
        let mut boundaries: Vec<&[u8]> = Vec::new();
        let wanted = |kind: &[u8], code| {
            let is_part = kind == b"DICTIONARY" || kind == b"SPATIAL_FILTER";
            is_part && matches!(code, 5 | 71 | 102 | 330)
        };
        while records.has_more_in_section() && records.read(record, wanted)? {
            let owner = owner(record).unwrap_or_default();
            match record.kind {
                b"DICTIONARY" => {
                    owners.insert(record.text(5).unwrap_or_default(), owner);
                }
                // Group code 71 switches the boundary off with 0.
                b"SPATIAL_FILTER" if record.int(71) != Some(0) => boundaries.push(owner),
                _ => {}
            }
        }
        for mut owner in boundaries {
            for _ in 1..OWNERS {
                owner = owners.get(owner).copied().unwrap_or_default();
            }
            match owner {
                b"" | b"0" => self.lost += 1,
                owner => {
                    self.clipped.insert(owner);
                }
            }
        }
        Ok(())
    }

    /// Returns whether a boundary clips the reference with this handle.
    pub(super) fn holds(&self, handle: &[u8]) -> bool {
        self.clipped.contains(handle)
    }
}

/// The handle of the owner of a record: the group code 330 outside of the lists in braces.
fn owner<'b>(record: &Record<'b>) -> Option<&'b [u8]> {
    let mut is_in_list = false;
    for pair in &record.pairs {
        match pair.code {
            102 => is_in_list = pair.text().starts_with(b"{"),
            330 if !is_in_list => return Some(pair.text().trim_ascii()),
            _ => {}
        }
    }
    None
}
