//! Generates seeded layouts for measurements and tests, path by path, within a few megabytes.
//!
//! [`d1`] generates halls with aisles, roads and docks, as on a real site; [`d2`] scatters curves
//! over one field with heavy overlap. Both return exactly the requested number of paths, each of
//! eight segments. The same count and seed give the same bits on every machine: the generators use
//! no system math library, no threads and no hash tables.
//!
//! | module | purpose |
//! |---|---|
//! | `d1`, `hall` | the site, and one hall of it |
//! | `d2` | the field of curves |
//! | `shape` | the curves: lines, turns, U-turns, lane changes |
//! | `random` | seeded random numbers |
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
    /// Purpose of the path.
    pub kind: Kind,
    /// Speed allowed, in meters per second.
    pub max_speed_m_s: f32,
    /// Number of the hall, from 0.
    pub hall: u32,
    /// Uniform cubic control points, in meters.
    pub run: [Point<f32>; RUN_POINTS],
}

/// Purpose of a path.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Kind {
    /// A lane between racks.
    Aisle,
    /// A lane across the aisles.
    Cross,
    /// A path straight across a road, from one aisle into the next.
    Through,
    /// A turn from one lane into another at a right angle.
    Turn,
    /// A turn from one lane into the opposite one.
    UTurn,
    /// A change to the adjacent lane.
    LaneChange,
    /// A path to or from a station at a wall.
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

    /// Name of the kind in files.
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

    /// Letter of the kind in identifiers.
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

    /// Speed allowed, in meters per second.
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
