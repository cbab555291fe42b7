//! Seeded layouts to measure and test with, made path by path: a few megabytes whatever the count.
//!
//! [`d1`] has the shape of a real site, hall beside hall; [`d2`] throws curves over one field until every
//! pixel lies under many. Both have exactly as many paths as asked for, each of eight segments. The same
//! count and seed give the same bits on every machine: nothing depends on its mathematics library, on
//! threads or on the order of a hash table.
//!
//! ```
//! let paths: Vec<_> = guideway_datasets::d1(1_000, 7).collect();
//! assert_eq!(paths.len(), 1_000);
//! assert!(paths[0].id.starts_with("H0000-"));
//! ```

mod d1;
mod d2;
mod hall;
mod random;
mod shape;

use guideway_spline::Point;

pub use d1::d1;
pub use d2::{D2_HEIGHT_M, D2_WIDTH_M, d2};

/// Control points of every path: eight segments.
pub const RUN_POINTS: usize = 11;

/// One path of a dataset.
#[derive(Clone, Debug, PartialEq)]
pub struct GeneratedPath {
    /// Identifier, unique in the dataset.
    pub id: String,
    /// What the path is for.
    pub kind: Kind,
    /// Speed allowed, in meters a second.
    pub max_speed_m_s: f32,
    /// Number of the hall, from 0.
    pub hall: u32,
    /// Uniform cubic control points, in meters.
    pub run: [Point<f32>; RUN_POINTS],
}

/// What a path of a dataset is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Kind {
    /// A lane between racks.
    Aisle,
    /// A lane across the aisles.
    Cross,
    /// From an aisle straight over a road into the aisle beyond.
    Through,
    /// From one lane into another at a right angle.
    Turn,
    /// From one lane into the opposite one.
    UTurn,
    /// From one lane into the one beside it.
    LaneChange,
    /// To or from a station at a wall.
    Dock,
}

impl Kind {
    /// Every kind there is.
    pub const ALL: &[Self] = &[
        Self::Aisle,
        Self::Cross,
        Self::Through,
        Self::Turn,
        Self::UTurn,
        Self::LaneChange,
        Self::Dock,
    ];

    /// The name, as it is written to files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Aisle => "aisle",
            Self::Cross => "cross",
            Self::Through => "through",
            Self::Turn => "turn",
            Self::UTurn => "u-turn",
            Self::LaneChange => "lane-change",
            Self::Dock => "dock",
        }
    }

    /// Letter that stands for the kind in identifiers.
    fn letter(self) -> char {
        match self {
            Self::Aisle => 'A',
            Self::Cross => 'C',
            Self::Through => 'X',
            Self::Turn => 'T',
            Self::UTurn => 'U',
            Self::LaneChange => 'L',
            Self::Dock => 'D',
        }
    }

    /// Speed allowed, in meters a second.
    fn max_speed_m_s(self) -> f32 {
        match self {
            Self::Cross => 2.0,
            Self::Aisle | Self::Through => 1.5,
            Self::LaneChange => 1.0,
            Self::Turn => 0.7,
            Self::UTurn => 0.5,
            Self::Dock => 0.3,
        }
    }
}
