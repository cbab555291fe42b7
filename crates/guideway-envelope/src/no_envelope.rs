//! The reasons for a path without an envelope.

use std::fmt;

/// The reason for a path without an envelope.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum NoEnvelope {
    /// The path is too short to have a direction.
    Direction,
    /// The file has no envelope for the path.
    NotInFile,
    /// The file has a corridor for the center of the vehicle, but not the size of the vehicle.
    CenterOnly,
    /// The file has an area that is not a list of polygons.
    Unreadable,
}

impl NoEnvelope {
    /// All reasons.
    pub const ALL: [Self; 4] = [
        Self::Direction,
        Self::NotInFile,
        Self::CenterOnly,
        Self::Unreadable,
    ];

    /// The reason that most paths have, by the number of paths per reason in the order of
    /// [`Self::ALL`]; `None` if no path has one.
    pub fn most_frequent(counts: &[u64; Self::ALL.len()]) -> Option<Self> {
        let reasons = Self::ALL.into_iter();
        let most_frequent = reasons.max_by_key(|&reason| counts[reason as usize]);
        most_frequent.filter(|&reason| counts[reason as usize] > 0)
    }
}

impl fmt::Display for NoEnvelope {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Direction => "the path is too short to have a direction",
            Self::NotInFile => "the file gives none",
            Self::CenterOnly => {
                "the file gives a corridor for the center of the vehicle, but not its size"
            }
            Self::Unreadable => "the file gives an area that is not a list of polygons",
        })
    }
}
