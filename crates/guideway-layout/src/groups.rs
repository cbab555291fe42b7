//! Groups of a network: vehicle types with their properties, blocks of elements, and zones.

use guideway_spline::{Affine, Point};

use crate::Attributes;

/// A vehicle type, with the properties that hold on every path.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct VehicleType {
    /// Name, as the entries of paths and nodes use it.
    pub id: String,
    /// Properties in one row, such as `maxSpeed`.
    pub attributes: Attributes,
}

/// An element that a block contains.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Member {
    /// Row of a path.
    Path(u32),
    /// Row of a node.
    Node(u32),
    /// Row of a station.
    Station(u32),
}

/// A set of elements with a common rule, such as "one vehicle at a time".
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Block {
    /// Identifier in the file.
    pub id: String,
    /// The elements, without repetition.
    pub members: Vec<Member>,
    /// Properties in one row, such as `type`.
    pub attributes: Attributes,
}

/// An area with a rule, such as "no entry".
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Zone {
    /// Identifier in the file.
    pub id: String,
    /// Corners of the outline in meters, in order; the last one joins the first one.
    pub outline_m: Vec<Point<f64>>,
    /// Index of its level.
    pub level: Option<u32>,
    /// Properties in one row, such as `type`.
    pub attributes: Attributes,
}

impl Zone {
    /// Maps the outline.
    pub(crate) fn transform(&mut self, by: Affine) {
        self.outline_m.iter_mut().for_each(|p| *p = by.apply(*p));
    }
}

impl Member {
    /// The same element after its table was renumbered; `None` if it no longer exists. Each
    /// function maps an old row to the new one.
    #[must_use]
    pub fn renumbered(
        self,
        path: impl Fn(u32) -> Option<u32>,
        node: impl Fn(u32) -> Option<u32>,
        station: impl Fn(u32) -> Option<u32>,
    ) -> Option<Self> {
        match self {
            Self::Path(row) => path(row).map(Self::Path),
            Self::Node(row) => node(row).map(Self::Node),
            Self::Station(row) => station(row).map(Self::Station),
        }
    }
}
