//! [`SnapTarget`]: what a position snapped to, with its name.

/// The target that a position snapped to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SnapTarget {
    /// A node, by its row.
    Node(u32),
    /// The end of a path.
    End,
    /// A place where two paths cross.
    Crossing,
    /// The middle of a path.
    Middle,
    /// The foot of a line from the previous point that meets a path at a right angle.
    Perpendicular,
    /// The place where a line from the previous point touches a path.
    Tangent,
    /// A direction from the previous point.
    Direction,
    /// A crossing of grid lines.
    Grid,
}

impl SnapTarget {
    /// Name for people.
    pub fn name(self) -> &'static str {
        match self {
            Self::Node(_) => "node",
            Self::End => "end",
            Self::Crossing => "crossing",
            Self::Middle => "middle",
            Self::Perpendicular => "perpendicular",
            Self::Tangent => "tangent",
            Self::Direction => "direction",
            Self::Grid => "grid",
        }
    }
}
