//! Versions of VDA 5050 that differ in the names of their fields.

use guideway_layout::Layout;

use crate::fields::Vocabulary;

/// A version of VDA 5050, by the names of its fields.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Version {
    /// 1.1 to 2.1: edges name their nodes.
    V2,
    /// From 3.0 on: edges lie between nodes by `sequenceId`.
    V3,
}

impl Version {
    /// Returns the version of the file that a layout was read from, if it is an order.
    pub fn of_layout(layout: &Layout) -> Option<Self> {
        let provenance = &layout.provenance;
        let is_order = provenance.format == crate::Format::Vda5050.name();
        let is_3 = provenance.format_version.starts_with('3');
        is_order.then_some(if is_3 { Self::V3 } else { Self::V2 })
    }

    pub(super) fn vocabulary(self) -> Vocabulary {
        match self {
            Self::V2 => Vocabulary::Vda2,
            Self::V3 => Vocabulary::Vda3,
        }
    }

    /// The other version.
    pub(super) fn other(self) -> Self {
        match self {
            Self::V2 => Self::V3,
            Self::V3 => Self::V2,
        }
    }

    /// The version that a new order states.
    pub(super) fn stated(self) -> &'static str {
        match self {
            Self::V2 => "2.1.0",
            Self::V3 => "3.0.0",
        }
    }
}
