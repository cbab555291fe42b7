//! The outcome of a save, with the parts of the layout that the format cannot hold.

/// A part of a layout that a written file lacks, or holds in another form.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LostPart {
    /// Name of the part, such as `stations` or `column maxSpeed`.
    pub what: String,
    /// Number of elements.
    pub count: u64,
    /// Kind of the elements, such as `values of paths`.
    pub detail: String,
}

impl LostPart {
    /// Returns `true` if both are the same part, whatever their counts.
    pub(crate) fn is_same_part(&self, other: &Self) -> bool {
        self.what == other.what && self.detail == other.detail
    }
}

/// The outcome of [`AppServices::save_layout`](super::AppServices::save_layout).
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Saved {
    /// The file is written; it lacks these parts.
    Written(Vec<LostPart>),
    /// Nothing is written, as these losses were not accepted.
    TooLossy(Vec<LostPart>),
}
