//! Versions of LIF, and the choice between the names of both.

use guideway_layout::Layout;

/// A version of LIF.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Version {
    /// LIF 1.0.0 of 2023.
    V1,
    /// LIF 2.0.0 of 2026.
    V2,
}

impl Version {
    /// Returns the version of the file that a layout was read from, if it is LIF.
    pub fn of_layout(layout: &Layout) -> Option<Self> {
        let provenance = &layout.provenance;
        let is_lif = provenance.format == crate::Format::Lif.name();
        let is_2 = provenance.format_version.starts_with('2');
        is_lif.then_some(if is_2 { Self::V2 } else { Self::V1 })
    }

    /// Returns the version as a file states it.
    pub(super) fn stated(self) -> &'static str {
        self.pick("1.0.0", "2.0.0")
    }

    /// Selects from a pair of alternatives for 1.0 and 2.0.
    pub(super) fn select<T>(self, [in_1, in_2]: [T; 2]) -> T {
        self.pick(in_1, in_2)
    }

    /// Picks the alternative of this version.
    pub(super) fn pick<T>(self, in_1: T, in_2: T) -> T {
        match self {
            Self::V1 => in_1,
            Self::V2 => in_2,
        }
    }
}
