//! [`Version`]: the versions of plant models that can be written.

use guideway_layout::Layout;

/// Version of a plant model that can be written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Version {
    /// 6.0.0: points have a position in the plant and one in the drawing.
    V6,
    /// 7.0.0, which openTCS reads from its version 7 on.
    V7,
}

impl Version {
    /// Number in a file.
    pub(super) fn number(self) -> &'static str {
        match self {
            Self::V6 => "6.0.0",
            Self::V7 => "7.0.0",
        }
    }

    /// Version of the plant model that a layout was read from, if it can be written.
    pub(crate) fn of_layout(layout: &Layout) -> Option<Self> {
        let provenance = &layout.provenance;
        let is_plant = provenance.format == crate::Format::OpenTcs.name();
        let mut versions = [Self::V6, Self::V7].into_iter();
        let version = versions.find(|version| version.number() == provenance.format_version);
        version.filter(|_| is_plant)
    }
}
