//! Counts records by kind, in file order, for the provenance of a layout.

/// Kinds counted by name; the rest share one counter, which bounds the counts of a hostile file.
const MAX_KINDS: usize = 64;

/// Number of records per kind, in file order.
#[derive(Default)]
pub(super) struct EntityCounts(pub(super) Vec<(String, u64)>);

impl EntityCounts {
    /// Counts a record. Not for the VERTEX records of a POLYLINE: see [`Self::count`].
    pub(super) fn add(&mut self, kind: &[u8]) {
        match kind {
            b"SEQEND" => {}
            b"VERTEX" => self.count("VERTEX without POLYLINE"),
            _ => {
                let name: String = String::from_utf8_lossy(kind).chars().take(32).collect();
                self.count(&name);
            }
        }
    }

    /// Counts one record under a name.
    pub(super) fn count(&mut self, name: &str) {
        let name = match self.0.len() {
            MAX_KINDS.. if self.0.iter().all(|(known, _)| known != name) => "others",
            _ => name,
        };
        match self.0.iter_mut().find(|(known, _)| known == name) {
            Some((_, count)) => *count += 1,
            None => self.0.push((name.to_owned(), 1)),
        }
    }
}
