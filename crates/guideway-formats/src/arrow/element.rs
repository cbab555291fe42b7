//! [`Element`]: the kinds of elements that the rows of a table hold.

/// Kind of the element in a row, in the order in which they are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Element {
    Path,
    /// Properties of a path for one vehicle type.
    PathType,
    Node,
    /// Properties of a node for one vehicle type.
    NodeType,
    Station,
    Level,
    VehicleType,
    Block,
    Zone,
    /// The layout as a whole.
    Layout,
    RefusedPath,
}

impl Element {
    pub(super) const ALL: [Self; 11] = [
        Self::Path,
        Self::PathType,
        Self::Node,
        Self::NodeType,
        Self::Station,
        Self::Level,
        Self::VehicleType,
        Self::Block,
        Self::Zone,
        Self::Layout,
        Self::RefusedPath,
    ];

    /// Returns the name in the file.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Path => "path",
            Self::PathType => "path for type",
            Self::Node => "node",
            Self::NodeType => "node for type",
            Self::Station => "station",
            Self::Level => "level",
            Self::VehicleType => "vehicle type",
            Self::Block => "block",
            Self::Zone => "zone",
            Self::Layout => "layout",
            Self::RefusedPath => "refused path",
        }
    }

    /// Returns the kind with this name.
    pub(super) fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.name() == name)
    }
}
